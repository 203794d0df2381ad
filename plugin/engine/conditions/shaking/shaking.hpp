// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Edges that absorb waves, bases that move by a history, and Rayleigh damping, between a scene and the core.
#include "core/terms/absorbing.hpp"
#include "core/terms/motion.hpp"
#include "core/terms/rayleigh.hpp"
#include "engine/analysis/job.hpp"
#include "engine/conditions/shaking/MpmAbsorbingBoundary.hpp"
#include "engine/grid/MpmGrid.hpp"

namespace yade {
class MpmDynamicEngine;

// The nodes of an edge by its number. std::invalid_argument names what is wrong with it.
template <int Dim> gimpm::HeldBox<Dim> boxOfEdge(const shared_ptr<MpmAbsorbingBoundary>&, size_t number, const MpmGrid&, const gimpm::Grid<Dim>&);

template <int Dim> class Shaking {
public:
	// Makes them act in the job's steps. std::invalid_argument names what cannot be computed with.
	Shaking(const MpmDynamicEngine&, Job<Dim>&, gimpm::Motion<Dim>&);

	// The next step goes from here to the time of the attempt.
	void begin(Attempt<Dim>&, Real from, gimpm::Motion<Dim>&) const;

	// Writes a converged state back, to which the step has come that is reported.
	void scatter(const gimpm::StepReport&) const;

	// In the last step that was accepted [J].
	Real workOfEdges() const;
	Real dampingWork() const { return rayleigh->work; }

private:
	void join(const shared_ptr<MpmAbsorbingBoundary>&, size_t number, const MpmDynamicEngine&, const gimpm::Model<Dim>&);
	void requireFittingBases(const gimpm::Model<Dim>&) const;

	using Edge = gimpm::AbsorbingBoundary<Dim>;
	vector<std::pair<shared_ptr<MpmAbsorbingBoundary>, std::shared_ptr<Edge>>> edges;
	std::map<int, shared_ptr<MpmBaseMotion>>                                   bases; // by boundary
	vector<gimpm::HeldBox<Dim>>                                                boxes;
	std::shared_ptr<gimpm::Rayleigh>                                           rayleigh { new gimpm::Rayleigh };
};

} // namespace yade
