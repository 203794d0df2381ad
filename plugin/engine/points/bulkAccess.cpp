// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/bulkAccess.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/columns.hpp"
#include "yade_api/logging.hpp"
#include <unordered_map>

namespace yade {

namespace {
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

void warn(const string& text) { log(Severity::warning, "mpm", text); }

py::object idsOfPoints()
{
	const ValueLock lock;
	const auto      points = materialPoints(*Singleton<Omega>::instance().getScene());
	return integers(points.size(), [&](size_t i) { return int64_t(points[i].id); });
}

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
