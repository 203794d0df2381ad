// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Loads on surfaces, between the conditions of a scene and the terms of a step.
#include "core/terms/traction.hpp"
#include "engine/analysis/Loads.hpp"

namespace yade {

template <int Dim> class SurfaceLoads {
public:
	SurfaceLoads() = default;
	// std::invalid_argument names what cannot be computed with.
	explicit SurfaceLoads(const Loads&, const gimpm::Grid<Dim>&);

	// Makes them act in the model's steps, for as long as this exists.
	void join(gimpm::Model<Dim>&);

	// What acts at the end of the next step.
	void advanceTo(Real time);

	// The first step begins here; only where something asks for what acted before it.
	void beginAt(Real time);

	// In the last step that was accepted [J].
	Real work() const;

	// Writes a converged state back.
	void scatter() const;

	// About those that have not acted yet: whether one of them is inside of the body; empty if none is.
	string doubt(const gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&) const;

private:
	struct Load {
		shared_ptr<MpmTraction> from;
		gimpm::LoadCurve        curve;
	};
	vector<Load>                    sources;
	vector<gimpm::SurfaceLoad<Dim>> loads;
};

} // namespace yade
