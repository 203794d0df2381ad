// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/bulkAccess.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/columns.hpp"
#include "yade_api/logging.hpp"
#include <algorithm>
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
	// The columns in this order, a bytearray each: of int64 or float64.
	py::dict tableOf(const vector<const PointColumn*>& columns, const vector<MaterialPoint>& points, const Scene& scene)
	{
		py::dict             table;
		vector<ColumnRows>   rows;
		vector<vector<Real>> integerRows(columns.size());
		for (size_t c = 0; c < columns.size(); ++c) {
			const size_t numbers = points.size() * columns[c]->width;
			if (columns[c]->isInteger) {
				integerRows[c].resize(numbers);
				rows.push_back({ columns[c], integerRows[c].data() });
				table[columns[c]->name] = py::object();
			} else {
				const auto [bytes, first] = newBytes<Real>(numbers);
				rows.push_back({ columns[c], first });
				table[columns[c]->name] = bytes;
			}
		}
		fillRows(rows, points, scene);
		for (size_t c = 0; c < columns.size(); ++c)
			if (const auto& values = integerRows[c]; columns[c]->isInteger)
				table[columns[c]->name] = integers(points.size(), [&](size_t i) { return int64_t(values[i]); });
		return table;
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
	const ValueLock            lock;
	const Scene&               scene  = *Singleton<Omega>::instance().getScene();
	const auto                 points = materialPoints(scene, mask);
	vector<const PointColumn*> columns;
	for (const PointColumn* column : columnsOf(points))
		if (column->is(PointColumn::inArrays) || (withDerived && column->is(PointColumn::derived))) columns.push_back(column);
	for (py::ssize_t i = 0; i < py::len(besides); ++i)
		if (const PointColumn* column = findColumn(py::extract<string>(besides[i]));
		    column && std::find(columns.begin(), columns.end(), column) == columns.end())
			columns.push_back(column);
	py::dict table = tableOf(columns, points, scene);
	addMaterials(table, points);
	return table;
}

} // namespace yade
