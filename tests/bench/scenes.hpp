// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes for the benchmarks of the core.
#pragma once
#include "core/materials/law.hpp"
#include "core/stepping/load_step.hpp"
#include <limits>
#include <stdexcept>

namespace gimpm {

/// A scene that is loaded step by step.
template <int Dim> struct BenchScene {
	Model<Dim>      model;
	PointCloud<Dim> cloud;
	LinearSolver    solver;
	Vec<Dim>        gravity = -9.81 * Vec<Dim>::Unit(1);
	int             steps = 1, done = 0;

	StepReport step()
	{
		++done;
		return loadStep(cloud, model, { gravity, double(done) / steps, 1. / steps }, solver);
	}
	void addPoint(const Vec<Dim>& position, double halfSize, int material)
	{
		const std::size_t i = cloud.size();
		cloud.resize(i + 1);
		cloud.position[i] = position;
		cloud.halfSize[i] = cloud.halfSize0[i] = Vec<Dim>::Constant(halfSize);
		cloud.volume0[i]                       = std::pow(2 * halfSize, Dim);
		cloud.defGrad[i].setIdentity();
		cloud.material[i] = material;
	}
	ConstrainedBox<Dim> wall(int axis, double place, bool above, std::initializer_list<int> fixed) const
	{
		constexpr double inf = std::numeric_limits<double>::infinity();
		Vec<Dim>         min = Vec<Dim>::Constant(-inf), max = Vec<Dim>::Constant(inf);
		(above ? min : max)[axis] = place;
		auto box                  = ConstrainedBox<Dim>::from(model.grid, min, max);
		for (const int a : fixed)
			box.fixed[a] = true;
		return box;
	}
};

/// Slope with a weak layer (Coombs 2023, section 4.2), in 3D a slice of `depth` cells between smooth walls.
template <int Dim> BenchScene<Dim> slope(double h, int perAxis, int depth = 1)
{
	BenchScene<Dim> s;
	s.model.grid.cellSize = h;
	s.model.materials     = { { VonMises(1e6, 0.3, 15e3), 2400 }, { VonMises(1e6, 0.3, 7.5e3), 2400 } };
	s.steps               = int(std::lround(40 / h));
	std::vector<ConstrainedBox<Dim>> walls { s.wall(0, 0, false, { 0 }), s.wall(0, 30, true, { 0 }), s.wall(1, 0, false, { 0, 1 }) };
	if constexpr (Dim == 3) walls.push_back(s.wall(2, 0, false, { 2 })), walls.push_back(s.wall(2, depth * h, true, { 2 }));
	s.model.boundary = Boundary<Dim>(walls);

	const double d         = h / perAxis;
	const int    layers    = Dim == 3 ? depth : 1;
	const auto   fillPoint = [&](int i, int j, int k) {
                Vec<Dim> x = Vec<Dim>::Constant((k + 0.5) * d);
                x[0] = (i + 0.5) * d, x[1] = (j + 0.5) * d;
                const double top = x[0] < 10 ? 12 : x[0] < 15 ? 12 - (x[0] - 10) : 7;
                if (x[1] <= top + 1e-9) s.addPoint(x, d / 2, x[1] >= 7 && x[1] <= 7.5);
	};
	// cell by cell, as mpm.fill does
	for (int z = 0; z < layers; ++z)
		for (int y = 0; y * h < 12; ++y)
			for (int x = 0; x * h < 30; ++x)
				for (int n = 0; n < int(std::lround(std::pow(perAxis, Dim))); ++n)
					fillPoint(x * perAxis + n % perAxis, y * perAxis + n / perAxis % perAxis, z * perAxis + n / perAxis / perAxis);
	return s;
}

} // namespace gimpm
