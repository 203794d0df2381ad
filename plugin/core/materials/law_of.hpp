// SPDX-License-Identifier: GPL-2.0-or-later
// Common part of the handles of principal laws and of tensor laws.
#pragma once
#include "core/materials/law.hpp"

namespace gimpm {

template <class L> class LawOf : public AnyLaw {
public:
	explicit LawOf(const L& law) : own_(law)
	{
		isElastic     = L::isElastic;
		isLinear      = L::isLinear;
		canBeWeakened = L::canBeWeakened;
	}

	bool isSymmetric(const ParameterColumns& parameters, std::size_t point) const override
	{
		return withParameters(own_, parameters, point, [](const auto& law) { return law.isSymmetric(); });
	}
	std::vector<double> parameters() const override { return listOf(own_.parameters()); }
	std::vector<double> weakened(const ParameterColumns& parameters, std::size_t point, const Weakening& by) const override
	{
		return withParameters(own_, parameters, point, [&](const auto& law) { return listOf(law.with(law.weakened(by)).parameters()); });
	}
	Law with(const std::vector<double>& parameters) const override
	{
		auto values = own_.parameters();
		std::copy_n(parameters.begin(), values.size(), values.begin());
		return own_.with(values);
	}

protected:
	template <class Values> static std::vector<double> listOf(const Values& values) { return { values.begin(), values.end() }; }

	const L own_;
};

} // namespace gimpm
