// SPDX-License-Identifier: GPL-2.0-or-later
// Two nodes far apart that a spring joins.
#pragma once
#include "core/stepping/load_step.hpp"
#include "scenes.hpp"

namespace gimpm {

/// A spring along x between two nodes of the grid, which is shorter than their distance by so much.
struct Tendon {
	Key    ends[2];
	double stiffness, shortening, force = 0;
};

template <int Dim> class TendonForce : public CoupledTerm<Dim> {
public:
	TendonForce(Tendon& tendon, const CloudBasis<Dim>& basis)
	        : tendon_(tendon), node_ { position(basis.nodes, tendon.ends[0]), position(basis.nodes, tendon.ends[1]) }
	{
	}
	void markCouplings(Couplings& K) const override
	{
		for (const int a : node_)
			for (const int b : node_)
				K.mark({ 0, a }, { 0, b });
	}
	std::optional<PointFailure> addCoupled(const State& state, const FieldSum<Dim>& sum) const override
	{
		for (int i = 0; i < 2; ++i) {
			const double force = sign(i) * forceAt(state);
			sum.force[0][Dim * node_[i]] += force;
			sum.absoluteContributions[0][Dim * node_[i]] += std::abs(force);
			for (int j = 0; j < 2 && sum.couplings; ++j) {
				Mat<Dim> k = Mat<Dim>::Zero();
				k(0, 0)    = sign(i) * sign(j) * tendon_.stiffness;
				sum.couplings->add({ 0, node_[i] }, { 0, node_[j] }, k);
			}
		}
		return std::nullopt;
	}
	void commitCoupled(const State& state) override { tendon_.force = forceAt(state); }

private:
	static double sign(int end) { return end == 0 ? -1 : 1; }
	double        forceAt(const State& state) const
	{
		const auto& d = state.displacements();
		return tendon_.stiffness * (d[Dim * node_[1]] - d[Dim * node_[0]] + tendon_.shortening);
	}
	Tendon& tendon_;
	int     node_[2];
};

/// A block that stands on its base, with a tendon between the ends of its upper edge.
template <int Dim> struct Braced {
	Model<Dim>      model;
	PointCloud<Dim> cloud;
	Tendon          tendon;

	Braced(int length, LinearMethod method)
	{
		model.grid.cellSize       = 0.5;
		model.materials           = { { Hencky(1e6, 0.3), 0 } };
		model.newton.tolerance    = 1e-10;
		model.newton.linearSolver = method;
		Vec<Dim> top              = Vec<Dim>::Constant(infinity);
		top[1]                    = 0;
		model.boundary            = Boundary<Dim>({ held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), top, std::string("xyz").substr(0, Dim)) });
		cloud                     = block<Dim>(model.grid, cellsOf<Dim>(length, 3, 1), 2);
		tendon                    = { { Grid<Dim>::key(cellsOf<Dim>(0, 3, 0)), Grid<Dim>::key(cellsOf<Dim>(length, 3, 0)) }, 2e4, 0.1 };
		model.coupledTerms = { [this](const StepContext<Dim>& step, const State&) { return std::make_unique<TendonForce<Dim>>(tendon, step.basis); } };
	}
};

} // namespace gimpm
