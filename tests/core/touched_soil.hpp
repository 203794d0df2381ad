// SPDX-License-Identifier: GPL-2.0-or-later
// A block of soil, and rigid bodies that touch it.
#pragma once
#include "core/terms/contact/contact.hpp"
#include "scenes.hpp"

namespace gimpm {

template <int Dim> Mat<Dim> turn(double angle)
{
	if constexpr (Dim == 2) return planeRotation(angle);
	else
		return rotation({ 1, 2, 3 }, angle);
}

/// Soil of 1.5 m in all directions, but of `height` along y, with two points a cell along each axis; nu = 0.
template <int Dim> struct TouchedSoil {
	static constexpr double young = 1e6, h = 0.5;

	Model<Dim>         model;
	PointCloud<Dim>    cloud;
	ContactSystem<Dim> contacts;
	LinearSolver       solver;
	StepReport         report;

	TouchedSoil(double density, double tolerance, double height = 1.5, bool isRing = false)
	{
		model.grid.cellSize     = h;
		model.grid.axisymmetric = isRing;
		model.materials         = { { Hencky(young, 0), density } };
		model.newton.tolerance  = tolerance;
		model.terms             = { [this](const StepContext<Dim>& step) { return std::make_unique<Contact<Dim>>(contacts, step); } };
		const double spacing    = h / 2;
		Index<Dim>   n          = Index<Dim>::Constant(6);
		n[1]                    = int(std::round(height / spacing));
		forIndices<Dim>(Index<Dim>::Zero(), n, [&](const Index<Dim>& i) {
			addPoint<Dim>(cloud, spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5)), Vec<Dim>::Constant(spacing / 2));
		});
		if (isRing) cloud.hoopStretch.assign(cloud.size(), 1);
		for (std::size_t p = 0; isRing && p < cloud.size(); ++p)
			cloud.volume0[p] *= 2 * M_PI * cloud.position[p][0];
	}
	RigidBody<Dim>& add(RigidKind kind, const Vec<Dim>& position, double friction = 0)
	{
		RigidBody<Dim> body;
		body.shape.kind          = kind;
		body.shape.radius        = kind == RigidKind::ball ? 1 : 0.05;
		body.shape.halfSize      = Vec<Dim>::Constant(1);
		body.shape.normal        = -Vec<Dim>::Unit(1);
		body.shape.corners       = wideSheet();
		body.name                = "body #" + std::to_string(contacts.bodies.size());
		body.owner               = int(contacts.bodies.size());
		body.frictionCoefficient = friction;
		body.stiffness           = 100;
		body.begin.position = body.end.position = position;
		contacts.bodies.push_back(body);
		contacts.owners.push_back(position);
		return contacts.bodies.back();
	}
	/// Beyond the soil, looking down.
	static std::array<Vec<Dim>, Dim> wideSheet()
	{
		if constexpr (Dim == 2) return { Vec<2>(-4, 0), Vec<2>(4, 0) };
		else
			return { Vec3(-9, 0, -9), Vec3(9, 0, -9), Vec3(0, 0, 9) };
	}
	void rollers()
	{
		std::vector<ConstrainedBox<Dim>> walls;
		for (int a = 0; a < Dim; ++a)
			walls.push_back(wallBelow<Dim>(model.grid, a, 0));
		model.boundary = Boundary<Dim>(walls);
	}
	/// Bodies have moved once it has converged.
	StepReport step(const Load<Dim>& load = {})
	{
		report = loadStep(cloud, model, load, solver);
		for (auto& body : contacts.bodies)
			if (report.converged()) body.begin = body.end;
		return report;
	}
};

} // namespace gimpm
