// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/beam_element.hpp"
#include <Eigen/LU>

namespace gimpm {
namespace {

/// True if moments with these bounds active are the ones nearest to the elastic ones, in the energy of the turns: those
/// within their bounds do not yield, those at a bound yield in its direction.
bool areAdmissible(const Vec<2>& moment, const Vec<2>& yielded, const std::array<int, 2>& atBound, const Vec<2>& strength, const Vec<2>& scale)
{
	constexpr double roundOff = 1e-12;
	for (int i = 0; i < 2; ++i) {
		if (atBound[i] == 0 && std::abs(moment[i]) > strength[i] * (1 + roundOff)) return false;
		if (atBound[i] != 0 && atBound[i] * yielded[i] < -roundOff * scale[i]) return false;
	}
	return true;
}

/// The moments with some of them at their bounds; the others follow from the turns that are left to them.
EndMoments withBounds(const Mat<2>& k, const Vec<2>& trial, const std::array<int, 2>& atBound, const Vec<2>& strength)
{
	EndMoments found { trial, Vec<2>::Zero(), k };
	if (atBound[0] != 0 && atBound[1] != 0) {
		found.moment = { atBound[0] * strength[0], atBound[1] * strength[1] };
		found.tangent.setZero();
	} else
		for (int i = 0; i < 2; ++i) {
			if (atBound[i] == 0) continue;
			const int j     = 1 - i;
			found.moment[i] = atBound[i] * strength[i];
			found.moment[j] = trial[j] + k(j, i) / k(i, i) * (found.moment[i] - trial[i]);
			found.tangent   = k - k.col(i) * k.row(i) / k(i, i);
			found.tangent.row(i).setZero();
			found.tangent.col(i).setZero();
		}
	return found;
}

} // namespace

EndMoments endMoments(const BeamPiece& piece, const BeamSection& section, const Vec<2>& turns)
{
	const Mat<2> k     = section.bendingStiffness / piece.length0 * (Mat<2>() << 4, 2, 2, 4).finished();
	const Mat<2> soft  = k.inverse();
	const Vec<2> trial = k * turns, scale = Vec<2>::Constant(turns.cwiseAbs().sum());
	for (const int first : { 0, 1, -1 })
		for (const int second : { 0, 1, -1 }) {
			const std::array<int, 2> atBound { first, second };
			if ((first != 0 && !std::isfinite(piece.strength[0])) || (second != 0 && !std::isfinite(piece.strength[1]))) continue;
			EndMoments found = withBounds(k, trial, atBound, piece.strength);
			found.yielded    = soft * (trial - found.moment);
			if (!areAdmissible(found.moment, found.yielded, atBound, piece.strength, scale)) continue;
			found.energy = found.moment.dot(turns) - found.moment.dot(soft * found.moment) / 2;
			return found;
		}
	return { Vec<2>::Constant(std::numeric_limits<double>::quiet_NaN()), Vec<2>::Zero(), k };
}

BeamShape::BeamShape(const BeamPiece& piece, const Eigen::Matrix<double, 6, 1>& u)
{
	const Vec<2> apart = u.segment<2>(3) - u.head<2>(), now = piece.along + apart;
	const double before = piece.along.norm();
	length              = now.norm();
	direction           = now / length;
	elongation          = piece.elongation + apart.dot(2 * piece.along + apart) / (length + before);
	// Turn of the chord, counterclockwise.
	const double turn = std::atan2(piece.along[0] * apart[1] - piece.along[1] * apart[0], piece.along.dot(now));
	turns             = piece.turns + Vec<2>(u[2] - turn, u[5] - turn);
}

Energy<6> energyOf(const BeamPiece& piece, const BeamSection& section, const Eigen::Matrix<double, 6, 1>& u)
{
	using Vec6 = Eigen::Matrix<double, 6, 1>;
	const BeamShape  shape(piece, u);
	const EndMoments ends = endMoments(piece, section, shape.turns);
	const double     l = shape.length, c = shape.direction[0], s = shape.direction[1];
	const double     axial = section.axialStiffness / piece.length0, N = axial * shape.elongation;
	Vec6             r, z;
	r << -c, -s, 0, c, s, 0;
	z << s, -c, 0, -s, c, 0;
	Eigen::Matrix<double, 6, 2> B;
	B.col(0) = Vec6::Unit(2) - z / l;
	B.col(1) = Vec6::Unit(5) - z / l;

	Energy<6> energy;
	energy.value    = N * shape.elongation / 2 + ends.energy;
	energy.gradient = N * r + B * ends.moment;
	energy.hessian  = axial * r * r.transpose() + B * ends.tangent * B.transpose() + N / l * z * z.transpose()
	        + ends.moment.sum() / (l * l) * (r * z.transpose() + z * r.transpose());
	return energy;
}

} // namespace gimpm
