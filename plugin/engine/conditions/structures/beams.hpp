// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Beams and their anchors, between the conditions of a scene and the terms of a step.
#include "core/structures/structure.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/structures/MpmBeam.hpp"

namespace yade {
class MpmFlow;

class Beams : public Condition<2> {
public:
	explicit Beams(const MpmCondition::Group& group) : group(group) { }

	void                     join(gimpm::Model<2>&, const Surroundings<2>&) override;
	void                     part(gimpm::PointCloud<2>&, gimpm::Model<2>&) override;
	void                     advance(const StepTime&, gimpm::Model<2>&, gimpm::Load<2>&) override;
	bool                     areBeside(const gimpm::Vec<2>& point, const gimpm::Vec<2>& half) const override;
	Work                     work(const StepOutcome<2>&) const override;
	void                     reach(const StepOutcome<2>&) override;
	std::map<string, string> warnings() const override;

private:
	struct Source {
		shared_ptr<MpmBeam>      from;
		gimpm::LoadCurve         curve, ofGravity;
		gimpm::Vec<2>            down;
		vector<gimpm::LoadCurve> ofAnchors;
	};
	MpmCondition::Group         group;
	vector<Source>              sources;
	vector<gimpm::Structure<2>> structures;
	string                      inItsWay; // feature of the scene that does not go with nodes with affine constraints; empty: nothing
	vector<int>                 sides;    // sides of points, as the step begins
	vector<size_t>              crossed;  // points that have gone through a structure, by structure

	shared_ptr<MpmFlow> flow; // null: there is none
	int                 processesCount = 1;

	vector<gimpm::PartingLine*> lines();
	void                        requirePermeable() const;
	void                        requireWhole() const;
};

} // namespace yade
