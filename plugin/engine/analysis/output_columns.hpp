// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Output of a state: numbers for tables, and cells with fields for VTK and pictures.
#include "yade_api/types.hpp"

namespace yade {

// Columns of plotData().
class Rows {
public:
	explicit Rows(py::dict& to) : to(to) { }

	template <class T> void set(const string& name, const T& value) { to[name] = value; }

	// A column for each direction of the grid: load0_x, load0_y ...
	void setVector(const string& name, const Vector3r& value, int dim)
	{
		for (int axis = 0; axis < dim; ++axis)
			to[name + "_" + "xyz"[axis]] = value[axis];
	}

private:
	py::dict& to;
};

// Vertices, segments, triangles and quadrilaterals, each with as many numbers of each field as that is wide.
// Conditions of one kind of picture share it: where one has no number of a field, it is NaN, or -1 of whole numbers.
class Picture {
public:
	struct Field {
		string       name;
		int          width;
		bool         isWhole;
		vector<Real> values;
	};
	vector<Vector3r>    corners;
	vector<vector<int>> cells;
	vector<Field>       fields;

	// A cell, by the numbers of its corners, whose fields are given in the following.
	void add(const vector<int>& cell) { cells.push_back(cell); }
	void set(const string& name, const Vector3r& value) { set(name, 3, false, value.data()); }
	void set(const string& name, Real value) { set(name, 1, false, &value); }
	void set(const string& name, int value)
	{
		const Real number = value;
		set(name, 1, true, &number);
	}

	// So that a picture without cells has its fields, too.
	Field& field(const string& name, int width, bool isWhole)
	{
		for (Field& known : fields)
			if (known.name == name) return known;
		fields.push_back({ name, width, isWhole, {} });
		return fields.back();
	}

	// Once all are there.
	void complete()
	{
		for (Field& f : fields)
			fill(f, cells.size());
	}

private:
	static void fill(Field& f, size_t count) { f.values.resize(count * f.width, f.isWhole ? -1 : std::numeric_limits<Real>::quiet_NaN()); }
	void        set(const string& name, int width, bool isWhole, const Real* values)
	{
		Field& f = field(name, width, isWhole);
		fill(f, cells.size() - 1);
		f.values.insert(f.values.end(), values, values + width);
	}
};

} // namespace yade
