// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Water, between the conditions of a scene and the terms of a step.
#include "core/terms/water/water.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/water/MpmWater.hpp"
#include "engine/conditions/water/pressure_table.hpp"

namespace yade {

template <int Dim> class Waters : public Condition<Dim> {
public:
	explicit Waters(const MpmCondition::Group& group) : group(group) { }

	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override;
	void joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin) override;
	void advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override { advance(step.from, step.looked); }
	Work work(const StepOutcome<Dim>&) const override;

	// The pressure in the pores, and that on boundaries, whose reactions are then of total stress.
	void reach(const StepOutcome<Dim>&) override;

	// Takes its pressures from a scene, without a model: functions are asked for pressures around the points.
	void take(const Analysis&, const gimpm::Grid<Dim>&, const gimpm::PointCloud<Dim>&, const gimpm::Division&, Real begin, Real end, vector<WallInWater>);
	void advance(Real from, Real to);
	void pressOnWalls(Real from, Real to);

	// Averaged over a box, at the end of that step, of each with its factor.
	vector<std::pair<gimpm::WaterDomain, std::optional<gimpm::PressureAround<Dim>>>> around(const gimpm::Vec<Dim>& x, const gimpm::Vec<Dim>& half) const;

private:
	using Pressure = typename gimpm::Water<Dim>::Pressure;
	struct Source {
		shared_ptr<MpmWater> from;
		gimpm::LoadCurve     curve;
		// Pressure of a function; null: of a level.
		std::shared_ptr<const PressureInTime<Dim>> given;
		int                                        axis; // axis of gravity
		Real                                       up, cellSize;
	};
	Pressure pressureAt(const Source&, Real time) const;

	MpmCondition::Group       group;
	vector<Source>            sources;
	vector<gimpm::Water<Dim>> waters;
	vector<WallInWater>       walls;
};

} // namespace yade
