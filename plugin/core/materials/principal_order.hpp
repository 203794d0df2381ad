// SPDX-License-Identifier: GPL-2.0-or-later
// Principal values from the largest to the smallest, and the way back.
#pragma once
#include "core/materials/response.hpp"

namespace gimpm {

/// Three exchanges of neighbours sort three values, without a branch.
template <class T> class PrincipalOrder {
public:
	GIMPM_INLINE explicit PrincipalOrder(const PrincipalValues<T>& values) : sorted(values)
	{
		for (int exchange = 0; exchange < 3; ++exchange) {
			const int first        = exchange % 2;
			isExchanged_[exchange] = sorted[first + 1] > sorted[first];
			this->exchange(exchange, sorted);
		}
	}
	/// Values of the sorted axes, in the order that the axes had.
	GIMPM_INLINE PrincipalValues<T> restored(PrincipalValues<T> values) const
	{
		for (int exchange = 2; exchange >= 0; --exchange)
			this->exchange(exchange, values);
		return values;
	}

	PrincipalValues<T> sorted;

private:
	GIMPM_INLINE void exchange(int number, PrincipalValues<T>& values) const
	{
		const int first = number % 2;
		const T   a = values[first], b = values[first + 1];
		values[first]     = select(isExchanged_[number], b, a);
		values[first + 1] = select(isExchanged_[number], a, b);
	}

	std::array<decltype(T() > T()), 3> isExchanged_;
};

} // namespace gimpm
