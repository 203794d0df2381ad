// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Water that flows, between the conditions of a scene and the terms of a step.
#include "core/terms/soil_water.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"

namespace yade {

template <int Dim> class Flows : public Condition<Dim> {
public:
	explicit Flows(const MpmCondition::Group& group) : from(boost::static_pointer_cast<MpmFlow>(group.front().condition)) { }

	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override;
	void advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override;
	void reach(const StepOutcome<Dim>&) override;

private:
	void takePoints(const Surroundings<Dim>&);
	void takeNodes();
	void takeDrains(const gimpm::Model<Dim>&, const Vector3r& gravity);

	shared_ptr<MpmFlow>   from;
	gimpm::SoilWater<Dim> water;
	Real                  levelOfStillWater = std::numeric_limits<Real>::quiet_NaN();
};

} // namespace yade
