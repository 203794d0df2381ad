// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/bulkAccess.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/buffers.hpp"
#include "engine/points/columns.hpp"
#include "yade_api/logging.hpp"
#include <memory>
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

	// Columns of parameters of new points.
	class ParameterColumns {
	public:
		ParameterColumns(const py::dict& given, size_t rows)
		{
			const py::list names = given.keys();
			for (py::ssize_t i = 0; i < py::len(names); ++i) {
				const string name = py::extract<string>(names[i]);
				columns.emplace_back(name, std::make_unique<Column<Real>>(given[names[i]], name.c_str()));
				if (columns.back().second->size() != rows) throw std::invalid_argument(name + " and index differ in length");
			}
		}
		void give(const Body& body, const MpmMaterial& material, size_t row)
		{
			auto& state = static_cast<MpmState&>(*body.state);
			for (const auto& [name, column] : columns)
				state.setParameter(name, column->data()[row]);
			try {
				ownMaterial.of(material, state.parameters);
			} catch (const std::invalid_argument& error) {
				std::ostringstream text;
				text << "at (" << state.pos[0] << ", " << state.pos[1] << ", " << state.pos[2] << "): " << error.what();
				throw std::invalid_argument(text.str());
			}
		}

	private:
		vector<std::pair<string, std::unique_ptr<Column<Real>>>> columns;
		OwnMaterial                                              ownMaterial;
	};

	// For so many numbers; the second is where they begin.
	template <class T> std::pair<py::object, T*> newBytes(size_t numbers)
	{
		const py::object bytes { py::handle<>(PyByteArray_FromStringAndSize(nullptr, numbers * sizeof(T))) };
		return { bytes, reinterpret_cast<T*>(PyByteArray_AS_STRING(bytes.ptr())) };
	}
	template <class Get> py::object integers(size_t number, Get get)
	{
		const auto [bytes, first] = newBytes<int64_t>(number);
		for (size_t i = 0; i < number; ++i)
			first[i] = get(i);
		return bytes;
	}
	py::object valuesOf(const PointColumn& column, const vector<MaterialPoint>& points, const Scene& scene)
	{
		if (column.isInteger) {
			vector<Real> numbers(points.size());
			column.get(points, scene, numbers.data());
			return integers(points.size(), [&](size_t i) { return int64_t(numbers[i]); });
		}
		const auto [bytes, first] = newBytes<Real>(points.size() * column.width);
		column.get(points, scene, first);
		return bytes;
	}

	// The materials that the bodies have, whether in O.materials or not, and which of them each point has.
	void addMaterials(py::dict& columns, const vector<MaterialPoint>& points)
	{
		py::list                                        list;
		std::unordered_map<const MpmMaterial*, int64_t> numbers;
		columns["materialNumber"] = integers(points.size(), [&](size_t i) {
			const auto [found, isNew] = numbers.try_emplace(points[i].material.get(), numbers.size());
			if (isNew) list.append(points[i].material);
			return found->second;
		});
		columns["materials"]      = list;
	}
}

py::list newBodies(
        const py::object& positions, const Vector3r& halfSize, const py::list& materials, const py::object& index, bool areRings, const py::dict& parameters)
{
	vector<shared_ptr<MpmMaterial>> known;
	for (py::ssize_t i = 0; i < py::len(materials); ++i) {
		known.push_back(py::extract<shared_ptr<MpmMaterial>>(materials[i]));
		known.back()->requireAdmissible();
	}
	const Column<Real>    coordinates(positions, "positions");
	const Column<int64_t> choice(index, "index");
	if (coordinates.size() != 3 * choice.size()) throw std::invalid_argument("positions and index differ in length");
	ParameterColumns own(parameters, choice.size());
	py::list         bodies;
	for (size_t i = 0; i < choice.size(); ++i) {
		const Eigen::Map<const Vector3r> position(coordinates.data() + 3 * i);
		const Real                       around   = areRings ? M_PI * position[0] : halfSize[2];
		const auto&                      material = known.at(choice.data()[i]);
		const auto                       body     = newBody(position, Vector3r(halfSize[0], halfSize[1], around), material);
		own.give(*body, *material, i);
		bodies.append(body);
	}
	return bodies;
}

void warn(const string& text) { log(Severity::warning, "mpm", text); }

void betweenSteps(const py::object& f)
{
	const ValueLock lock;
	f();
}

py::dict columnsOfPoints(int mask, bool withDerived, const py::tuple& besides)
{
	const ValueLock lock;
	const Scene&    scene  = *Singleton<Omega>::instance().getScene();
	const auto      points = materialPoints(scene, mask);
	py::dict        columns;
	for (const PointColumn* column : columnsOf(points))
		if (column->is(PointColumn::inArrays) || (withDerived && column->is(PointColumn::derived)))
			columns[column->name] = valuesOf(*column, points, scene);
	for (py::ssize_t i = 0; i < py::len(besides); ++i)
		if (const PointColumn* column = findColumn(py::extract<string>(besides[i])); column && !columns.has_key(column->name))
			columns[column->name] = valuesOf(*column, points, scene);
	addMaterials(columns, points);
	return columns;
}

} // namespace yade
