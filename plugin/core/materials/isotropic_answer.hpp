// SPDX-License-Identifier: GPL-2.0-or-later
// The answer of an isotropic law that is a tensor law for other reasons: that it is not in the table of the kernels,
// because its return takes long, or that it depends on the step of time.
#pragma once
#include "core/materials/tensor_law.hpp"

namespace gimpm {

/// d stress / d strain of a response in principal axes, which are the columns of `axes`, in Mandel's numbers: along the
/// axes the tangent, and for each pair of them twice the secant shear modulus.
inline Mandel tangentOf(const Response& response, const Mat3& axes)
{
	const auto along   = [&](int i, int j) { return toMandel(Mat3(axes.col(i) * axes.col(j).transpose())); };
	Mandel     tangent = Mandel::Zero();
	for (int i = 0; i < 3; ++i) {
		for (int j = 0; j < 3; ++j)
			tangent += response.tangent(i, j) * along(i, i) * along(j, j).transpose();
		const int  j      = (i + 1) % 3;
		const Vec6 shared = along(i, j); // tensor of length sqrt(1/2)
		tangent += 4 * response.shear[i] * shared * shared.transpose();
	}
	return tangent;
}

/// respond(principal trial strains, state, which it changes) is the response of the law.
template <class F> TensorAnswer answerInPrincipalAxes(const TensorStep& step, F&& respond)
{
	const Principal<3> trial = principal(SymTensor<3>::from(step.trialStrain));
	TensorAnswer       answer(step.state);
	const Response     r = respond(trial.value, answer.state);
	answer.failed        = r.failed != 0;
	if (answer.failed) return answer;
	answer.stress        = trial.axes * r.stress.asDiagonal() * trial.axes.transpose();
	answer.elasticStrain = trial.axes * r.elasticStrain.asDiagonal() * trial.axes.transpose();
	if (step.wantsTangent) answer.tangent = tangentOf(r, trial.axes);
	return answer;
}

} // namespace gimpm
