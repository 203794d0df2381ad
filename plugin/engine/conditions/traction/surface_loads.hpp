// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Loads on surfaces, between the conditions of a scene and the terms of a step.
#include "core/terms/traction.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/traction/MpmTraction.hpp"

namespace yade {

template <int Dim> class SurfaceLoads : public Condition<Dim> {
public:
	explicit SurfaceLoads(const MpmCondition::Group& group) : group(group) { }

	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override;
	void joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin) override;
	void advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override { advanceTo(step.looked); }
	Work work(const StepOutcome<Dim>&) const override;
	void reach(const StepOutcome<Dim>&) override;
	// Doubt about a load that has not acted yet: it is not inside of the body.
	string warningOfPlace(const gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&) const override;

private:
	void advanceTo(Real time);

	struct Load {
		shared_ptr<MpmTraction> from;
		gimpm::LoadCurve        curve;
	};
	MpmCondition::Group             group;
	vector<Load>                    sources;
	vector<gimpm::SurfaceLoad<Dim>> loads;
};

} // namespace yade
