// SPDX-License-Identifier: GPL-2.0-or-later
// Utility routines of Abaqus that user materials call: principal values, invariants, rotations, and the end of a run.
// For scripts/wild, which links them to each law.
#include <Eigen/Dense>
#include <cstdio>
#include <cstdlib>

namespace {

/// Tensor of six numbers xx, yy, zz, xy, xz, yz; those like strains have twice the shear components.
Eigen::Matrix3d tensorOf(const double* s, bool isStrain)
{
	const double    part = isStrain ? .5 : 1;
	Eigen::Matrix3d t;
	t << s[0], part * s[3], part * s[4], part * s[3], s[1], part * s[5], part * s[4], part * s[5], s[2];
	return t;
}

} // namespace

extern "C" {

void open_units() __attribute__((weak));

__attribute__((constructor)) static void openUnits()
{
	if (open_units) open_units();
}

/// Principal values, the largest first. `kind`: 1 of a stress, 2 of a strain.
void sprinc_(const double* s, double* principal, const int* kind, const int*, const int*)
{
	Eigen::Map<Eigen::Vector3d> found(principal);
	found = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensorOf(s, *kind == 2), Eigen::EigenvaluesOnly).eigenvalues().reverse();
}

/// Mean of the normal components, and von Mises' equivalent stress.
void sinv_(const double* s, double* mean, double* mises, const int*, const int*)
{
	const Eigen::Matrix3d t = tensorOf(s, false);
	*mean                   = t.trace() / 3;
	*mises                  = std::sqrt(1.5) * (t - *mean * Eigen::Matrix3d::Identity()).norm();
}

/// The tensor turned by R, given column by column.
void rotsig_(const double* s, const double* R, double* turned, const int* kind, const int*, const int*)
{
	const Eigen::Map<const Eigen::Matrix3d> rotation(R);
	const bool                              isStrain = *kind == 2;
	const Eigen::Matrix3d                   t        = rotation * tensorOf(s, isStrain) * rotation.transpose();
	const double                            part     = isStrain ? 2 : 1;
	for (int i = 0; i < 3; ++i)
		turned[i] = t(i, i);
	turned[3] = part * t(0, 1), turned[4] = part * t(0, 2), turned[5] = part * t(1, 2);
}

void xit_()
{
	std::fputs("The law has ended the run (XIT).\n", stderr);
	std::exit(1);
}
}
