// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Water that flows, between the conditions of a scene and the terms of a step.
#include "core/terms/water/soil_water.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/conditions/water/MpmWater.hpp"

namespace yade {

template <int Dim> class Flows : public Condition<Dim> {
public:
	explicit Flows(const MpmCondition::Group& group) : from(boost::static_pointer_cast<MpmFlow>(group.front().condition)) { }

	void                     join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override;
	void                     advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override;
	void                     reach(const StepOutcome<Dim>&) override;
	void                     joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin) override;
	Work                     work(const StepOutcome<Dim>&) const override;
	std::map<string, string> warnings() const override;

private:
	Eigen::VectorXd                   pressing(const gimpm::CloudBasis<Dim>&, const Eigen::VectorXd* field) const;
	std::unique_ptr<gimpm::Term<Dim>> frozen(const gimpm::StepContext<Dim>&) const;
	void                              beginWhole(const Surroundings<Dim>&);
	int                               curveOf(const MpmRetention&);
	void                              takeCurve(const MaterialPoint&, const MpmMaterial& asPoint, gimpm::Pores&);
	void                              takePoints(const Surroundings<Dim>&, const gimpm::Division&);
	void                              fillNewPoints(const gimpm::PointCloud<Dim>&, const gimpm::Division&);
	void                              takeNodes();
	void                              takeDrains(const gimpm::Model<Dim>&, const Surroundings<Dim>&);
	Real                              meanModulus(const gimpm::Model<Dim>&, const Surroundings<Dim>&);
	void                              keepNodes();

	shared_ptr<MpmFlow>                from;
	std::map<const MpmRetention*, int> curves; // numbers
	gimpm::SoilWater<Dim>              water;
	gimpm::Grid<Dim>                   lattice;
	shared_ptr<MpmWater>               still;                     // null: there is none with a level
	Real acrossCell      = std::numeric_limits<Real>::infinity(); // time in which pressures spread over a cell where they do fastest [s]
	Real shortest        = acrossCell;                            // step [s]
	Real lowest          = 0;                                     // whole pressure where pores are always full [Pa]
	bool pressuresAreNew = false;                                 // whole pressures of some points have been given since the last step
	bool isRamp          = false;                                 // the loads grow within the first second, as nobody has said otherwise
};

} // namespace yade
