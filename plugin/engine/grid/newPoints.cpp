// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/newPoints.hpp"
#include "core/base/checksum.hpp"
#include "engine/points/MpmPoint.hpp"
#include "engine/points/MpmState.hpp"

namespace yade {

namespace {
	shared_ptr<Body> newBody(const Vector3r& position, const Vector3r& halfSize, const shared_ptr<MpmMaterial>& material)
	{
		const shared_ptr<MpmPoint> shape(new MpmPoint);
		shape->halfSize = shape->halfSize0 = halfSize;
		shape->radius                      = halfSize[0];

		const shared_ptr<MpmState> state = boost::dynamic_pointer_cast<MpmState>(material->newAssocState());
		state->pos = state->refPos = position;
		state->volume = state->volume0 = 8 * halfSize.prod();
		state->mass                    = material->density * state->volume0;
		state->blockedDOFs             = State::DOF_ALL;

		const shared_ptr<Body> body(new Body);
		body->material = material;
		body->shape    = shape;
		body->state    = state;
		body->flags &= ~Body::FLAG_BOUNDED;
		return body;
	}

	void requireLength(const string& name, size_t length, size_t expected)
	{
		if (length != expected) throw std::invalid_argument(name + " and index differ in length");
	}

	template <class T> vector<T> copyOf(const Column<T>& column) { return { column.data(), column.data() + column.size() }; }
}

namespace {
	// The same as a step would refuse.
	template <int Dim> void requireNumberable(const NewPoints& points, const gimpm::Grid<Dim>& grid)
	{
		for (size_t i = 0; i < points.size(); ++i) {
			const Vector3r x = points.position(i);
			if (((x.head<Dim>() - grid.origin) / grid.cellSize).cwiseAbs().maxCoeff() < grid.indexLimit) continue;
			std::ostringstream text;
			text << "a point at (" << x[0] << ", " << x[1] << ", " << x[2] << ") is more than " << grid.indexLimit << " cells of " << grid.cellSize
			     << " m from MpmGrid.origin = (" << grid.origin.transpose()
			     << "), too far to be numbered. Coordinates of a national grid have that size: shift the region to the origin, as mpm.terrain(origin=...) and "
			        "mpm.solid(shift=...) do, or give the grid an origin near it.";
			throw std::invalid_argument(text.str());
		}
	}
}

NewPoints::NewPoints(
        const MpmGrid& grid, const py::object& positions, const py::object& half, const py::list& materials, const py::object& index,
        const py::dict& parameters, int body)
        : isSolid(grid.dim == 3), areRings(grid.axisymmetric), ofBody(body), positions(positions, "positions"), half(half, "half"), index(index, "index")
{
	requireLength("positions", this->positions.size(), 3 * size());
	requireLength("half", this->half.size(), size());
	for (py::ssize_t i = 0; i < py::len(materials); ++i) {
		this->materials.push_back(py::extract<shared_ptr<MpmMaterial>>(materials[i]));
		this->materials.back()->requireAdmissible();
	}
	if (isSolid) requireNumberable<3>(*this, grid.lattice<3>());
	else
		requireNumberable<2>(*this, grid.lattice<2>());
	const py::list names = parameters.keys();
	for (py::ssize_t i = 0; i < py::len(names); ++i) {
		const string name = py::extract<string>(names[i]);
		this->parameters.emplace_back(name, std::make_unique<Column<Real>>(parameters[names[i]], name.c_str()));
		requireLength(name, this->parameters.back().second->size(), size());
	}
}

Vector3r NewPoints::halfSize(size_t point) const
{
	const Real inPlane = half.data()[point];
	return { inPlane, inPlane, isSolid ? inPlane : areRings ? M_PI * position(point)[0] : 0.5 };
}

shared_ptr<Body> NewPoints::body(size_t point)
{
	const auto& material = materials.at(index.data()[point]);
	const auto  body     = newBody(position(point), halfSize(point), material);
	giveParameters(*body, *material, point);
	static_cast<MpmState&>(*body->state).body = ofBody;
	return body;
}

void NewPoints::giveParameters(const Body& body, const MpmMaterial& material, size_t point)
{
	auto& state = static_cast<MpmState&>(*body.state);
	for (const auto& [name, column] : parameters)
		state.setParameter(name, column->data()[point]);
	try {
		ownMaterial.of(material, state.parameters);
	} catch (const std::invalid_argument& error) {
		std::ostringstream text;
		text << "at (" << state.pos[0] << ", " << state.pos[1] << ", " << state.pos[2] << "): " << error.what();
		throw std::invalid_argument(text.str());
	}
}

std::uint64_t NewPoints::checksum() const
{
	gimpm::Checksum sum;
	sum.mix(vector<int> { ofBody }), sum.mix(copyOf(positions)), sum.mix(copyOf(half)), sum.mix(copyOf(index));
	for (const auto& [name, column] : parameters)
		sum.mix(copyOf(*column));
	return sum.take();
}

py::list newBodies(
        const MpmGrid& grid, const py::object& positions, const py::object& half, const py::list& materials, const py::object& index,
        const py::dict& parameters, int body)
{
	NewPoints points(grid, positions, half, materials, index, parameters, body);
	py::list  bodies;
	for (size_t i = 0; i < points.size(); ++i)
		bodies.append(points.body(i));
	return bodies;
}

} // namespace yade
