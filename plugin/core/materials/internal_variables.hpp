// SPDX-License-Identifier: GPL-2.0-or-later
// The internal variables that there are. Those of the principal laws come first; those of tensor laws are added when
// the library with the law is opened, or when the first law of its kind is made.
#pragma once
#include "core/materials/internal_variable.hpp"
#include <deque>
#include <string_view>

namespace gimpm {

/// Column i of InternalColumns has the values of variable i.
struct InternalVariables {
	static const std::deque<InternalVariable>& all();

	auto                    begin() const { return all().begin(); }
	auto                    end() const { return all().end(); }
	std::size_t             size() const { return all().size(); }
	const InternalVariable& operator[](std::size_t i) const { return all()[i]; }

	int find(std::string_view name) const; ///< -1: there is none

	/// The column of the variable with this name, which is added if there is none. What is there stays where it is.
	int add(const InternalVariable&) const;
};
inline constexpr InternalVariables internalVariables {};

} // namespace gimpm
