// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Constraints of the body, between the boundaries of a scene and the core: boxes of nodes, walls off the lines of the
// grid, and bases that move by a history.
#include "core/terms/inertia/motion.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/boundary/MpmBoundary.hpp"

namespace yade {

template <int Dim> class Boundaries : public Condition<Dim> {
public:
	Boundaries(const MpmCondition::Group&, const Analysis&);

	void hold(gimpm::Model<Dim>&) override;
	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override { }
	void joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin) override;
	void advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override;
	bool areBeside(const gimpm::Vec<Dim>& point, const gimpm::Vec<Dim>& part) const override;

	// Reactions are those of the two ends of the step, where they are known; with the midpoint rule those of the
	// middle.
	Work work(const StepOutcome<Dim>&) const override;
	void reach(const StepOutcome<Dim>&) override;

private:
	void requireFittingBases(const gimpm::Model<Dim>&) const;
	void moveBases(const StepTime&, gimpm::Load<Dim>&) const;

	const Analysis&                                  analysis;
	vector<shared_ptr<MpmBoundary>>                  boundaries;
	std::map<int, shared_ptr<MpmBaseMotion>>         bases; // base motions by boundary; for time steps
	std::map<int, std::shared_ptr<gimpm::Wall<Dim>>> walls; // walls by boundary
	vector<gimpm::ConstrainedBox<Dim>>               boxes;
	gimpm::Motion<Dim>*                              motion = nullptr;
};

} // namespace yade
