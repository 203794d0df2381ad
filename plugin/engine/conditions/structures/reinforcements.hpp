// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bars and beams, between the conditions of a scene and the terms of a step.
#include "core/structures/structure.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/structures/MpmReinforcement.hpp"

namespace yade {

// std::invalid_argument for settings that structures do not go with.
void requireStructuresFit(const Analysis&, const string& kind, const string& name);

// A line with vertices half a cell apart; std::invalid_argument if there would be too many of them.
template <int Dim> std::vector<gimpm::Vec<Dim>> fineLine(const std::vector<gimpm::Vec<Dim>>&, const string& name, const gimpm::Grid<Dim>&);

// A bar as the core knows it, new or as the last step has left it, and the way back.
template <int Dim> gimpm::Reinforcement<Dim> coreBar(const MpmReinforcement&, const string& name, const gimpm::Grid<Dim>&);
template <int Dim> void                      scatterBar(const gimpm::Reinforcement<Dim>&, MpmReinforcement&);
// Sets the loads of a bar at the end of a step.
template <int Dim> void loadBar(gimpm::Reinforcement<Dim>&, const MpmReinforcement&, const gimpm::LoadCurve&, const StepTime&);

// Makes a structure act, which must stay where it is in memory.
template <int Dim> void joinStructure(gimpm::Structure<Dim>&, gimpm::Model<Dim>&);

// Each is a structure by itself.
template <int Dim> class Reinforcements : public Condition<Dim> {
public:
	explicit Reinforcements(const MpmCondition::Group& group) : group(group) { }

	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override;
	void advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override;
	Work work(const StepOutcome<Dim>&) const override;
	void reach(const StepOutcome<Dim>&) override;

private:
	struct Source {
		shared_ptr<MpmReinforcement> from;
		gimpm::LoadCurve             curve;
	};
	MpmCondition::Group           group;
	vector<Source>                sources;
	vector<gimpm::Structure<Dim>> structures;
};

} // namespace yade
