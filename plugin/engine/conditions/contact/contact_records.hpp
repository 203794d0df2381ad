// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/terms/contact/contact_system.hpp"
#include "yade_api/types.hpp"

namespace yade {

// Records of an MpmContact about the contact points on the surface of a body that have soil in front of them, as
// numbers one after the other; *body* is an id. Before them all stands a mark; earlier revisions, which kept other
// numbers, had none, but the id of a point.
struct ContactRecords {
	using Record = gimpm::ContactRecord<3>;

	static constexpr int  width = 18;
	static constexpr Real mark  = -width;

	static bool areIn(const vector<Real>& numbers) { return !numbers.empty() && numbers[0] == mark; }
	static void append(const Record& r, vector<Real>& numbers)
	{
		if (numbers.empty()) numbers.push_back(mark);
		for (const Real x : { Real(r.number), Real(r.body), r.gap, r.normalForce, r.areaFraction, r.travel, r.creep, Real(r.touches), Real(r.slips) })
			numbers.push_back(x);
		for (const Vector3r& v : { r.tangentialForce, r.normal, r.position })
			numbers.insert(numbers.end(), v.data(), v.data() + 3);
	}
	static vector<Record> from(const vector<Real>& numbers)
	{
		vector<Record> records;
		for (size_t i = 1; areIn(numbers) && i + width <= numbers.size(); i += width) {
			const Real* x = &numbers[i];
			records.push_back({ int(x[1]), std::int64_t(x[0]), x[2], x[7] != 0, x[8] != 0, x[3], x[4], x[5], x[6], Vector3r::Map(x + 9),
			                    Vector3r::Map(x + 12), Vector3r::Map(x + 15) });
		}
		return records;
	}

	// The same record with another number of dimensions and of the body.
	template <int To, int From> static gimpm::ContactRecord<To> inDimension(const gimpm::ContactRecord<From>& r, int body)
	{
		const auto vector = [](const gimpm::Vec<From>& x) {
			gimpm::Vec<To> result                      = gimpm::Vec<To>::Zero();
			result.template head<std::min(From, To)>() = x.template head<std::min(From, To)>();
			return result;
		};
		return { body,
			 r.number,
			 r.gap,
			 r.touches,
			 r.slips,
			 r.normalForce,
			 r.areaFraction,
			 r.travel,
			 r.creep,
			 vector(r.tangentialForce),
			 vector(r.normal),
			 vector(r.position) };
	}
};

} // namespace yade
