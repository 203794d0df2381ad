// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Edges beyond which the ground moves by itself, between a scene and the core.
#include "core/terms/inertia/ground_edge.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/shaking/MpmFreeField.hpp"

namespace yade {

class FreeFields : public Condition<2> {
public:
	FreeFields(const MpmCondition::Group& group, const Analysis& analysis) : group(group), analysis(analysis) { }

	void join(gimpm::Model<2>&, const Surroundings<2>&) override;
	void joinMotion(gimpm::Motion<2>&, const gimpm::Model<2>&, Real begin) override;
	void advance(const StepTime&, gimpm::Model<2>&, gimpm::Load<2>&) override;
	Work work(const StepOutcome<2>&) const override;
	void reach(const StepOutcome<2>&) override;

private:
	struct Edge : gimpm::GroundEdge<2> {
		shared_ptr<MpmFreeField> from;
		vector<Vector3r>         impedances; // impedances of the pieces
	};

	std::shared_ptr<Edge> edgeOf(const Listed&, const gimpm::Model<2>&, const gimpm::PointCloud<2>&) const;

	MpmCondition::Group           group;
	const Analysis&               analysis;
	vector<std::shared_ptr<Edge>> edges;
};

} // namespace yade
