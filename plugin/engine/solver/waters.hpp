// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Water, between the conditions of a scene and the terms of a step.
#include "core/terms/water.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/solver/Loads.hpp"

namespace yade {
class MpmImplicitEngine;

template <int Dim> class Waters {
public:
	Waters() = default;
	// std::invalid_argument names what cannot be computed with. Functions are asked for pressures around the points, also where these are divided among processes.
	Waters(const Loads&, const gimpm::Grid<Dim>&, const gimpm::PointCloud<Dim>&, const gimpm::Division& = {});

	// The same before a step: the cells are those of the points, of all processes. Nothing is asked while the lock of values is held, since a function may well ask the engine.
	// Returns whether any was asked.
	static bool ask(const MpmImplicitEngine&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells);

	// Makes them act in the model's steps, for as long as this exists.
	void join(gimpm::Model<Dim>&);

	// The next step goes from here to there.
	void advance(Real from, Real to);

	// Averaged over a box, at the end of that step, of each with its factor.
	vector<std::pair<gimpm::WaterPlace, std::optional<gimpm::PressureAround<Dim>>>> around(const gimpm::Vec<Dim>& x, const gimpm::Vec<Dim>& half) const;

	// On the points in the last step that was accepted [J], if it is wanted of the steps to come.
	void wantWork();
	Real work() const;

	// Writes a converged state back: the pressure in the pores, and on boundaries, whose reactions are then of total stress.
	void scatter(const vector<MaterialPoint>&, const gimpm::Boundary<Dim>&, vector<Vector3r>& reactions) const;

private:
	using Pressure = typename gimpm::Water<Dim>::Pressure;
	struct Source {
		shared_ptr<MpmWater> from;
		gimpm::LoadCurve     curve;
		Pressure             given; // of a function; null: of a level
		int                  axis;  // of gravity
		Real                 up;
	};
	Pressure pressureAt(const Source&, Real time) const;

	vector<Source>            sources;
	vector<gimpm::Water<Dim>> waters;
};

} // namespace yade
