// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies with inertia for the tests of the core.
#pragma once
#include "core/stepping/explicit_step.hpp"
#include "core/terms/inertia/inertia.hpp"
#include "scenes.hpp"
#include <Eigen/Geometry>

namespace gimpm {

/// Time steps of a body. The load factor is 1 all the time.
template <int Dim> struct Moving {
	Model<Dim>                   model;
	PointCloud<Dim>              cloud;
	std::shared_ptr<Motion<Dim>> motion  = std::make_shared<Motion<Dim>>();
	Vec<Dim>                     gravity = Vec<Dim>::Zero();
	LinearSolver                 solver;

	Moving(double cellSize, Law law, double density, TimeScheme scheme = {})
	{
		model.grid.cellSize    = cellSize;
		model.materials        = { { law, density } };
		model.newton.tolerance = 1e-9;
		model.atMiddle         = scheme.atMiddle;
		motion->scheme         = scheme;
		motion->isElastic      = { law->isElastic };
		if (!scheme.isExplicit)
			model.inertia = [motion = motion](const StepContext<Dim>& step) { return std::make_unique<Inertia<Dim>>(*motion, step); };
	}
	/// Points with the velocity(position).
	template <class F> void put(PointCloud<Dim> points, F&& velocity)
	{
		cloud = std::move(points);
		motion->velocity.clear();
		motion->mass.clear();
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			motion->mass.push_back(model.materials[cloud.material[p]].density * cloud.volume0[p]);
			motion->velocity.push_back(velocity(cloud.position[p]));
		}
		motion->acceleration.assign(cloud.size(), Vec<Dim>::Zero());
	}
	StepReport step(double duration)
	{
		motion->duration = duration;
		if (motion->scheme.isExplicit) return explicitStep<Dim>(cloud, model, { gravity, { 1, 0 } }, *motion);
		return loadStep(cloud, model, { gravity, { 1, 0 } }, solver);
	}
	bool steps(int count, double duration)
	{
		for (int i = 0; i < count; ++i)
			if (const auto report = step(duration); !report.converged()) {
				ADD_FAILURE() << "step " << i << ": " << report.cause;
				return false;
			}
		return true;
	}

	double   mass() const { return std::accumulate(motion->mass.begin(), motion->mass.end(), 0.); }
	Vec<Dim> momentum() const
	{
		Vec<Dim> sum = Vec<Dim>::Zero();
		for (std::size_t p = 0; p < cloud.size(); ++p)
			sum += motion->mass[p] * motion->velocity[p];
		return sum;
	}
	/// About the origin, component z.
	double angularMomentum() const
	{
		double sum = 0;
		for (std::size_t p = 0; p < cloud.size(); ++p)
			sum += motion->mass[p] * (cloud.position[p][0] * motion->velocity[p][1] - cloud.position[p][1] * motion->velocity[p][0]);
		return sum;
	}
	double kinetic() const
	{
		double sum = 0;
		for (std::size_t p = 0; p < cloud.size(); ++p)
			sum += motion->mass[p] * motion->velocity[p].squaredNorm() / 2;
		return sum;
	}
	/// Elastic energy of Hencky's law.
	double elastic() const
	{
		double sum = 0;
		for (std::size_t p = 0; p < cloud.size(); ++p)
			sum += cloud.volume0[p] * cloud.volumeRatio(p) * (cloud.stress[p].full() * cloud.elasticStrain[p].full()).trace() / 2;
		return sum;
	}
	double energy() const { return kinetic() + elastic(); }
};

/// The points moved as a whole.
template <int Dim> PointCloud<Dim> shifted(PointCloud<Dim> cloud, const Vec<Dim>& by)
{
	for (auto& x : cloud.position)
		x += by;
	return cloud;
}

/// A bar along x that is held at x = 0, one cell wide on rollers, swings in its first mode; nu = 0. Its end lies
/// anywhere in a cell.
template <int Dim> struct Bar : Moving<Dim> {
	static constexpr double young = 1e6, density = 1000;
	const double            wave = std::sqrt(young / density);
	double                  length, speed;

	Bar(double cells, TimeScheme scheme = {}, double amplitude = 1e-5)
	        : Moving<Dim>(1, Hencky(young, 0), density, scheme), length(cells), speed(amplitude * wave)
	{
		const int                        points = int(std::lround(2 * cells));
		const double                     half   = cells / points / 2;
		std::vector<ConstrainedBox<Dim>> walls { wallBelow<Dim>(this->model.grid, 0, 0) };
		for (int axis = 1; axis < Dim; ++axis)
			walls.push_back(wallBelow<Dim>(this->model.grid, axis, 0)), walls.push_back(wallAbove<Dim>(this->model.grid, axis, 1));
		this->model.boundary = Boundary<Dim>(walls);
		PointCloud<Dim> cloud;
		forIndices<Dim>(Index<Dim>::Zero(), cellsOf<Dim>(points, 2, 2), [&](const Index<Dim>& i) {
			Vec<Dim> x = Vec<Dim>::Constant(0.25) + 0.5 * i.template cast<double>(), l = Vec<Dim>::Constant(0.25);
			x[0] = half * (2 * i[0] + 1), l[0] = half;
			addPoint<Dim>(cloud, x, l);
		});
		this->put(cloud, [&](const Vec<Dim>& x) { return Vec<Dim>(speed * std::sin(M_PI * x[0] / 2 / length) * Vec<Dim>::Unit(0)); });
	}
	double period() const { return 4 * length / wave; }

	/// First mode in the points' velocities [m/s].
	double ofFirstMode() const
	{
		double sum = 0, norm = 0;
		for (std::size_t p = 0; p < this->cloud.size(); ++p) {
			const double mode = std::sin(M_PI * this->original(p) / 2 / length);
			sum += mode * this->motion->velocity[p][0], norm += mode * mode;
		}
		return sum / norm;
	}
	double original(std::size_t p) const { return length / std::lround(2 * length) * (0.5 + double(p % std::lround(2 * length))); }

	/// Mean period over some of them, by the rises through zero, which a cubic through four values places.
	double measuredPeriod(int periods, double duration)
	{
		std::vector<double> value { ofFirstMode() }, crossings;
		while (int(crossings.size()) < periods) {
			if (!this->steps(1, duration)) return 0;
			value.push_back(ofFirstMode());
			const std::size_t n = value.size() - 1;
			if (n < 3 || !(value[n - 2] < 0 && value[n - 1] >= 0)) continue;
			double t = 0.5; // between the two, by Newton's method on the cubic
			for (int k = 0; k < 20; ++k) {
				const double a = value[n - 3], b = value[n - 2], c = value[n - 1], d = value[n];
				const auto   cubic = [&](double s) {
                                        return -a * s * (s - 1) * (s - 2) / 6 + b * (s + 1) * (s - 1) * (s - 2) / 2 - c * (s + 1) * s * (s - 2) / 2
                                                + d * (s + 1) * s * (s - 1) / 6;
				};
				t -= cubic(t) * 1e-4 / (cubic(t + 5e-5) - cubic(t - 5e-5));
			}
			crossings.push_back((double(n) - 2 + t) * duration);
		}
		// the velocity is a cosine: its first rise through zero comes after three quarters
		return crossings.back() / (periods - 0.25);
	}
};

} // namespace gimpm
