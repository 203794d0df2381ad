// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/bodies/contact_records.hpp"

namespace yade {

vector<int> partsOf(const MpmGrid& grid, const string& body)
{
	vector<int> parts;
	for (size_t b = 0; b < grid.bodies.size(); ++b)
		if (grid.bodies[b]->name == body || grid.bodies[b]->partOf == body) parts.push_back(int(b));
	return parts;
}

vector<std::pair<int, int>> pairsOf(const MpmBodyContact& contact, const MpmGrid& grid)
{
	vector<std::pair<int, int>> pairs;
	for (const int one : partsOf(grid, contact.between[0]))
		for (const int other : partsOf(grid, contact.between[1]))
			if (!contact.isOfOne() || one < other || (contact.folds && one == other)) pairs.emplace_back(one, other);
	return pairs;
}

// True if stresses of one pair only are kept, without its numbers.
static bool isSingle(const MpmBodyContact& contact, const MpmGrid& grid) { return !contact.isOfOne() && pairsOf(contact, grid).size() == 1; }

vector<ContactRecord> recordsOf(const MpmBodyContact& contact, const MpmGrid& grid)
{
	if (contact.slave < 0) return {};
	if (contact.pairs.empty() && !contact.isOfOne())
		return { { grid.bodyNamed(contact.between[contact.slave]), grid.bodyNamed(contact.between[1 - contact.slave]), contact.pressures,
			   contact.shears } };
	vector<ContactRecord> records;
	int                   first = 0;
	for (const auto& pair : contact.pairs) {
		const int last = first + pair[2];
		records.push_back({ pair[0], pair[1], vector<Real>(contact.pressures.begin() + first, contact.pressures.begin() + last),
		                    vector<Vector3r>(contact.shears.begin() + first, contact.shears.begin() + last) });
		first = last;
	}
	return records;
}

void keepRecords(MpmBodyContact& contact, const MpmGrid& grid, const vector<ContactRecord>& records)
{
	contact.pairs.clear(), contact.pressures.clear(), contact.shears.clear();
	for (const ContactRecord& record : records) {
		if (!isSingle(contact, grid)) contact.pairs.push_back({ record.slave, record.master, int(record.pressures.size()) });
		contact.pressures.insert(contact.pressures.end(), record.pressures.begin(), record.pressures.end());
		contact.shears.insert(contact.shears.end(), record.shears.begin(), record.shears.end());
	}
}

} // namespace yade
