// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/bulkAccess.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/buffers.hpp"
#include "engine/points/columns.hpp"
#include "yade_api/logging.hpp"
#include <unordered_map>

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

	// One column of the result: `rows` items of `width` numbers, each row written by write(point, first number).
	template <class T, class Write> py::object column(const vector<MaterialPoint>& points, int width, Write write)
	{
		py::object bytes { py::handle<>(PyByteArray_FromStringAndSize(nullptr, points.size() * width * sizeof(T))) };
		T*         row = reinterpret_cast<T*>(PyByteArray_AS_STRING(bytes.ptr()));
		for (const MaterialPoint& point : points) {
			write(point, row);
			row += width;
		}
		return bytes;
	}
	template <class Get> py::object integers(const vector<MaterialPoint>& points, Get get)
	{
		return column<int64_t>(points, 1, [&](const MaterialPoint& point, int64_t* row) { *row = get(point); });
	}
	py::object valuesOf(const PointColumn& c, const vector<MaterialPoint>& points, const Scene& scene)
	{
		if (!c.isInteger) return column<Real>(points, c.width, [&](const MaterialPoint& point, Real* row) { c.get(point, scene, row); });
		return integers(points, [&](const MaterialPoint& point) {
			Real number;
			c.get(point, scene, &number);
			return int64_t(number);
		});
	}

	// The materials that the bodies have, whether in O.materials or not, and which of them each point has.
	void addMaterials(py::dict& columns, const vector<MaterialPoint>& points)
	{
		py::list                                        list;
		std::unordered_map<const MpmMaterial*, int64_t> numbers;
		columns["materialNumber"] = integers(points, [&](const MaterialPoint& point) {
			const auto [found, isNew] = numbers.try_emplace(point.material.get(), numbers.size());
			if (isNew) list.append(point.material);
			return found->second;
		});
		columns["materials"]      = list;
	}
}

py::list newBodies(const py::object& positions, const Vector3r& halfSize, const py::list& materials, const py::object& index)
{
	vector<shared_ptr<MpmMaterial>> known;
	for (py::ssize_t i = 0; i < py::len(materials); ++i) {
		known.push_back(py::extract<shared_ptr<MpmMaterial>>(materials[i]));
		known.back()->requireAdmissible();
	}
	const Column<Real>    coordinates(positions, "positions");
	const Column<int64_t> choice(index, "index");
	if (coordinates.size() != 3 * choice.size()) throw std::invalid_argument("positions and index differ in length");
	py::list bodies;
	for (size_t i = 0; i < choice.size(); ++i) {
		const Eigen::Map<const Vector3r> position(coordinates.data() + 3 * i);
		bodies.append(newBody(position, halfSize, known.at(choice.data()[i])));
	}
	return bodies;
}

void warn(const string& text) { log(Severity::warning, "mpm", text); }

void betweenSteps(const py::object& f)
{
	const ValueLock lock;
	f();
}

py::dict columnsOfPoints(int mask, bool withDerived)
{
	const ValueLock lock;
	const Scene&    scene  = *Singleton<Omega>::instance().getScene();
	const auto      points = materialPoints(scene, mask);
	py::dict        columns;
	for (const PointColumn& column : pointColumns())
		if ((column.is(PointColumn::inArrays) || (withDerived && column.is(PointColumn::derived))) && column.isOf(points))
			columns[column.name] = valuesOf(column, points, scene);
	addMaterials(columns, points);
	return columns;
}

} // namespace yade
