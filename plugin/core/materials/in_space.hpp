// SPDX-License-Identifier: GPL-2.0-or-later
// A principal law as a tensor law: for what only tensor laws can, as to depend on the step of time.
#pragma once
#include "core/materials/isotropic_answer.hpp"

namespace gimpm {

template <class L> class InSpace : public TensorLaw {
	template <std::size_t... k> static constexpr std::array<TensorVariable, sizeof...(k)> asTensorVariables(std::index_sequence<k...>)
	{
		return { TensorVariable(L::variables[k])... };
	}

public:
	/// Poisson's ratio is that of laws whose stress is linear in the elastic strain.
	explicit InSpace(const L& law, double poisson = 0) : law_(law), poisson_(poisson) { }

	static constexpr auto variables = asTensorVariables(std::make_index_sequence<L::variables.size()>());
	static constexpr bool mayFail = L::mayFail, isElastic = L::isElastic, isLinear = L::isLinear, canBeWeakened = L::canBeWeakened;

	TensorState initialInternals() const { return stateOf(law_.initialInternals(), TensorState(variables)); }

	using Parameters = typename L::Parameters;
	Parameters parameters() const { return law_.parameters(); }
	InSpace    with(const Parameters& p) const { return InSpace(law_.with(p), poisson_); }
	Parameters weakened(const Weakening& w) const { return law_.weakened(w); }
	bool       isSymmetric() const { return law_.isSymmetric(); }

	double young(const TensorState& state) const
	{
		if constexpr (L::isLinear) return law_.young(numbersOf(state));
		else
			return law_.young(numbersOf(state), 0); // the largest that the law says of these variables
	}
	TensorAnswer respond(const TensorStep& step) const
	{
		return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) -> Response {
			const auto r = law_.respond(strain, numbersOf(state));
			state        = stateOf(r.internals, state);
			return r;
		});
	}
	/// Response without plastic flow.
	TensorAnswer elastic(const TensorStep& step) const
	{
		return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) -> Response {
			if constexpr (L::isLinear) return elasticity().respond(strain, {});
			else {
				auto numbers = numbersOf(state);
				numbers[1]   = std::numeric_limits<double>::max(); // preconsolidation out of reach
				return law_.respond(strain, numbers);
			}
		});
	}
	/// The elastic strain of a stress.
	Mat3 strainOf(const Mat3& stress, const TensorState&) const
	{
		const auto p = principal(SymTensor<3>::from(stress));
		Vec3       strain;
		if constexpr (L::isLinear) strain = elasticity().template strainOf<double>(p.value);
		else
			strain = law_.strainOf(p.value);
		return p.axes * strain.asDiagonal() * p.axes.transpose();
	}

	/// Half of the loss of stress beyond yield for each plastic strain, the length of its deviator [Pa]: by the
	/// tangent D along the deviator, 4 G^2 / (2 G - D) / 2. It is that of shear far beyond yield, under the largest
	/// pressure at which the law flows then.
	template <class Linear = L, class = std::enable_if_t<Linear::isLinear>> double resistance() const
	{
		const Vec3   direction = Vec3(1, 0, -1) / std::sqrt(2.);
		const double G = elasticity().shear(), largest = 1e3, smallest = 1e-3;
		for (double compression = largest; compression > smallest; compression *= .9) {
			const auto   r     = law_.respond(Vec3(largest * direction - compression * Vec3::Ones()), law_.initialInternals());
			const double along = direction.dot(r.tangent * direction);
			if (along < 2 * G * (1 - 1e-9)) return 2 * G * G / (2 * G - along);
		}
		return G;
	}

private:
	using Numbers = decltype(std::declval<const L&>().initialInternals());

	const L law_;
	double  poisson_;

	Hencky      elasticity() const { return { law_.parameters()[0], poisson_ }; }
	static auto numbersOf(const TensorState& state)
	{
		Numbers numbers;
		std::copy_n(state.numbers(), numbers.size(), numbers.begin());
		return numbers;
	}
	static TensorState stateOf(const Numbers& numbers, TensorState state)
	{
		std::copy(numbers.begin(), numbers.end(), state.numbers());
		return state;
	}
};

} // namespace gimpm
