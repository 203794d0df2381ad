// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/MpmState.hpp"
#include "core/materials/internal_variables.hpp"
#include "yade_api/registration.hpp"
#include <algorithm>
#include <set>

namespace yade {

namespace {
	auto named(std::string_view name)
	{
		return [name](const std::pair<string, Real>& entry) { return entry.first == name; };
	}
}

const Real* MpmState::find(const Entries& entries, std::string_view name)
{
	const auto found = std::find_if(entries.begin(), entries.end(), named(name));
	return found == entries.end() ? nullptr : &found->second;
}

void MpmState::setEntry(Entries& entries, std::string_view name, Real value)
{
	if (const auto found = std::find_if(entries.begin(), entries.end(), named(name)); found != entries.end()) found->second = value;
	else
		entries.emplace_back(name, value);
}

const Real* MpmState::parameter(std::string_view name) const { return find(parameters, name); }

// Ranges of a class of materials are checked where the class is known.
bool MpmState::areParameters(const OwnParameters& entries)
{
	std::set<std::string_view> names;
	return std::all_of(entries.begin(), entries.end(), [&](const auto& entry) {
		return isParameter(entry.first) && !std::isnan(entry.second) && names.insert(entry.first).second;
	});
}

bool MpmState::areInternals(const vector<std::pair<string, Real>>& entries)
{
	if (entries.empty()) return true;
	std::set<std::string_view> names { ownAttribute };
	return std::all_of(entries.begin(), entries.end(), [&](const auto& entry) {
		const size_t variable = gimpm::internalVariables.find(entry.first);
		return variable < gimpm::internalVariables.size() && gimpm::internalVariables[variable].admits(entry.second)
		        && names.insert(entry.first).second;
	});
}

// Compares number by number, which takes far less time than expressions of matrices: this is called for each point in
// each step.
bool MpmState::isSymmetric(const Matrix3r& m)
{
	Real largest = 0;
	for (int i = 0; i < 9; ++i) {
		if (!std::isfinite(m.data()[i])) return false;
		largest = std::max(largest, std::abs(m.data()[i]));
	}
	return std::max({ std::abs(m(0, 1) - m(1, 0)), std::abs(m(1, 2) - m(2, 1)), std::abs(m(2, 0) - m(0, 2)) }) <= 1e-12 * largest;
}

bool MpmState::preservesOrientation(const Matrix3r& m) { return m.allFinite() && m.determinant() > 0; }

void MpmState::requireAdmissible() const
{
	for (const auto& [name, position] : { std::pair { "pos", pos }, std::pair { "refPos", refPos } })
		if (!position.allFinite()) {
			std::ostringstream text;
			text << "MpmState." << name << " = (" << position[0] << ", " << position[1] << ", " << position[2]
			     << ") is not admitted: expected three finite numbers [m].";
			throw std::invalid_argument(text.str());
		}
	ExposedIndexed<MpmState, State>::requireAdmissible();
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmState)
static const yade::PluginClasses<yade::MpmState> registeredMpmState(__FILE__);
