// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/split_contacts.hpp"
#include "engine/conditions/contact/contact_records.hpp"
#include <map>

namespace yade {

namespace {
	// Of the area that a corner stands for, the part of the faces across the axis: halves have these to themselves,
	// and share the others. A corner that does not touch, and remembers nothing but its offset, has no normal.
	Real partAcross(const HalvedDomain& domain, const Vector3r& normal)
	{
		Vector3r faces = Vector3r::Zero();
		for (int a = 0; a < domain.dim; ++a)
			faces[a] = std::abs(normal[a]) / domain.halfSize[a];
		return normal.isZero(0) ? 0 : faces[domain.axis] / faces.sum();
	}

	Vector3r placeOf(const HalvedDomain& domain, bool isUpper, int corner)
	{
		Vector3r place(domain.middle.data());
		for (int a = 0; a < domain.dim; ++a) {
			const Real sign = corner >> a & 1 ? 1 : -1;
			place[a] += a == domain.axis ? domain.halfSize[a] / 2 * (sign + (isUpper ? 1 : -1)) : sign * domain.halfSize[a];
		}
		return place;
	}

	using Key = std::tuple<int, int, int>; // point, corner, body

	class Shared {
	public:
		void add(const ContactRecordOfPoint& from, const HalvedDomain& domain, bool isUpper, int corner, Real part)
		{
			if (part == 0) return;
			const int point             = isUpper ? domain.upper : domain.lower;
			const auto [found, isFirst] = records.try_emplace(Key { point, corner, from.body }, from);
			auto& to                    = found->second;
			pressing[found->first] += from.touches;
			if (isFirst) {
				to.point = point, to.corner = corner;
				to.pressure = part * from.pressure, to.friction = part * from.friction;
				to.place = placeOf(domain, isUpper, corner);
			} else { // from the other side of where the halves meet, where a round body has another normal
				const Vector3r push = to.pressure * to.normal + part * from.pressure * from.normal;
				to.pressure         = push.norm();
				if (to.pressure > 0) to.normal = push / to.pressure;
				to.friction += part * from.friction;
				to.offset  = (to.offset + from.offset) / 2;
				to.gap     = (to.gap + from.gap) / 2;
				to.touches = to.touches || from.touches;
				to.slips   = to.slips || from.slips;
			}
		}
		// Where the halves meet. Of two corners of the whole beside it, one that has not touched has felt
		// nothing.
		void fit(const HalvedDomain& domain, bool isUpper, int corner, const KnownBody& body)
		{
			const Vector3r place = placeOf(domain, isUpper, corner);
			const Key      key { isUpper ? domain.upper : domain.lower, corner, body.id };
			const auto     found    = records.find(key);
			const bool     isKnown  = found != records.end();
			const Real     felt     = isKnown && pressing[key] > 0 ? found->second.gap * pressing[key] / 2 : 0;
			const Real     distance = body.distance(place), roundOff = 1e-9 * domain.halfSize[domain.axis];
			if (distance >= felt + (isKnown ? found->second.offset : 0) - roundOff) return;
			const Vector3r none = Vector3r::Zero();
			if (!isKnown)
				records.emplace(
				        key, ContactRecordOfPoint { std::get<0>(key), corner, body.id, distance, 0, 0, false, false, none, none, place });
			else
				found->second.gap = felt, found->second.offset = distance - felt;
		}
		void appendTo(vector<Real>& numbers) const
		{
			for (const auto& [key, record] : records)
				record.appendTo(numbers);
		}

	private:
		std::map<Key, ContactRecordOfPoint> records;
		// How many of the corners from which they are have touched.
		std::map<Key, int> pressing;
	};
}

void shareRecords(MpmContact& contact, const HalvedDomain& domain, const vector<KnownBody>& bodies)
{
	vector<Real> kept;
	Shared       shared;
	forRecords(contact.records, [&](const ContactRecordOfPoint& r) {
		if (r.point != domain.lower) return r.appendTo(kept);
		const Real across  = partAcross(domain, r.normal);
		const bool isUpper = r.corner >> domain.axis & 1;
		const int  inner   = r.corner ^ (1 << domain.axis);
		shared.add(r, domain, isUpper, r.corner, across + (1 - across) / 2);
		shared.add(r, domain, isUpper, inner, (1 - across) / 4);
		shared.add(r, domain, !isUpper, r.corner, (1 - across) / 4);
	});
	for (const KnownBody& body : bodies)
		for (int corner = 0; corner < 1 << domain.dim; ++corner)
			shared.fit(domain, !(corner >> domain.axis & 1), corner, body);
	shared.appendTo(kept);
	contact.records.swap(kept);
}

} // namespace yade
