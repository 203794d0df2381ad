// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Edges that absorb waves, between a scene and the core.
#include "core/terms/inertia/absorbing.hpp"
#include "core/terms/inertia/motion.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/shaking/MpmAbsorbingBoundary.hpp"

namespace yade {

template <int Dim> class Edges : public Condition<Dim> {
public:
	Edges(const MpmCondition::Group& group, const Analysis& analysis) : group(group), analysis(analysis) { }

	// No point reaches through them, in whatever is computed.
	void hold(gimpm::Model<Dim>&) override;
	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override { }
	void joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin) override;
	void advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override;
	Work work(const StepOutcome<Dim>&) const override;
	void reach(const StepOutcome<Dim>&) override;

private:
	using Edge = gimpm::AbsorbingBoundary<Dim>;

	gimpm::ConstrainedBox<Dim> boxOf(const MpmAbsorbingBoundary&, const gimpm::Grid<Dim>&) const;
	std::shared_ptr<Edge>      edgeOf(const MpmAbsorbingBoundary&, const string& name, const gimpm::Grid<Dim>&) const;

	MpmCondition::Group       group;
	const Analysis&           analysis;
	const gimpm::Motion<Dim>* motion = nullptr;

	vector<std::pair<shared_ptr<MpmAbsorbingBoundary>, std::shared_ptr<Edge>>> edges; // in time steps
};

} // namespace yade
