// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/types.hpp"

namespace yade {

// Record of an MpmContact about a contact point on the surface of a body that has soil in front of it, as numbers one
// after the other. Before them all stands a mark; earlier revisions, which kept other numbers, had none, but the id of
// a point.
struct ContactPointRecord {
	static constexpr int  width = 18;
	static constexpr Real mark  = -width;

	std::int64_t number;
	int          body; // id
	Real         gap, normalForce, areaFraction, travel, creep;
	bool         touches, slips;
	Vector3r     tangentialForce, normal, position;

	static ContactPointRecord from(const Real* x)
	{
		return { std::int64_t(x[0]),   int(x[1]), x[2], x[3], x[4], x[5], x[6], x[7] != 0, x[8] != 0, Vector3r::Map(x + 9), Vector3r::Map(x + 12),
			 Vector3r::Map(x + 15) };
	}
	static bool areIn(const vector<Real>& numbers) { return !numbers.empty() && numbers[0] == mark; }
	void        appendTo(vector<Real>& numbers) const
	{
		if (numbers.empty()) numbers.push_back(mark);
		for (const Real x : { Real(number), Real(body), gap, normalForce, areaFraction, travel, creep, Real(touches), Real(slips) })
			numbers.push_back(x);
		for (const Vector3r& v : { tangentialForce, normal, position })
			numbers.insert(numbers.end(), v.data(), v.data() + 3);
	}
	Vector3r force() const { return normalForce * normal + tangentialForce; } // on the soil [N]
};

// Calls f(record) for each of them.
template <class F> void forRecords(const vector<Real>& numbers, F&& f)
{
	if (!ContactPointRecord::areIn(numbers)) return;
	for (size_t i = 1; i + ContactPointRecord::width <= numbers.size(); i += ContactPointRecord::width)
		f(ContactPointRecord::from(&numbers[i]));
}

} // namespace yade
