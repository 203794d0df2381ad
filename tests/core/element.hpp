// SPDX-License-Identifier: GPL-2.0-or-later
// A material point of a tensor law on a path of strains along its axes, for tests of such laws.
#pragma once
#include "core/materials/tensor_law.hpp"
#include "scenes.hpp"

namespace gimpm {

/// Pressures and compression are positive here.
template <class L> struct Element {
	L           law;
	TensorState state;
	Mat3        elasticStrain = Mat3::Zero();
	Mat3        stress        = Mat3::Zero();
	double      volume        = 0; ///< volumetric strain, as ln det F

	explicit Element(const L& of) : law(of), state(of.initialInternals()) { }

	/// Under principal pressures that it has been made to bear.
	void press(const Vec3& pressures)
	{
		stress        = Mat3(Vec3(-pressures).asDiagonal());
		state         = law.bearing(stress, state);
		elasticStrain = law.strainOf(stress, state);
	}
	TensorAnswer ask(const Mat3& strain, double duration = 0) const
	{
		const auto p = principal(SymTensor<3>::from(strain));
		const Mat3 U = p.axes * Vec3(p.value.array().exp()).asDiagonal() * p.axes.transpose();
		return law.respond({ elasticStrain + strain, U, duration, state });
	}
	void apply(const Mat3& strain, double duration = 0)
	{
		const TensorAnswer answer = ask(strain, duration);
		ASSERT_FALSE(answer.failed);
		stress = answer.stress, elasticStrain = answer.elasticStrain, state = answer.state, volume += strain.trace();
	}
	void apply(const Vec3& strain, double duration = 0) { apply(Mat3(strain.asDiagonal()), duration); }

	/// Shortened by `strain` along y, while the pressures along x and z stay `kept`, alike.
	void compress(double strain, double kept)
	{
		Vec3 e(0, -strain, 0);
		for (int iteration = 0; iteration < 50; ++iteration) {
			const auto   answer   = ask(Mat3(e.asDiagonal()));
			const double residual = answer.stress(0, 0) + kept;
			if (answer.failed || std::abs(residual) < 1e-10 * kept) break;
			e[0] = e[2] = e[0] - residual / (answer.tangent(0, 0) + answer.tangent(0, 2));
		}
		apply(e);
		ASSERT_NEAR(stress(0, 0), -kept, 1e-8 * kept);
	}
	double pressure() const { return -stress.trace() / 3; }
	double difference() const { return std::sqrt(1.5) * (stress - stress.trace() / 3 * Mat3::Identity()).norm(); }

	/// Relative error of the tangent after a strain, from differences with steps of a part of it.
	double tangentError(const Mat3& strain, double part, double least) const
	{
		const double h = part * strain.norm();
		Mandel       differences;
		for (int c = 0; c < 6; ++c) {
			const auto at      = [&](double s) { return toMandel(ask(strain + fromMandel(s * h * Vec6::Unit(c))).stress); };
			differences.col(c) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
		}
		return (differences - ask(strain).tangent).norm() / (least + differences.norm());
	}
};

/// Part of these errors, of those that differ by no corner of a law between the points of a difference.
inline double partBelow(const std::vector<double>& errors, double limit)
{
	return double(std::count_if(errors.begin(), errors.end(), [&](double e) { return e < limit; })) / double(errors.size());
}

} // namespace gimpm
