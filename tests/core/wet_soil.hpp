// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes of soil through which water flows, for tests of it.
#pragma once
#include "core/stepping/load_step.hpp"
#include "core/terms/traction.hpp"
#include "core/terms/water/flow.hpp"
#include "scenes.hpp"

namespace gimpm {

/// A box of soil of any length, whose last layer of points along `axis` may end anywhere in its cell.
template <int Dim> struct Soil {
	static constexpr double young = 1e6;
	double                  h;
	Model<Dim>              model;
	PointCloud<Dim>         cloud;
	SoilWater<Dim>          water;
	SurfaceLoad<Dim>        load;
	LinearSolver            solver;

	Soil(double h, Vec<Dim> size, bool axisymmetric = false, double modulus = young) : h(h)
	{
		model.grid.cellSize     = h;
		model.grid.axisymmetric = axisymmetric;
		model.materials         = { { Hencky(modulus, 0), 0 } };
		model.newton.tolerance  = 1e-10;
		std::vector<ConstrainedBox<Dim>> walls;
		for (int a = 0; a < Dim; ++a)
			walls.push_back(wallBelow<Dim>(model.grid, a, 0));
		if (axisymmetric) walls.push_back(ConstrainedBox<Dim>::ofAxis(model.grid));
		model.boundary         = Boundary<Dim>(walls);
		const Index<Dim> count = (2 * size / h).array().ceil().template cast<int>();
		const Vec<Dim>   half  = 0.5 * size.cwiseQuotient(count.template cast<double>());
		forIndices<Dim>(Index<Dim>::Zero(), count, [&](const Index<Dim>& i) {
			addPoint<Dim>(cloud, Vec<Dim>((2 * i.template cast<double>() + Vec<Dim>::Ones()).cwiseProduct(half)), half);
		});
		if (axisymmetric) cloud.hoopStretch.assign(cloud.size(), 1);
		for (std::size_t p = 0; axisymmetric && p < cloud.size(); ++p)
			cloud.volume0[p] *= 2 * M_PI * cloud.position[p][0];
		water.pores = { { 1e-8, 0.5 } };
		water.pressure.assign(cloud.size(), 0);
		model.fields       = { pressureField(water, *model.division, modulus / h) };
		model.coupledTerms = { [this](const StepContext<Dim>& step, const State& begin) {
			return std::make_unique<Flow<Dim>>(
			        water, [this](int) { return model.materials[0].young({}, 0); }, step, begin);
		} };
	}
	void hold(const std::vector<ConstrainedBox<Dim>>& more)
	{
		auto walls = model.boundary.boxes();
		walls.insert(walls.end(), more.begin(), more.end());
		model.boundary = Boundary<Dim>(walls);
	}
	Drain<Dim>& drain(const Surface<Dim>& surface, typename Drain<Dim>::Kind kind, double given)
	{
		Drain<Dim> made;
		made.surface = surface, made.kind = kind, made.given = given;
		made.surface.refine(h / 4);
		water.drains.push_back(made);
		return water.drains.back();
	}
	void push(const Surface<Dim>& surface, const Vec<Dim>& traction)
	{
		load.surface = surface, load.traction = traction;
		load.surface.refine(h / 4);
		model.terms = { [this](const StepContext<Dim>& step) { return std::make_unique<Traction<Dim>>(load, step); } };
	}
	StepReport step(double duration)
	{
		water.duration = duration;
		return loadStep<Dim>(cloud, model, { Vec<Dim>::Zero(), { 1, 0 } }, solver);
	}
	double out() const
	{
		double sum = 0;
		for (const auto& drain : water.drains)
			sum += drain.out;
		return sum;
	}
};

/// Degree of consolidation of a layer that drains at one side, at the time T h^2 / c_v (Terzaghi 1943).
inline double terzaghi(double T)
{
	double degree = 1;
	for (int k = 0; k < 200; ++k) {
		const double m = M_PI * (2 * k + 1) / 2;
		degree -= 2 / (m * m) * std::exp(-m * m * T);
	}
	return degree;
}

inline Surface<2> line(const Vec<2>& from, const Vec<2>& to) { return { { from, to }, { from, to }, { { 0, 1 } } }; }
} // namespace gimpm
