// SPDX-License-Identifier: GPL-2.0-or-later
// Expectations of every law of soil, and strains to ask it for.
#pragma once
#include "core/materials/kinematics.hpp"
#include "core/materials/law.hpp"
#include "scenes.hpp"
#include <Eigen/LU>

namespace gimpm::soil {

constexpr double degree = 0.017453292519943295;

inline Vec3 deviator(const Vec3& v) { return v.array() - v.sum() / 3; }

inline Vec3 descending(Vec3 v)
{
	std::sort(v.data(), v.data() + 3, std::greater<>());
	return v;
}

/// Trial strains of some 1e-3 in all directions, and with two that are nearly equal.
inline std::vector<Vec3> soilStrains(int count)
{
	std::vector<Vec3> strains;
	Random            random(5);
	for (int i = 0; i < count; ++i) {
		Vec3 e = random.matrix<3>(std::pow(10, random.in(-4.5, -2))) + random.in(-3e-3, 3e-3) * Vec3::Ones();
		if (i % 4 == 0) e[i % 3] = e[(i + 1) % 3] * (1 + random.in(-0.05, 0.05));
		strains.push_back(e);
	}
	return strains;
}

template <class L> auto respondTo(const L& law, const Vec3& strain) { return law.respond(strain, law.initialInternals()); }

/// Strain in thousandths.
template <class L> void expectStress(const L& law, const Vec3& strain, const Vec3& stress)
{
	EXPECT_LT((respondTo(law, 1e-3 * strain).stress - stress).cwiseAbs().maxCoeff(), 6e-4) << strain.transpose();
}

/// Stress belongs to the elastic strain, and the secant shear moduli to the differences of stresses.
template <class L, class R> void expectConsistent(const L& law, const Hencky& elastic, const Vec3& e, const R& r)
{
	const double size = elastic.young() * e.norm();
	EXPECT_LT((elastic.respond(r.elasticStrain, {}).stress - r.stress).norm(), 1e-13 * size);
	EXPECT_LT((respondTo(law, r.elasticStrain).stress - r.stress).norm(), 1e-12 * size) << "stays where it was returned to";
	for (int p = 0; p < 3; ++p) {
		const int i = p, j = (p + 1) % 3;
		EXPECT_NEAR(r.stress[i] - r.stress[j], 2 * r.shear[p] * (e[i] - e[j]), 3e-6 * elastic.shear() * std::abs(e[i] - e[j]) + 1e-13 * size);
		EXPECT_GE(r.shear[p], 0);
		EXPECT_LE(r.shear[p], elastic.shear() * (1 + 1e-12));
	}
}

template <class L> Mat3 stressDifferences(const L& law, const Vec3& e, double step)
{
	Mat3 D;
	for (int j = 0; j < 3; ++j)
		D.col(j) = (respondTo(law, e + step * Vec3::Unit(j)).stress - respondTo(law, e - step * Vec3::Unit(j)).stress) / (2 * step);
	return D;
}

/// Against central differences, where no boundary between sectors is near; relative to the elastic stiffness.
template <class L> void expectTangents(const L& law, const Hencky& elastic, const std::vector<Vec3>& strains)
{
	std::size_t compared = 0;
	for (const Vec3& e : strains) {
		const double step = 1e-6 * e.norm();
		const Mat3   D = respondTo(law, e).tangent, fine = stressDifferences(law, e, step), coarse = stressDifferences(law, e, 3 * step);
		const double size = elastic.respond(e, {}).tangent.norm();
		if ((fine - coarse).norm() > 1e-5 * size) continue;
		++compared;
		EXPECT_LT((D - fine).norm(), 1e-6 * size) << e.transpose() << "\n" << D << "\n" << fine;
		if (law.isSymmetric()) {
			EXPECT_LT((D - D.transpose()).norm(), 1e-14 * size);
		}
	}
	EXPECT_GT(compared, strains.size() * 9 / 10);
}

template <class L> void expectSameStressNear(const L& law, double young, const Vec3& e)
{
	const Vec3 stress = respondTo(law, e).stress;
	Random     random(3);
	for (int i = 0; i < 20; ++i) {
		const Vec3 near = e + 1e-15 * e.norm() * random.matrix<3>();
		EXPECT_LE((respondTo(law, near).stress - stress).norm(), 1e-13 * young * e.norm()) << e.transpose();
	}
}

/// Also the tangent: none of the strains near is in another sector.
template <class L> void expectSameResponseNear(const L& law, double young, const Vec3& e)
{
	expectSameStressNear(law, young, e);
	const Mat3 D = respondTo(law, e).tangent;
	Random     random(4);
	for (int i = 0; i < 20; ++i) {
		const Vec3 near = e + 1e-15 * e.norm() * random.matrix<3>();
		EXPECT_LE((respondTo(law, near).tangent - D).norm(), 1e-6 * young) << e.transpose();
	}
}

/// Between strains in different sectors, which have different tangents, halves the way until a boundary is found to the
/// last bit.
template <class L> void expectContinuousOverBoundaries(const L& law, double young, const std::vector<Vec3>& strains)
{
	int boundaries = 0;
	for (std::size_t i = 0; i + 1 < strains.size(); ++i) {
		Vec3       from = strains[i], to = strains[i + 1];
		const Mat3 D = respondTo(law, from).tangent;
		if ((respondTo(law, to).tangent - D).norm() < 1e-3 * young) continue;
		for (int half = 0; half < 60; ++half) {
			const Vec3 middle                                                                                   = 0.5 * (from + to);
			((respondTo(law, middle).tangent - respondTo(law, from).tangent).norm() < 1e-3 * young ? from : to) = middle;
		}
		++boundaries;
		expectSameStressNear(law, young, from);
		expectSameStressNear(law, young, to);
	}
	EXPECT_GT(boundaries, 20);
}

template <class L> void expectSameInLanes(const L& law, const std::vector<Vec3>& strains, double young)
{
	constexpr std::size_t    count     = L::variables.size();
	const auto               internals = law.initialInternals();
	std::array<Lanes, count> inLanes;
	for (std::size_t k = 0; k < count; ++k)
		inLanes[k] = Lanes(internals[k]);
	for (std::size_t first = 0; first + Lanes::count <= strains.size(); first += Lanes::count) {
		PrincipalValues<Lanes> e;
		for (int i = 0; i < 3; ++i)
			e[i] = lanes([&](int lane) { return strains[first + lane][i]; });
		const auto together = law.template respond<Lanes>(e, inLanes);
		for (int lane = 0; lane < Lanes::count; ++lane) {
			const auto   alone = respondTo(law, strains[first + lane]);
			const double size  = 1e-13 * young;
			for (int i = 0; i < 3; ++i) {
				EXPECT_NEAR(together.stress[i][lane], alone.stress[i], size * strains[first + lane].norm());
				EXPECT_NEAR(together.elasticStrain[i][lane], alone.elasticStrain[i], 1e-13 * strains[first + lane].norm());
				EXPECT_NEAR(together.shear[i][lane], alone.shear[i], 1e-9 * young);
				for (int j = 0; j < 3; ++j)
					EXPECT_NEAR(together.tangent(i, j)[lane], alone.tangent(i, j), 100 * size);
			}
			for (std::size_t k = 0; k < count; ++k)
				EXPECT_NEAR(together.internals[k][lane], alone.internals[k], 1e-12 * (1e-3 + std::abs(alone.internals[k])));
		}
	}
}

/// Principal stresses (lateral, axial, out of plane) of plane-strain compression after a long way, with the lateral one
/// kept.
template <class L> Vec3 biaxialStrength(const L& law, const Hencky& elastic, double lateral)
{
	Vec3 elasticStrain = elastic.strainOf<double>(Vec3::Constant(lateral)), stress;
	for (int step = 0; step < 400; ++step) {
		Vec3 trial = elasticStrain - 1e-4 * Vec3::Unit(1);
		// Lateral stress grows with the lateral strain.
		for (double from = -1e-3, to = 1e-3; to - from > 1e-18;) {
			const double middle = 0.5 * (from + to);
			if (middle == from || middle == to) break;
			trial[0]                                                = elasticStrain[0] + middle;
			(respondTo(law, trial).stress[0] < lateral ? from : to) = middle;
		}
		const auto r  = respondTo(law, trial);
		elasticStrain = r.elasticStrain, stress = r.stress;
	}
	return stress;
}

/// tau / |sigma_n| at the end of simple shear along x with the stress along y kept, at zero strain along x and z.
template <class L> double simpleShearStrength(const L& law, const Hencky& elastic, double normal)
{
	SymTensor<2> strain, stress;
	const double atRest = 3. / 7 * normal; // nu = 0.3
	const Vec3   first  = elastic.strainOf<double>({ atRest, normal, atRest });
	strain.c << first[0], first[1], 0, first[2];
	for (int step = 0; step < 1000; ++step) {
		auto       trial  = strain;
		const auto answer = [&](double along) {
			trial.c[1]   = strain.c[1] + along;
			trial.c[2]   = strain.c[2] + 1e-4;
			const auto p = principal(trial);
			const auto r = respondTo(law, p.value);
			stress       = assemble(r.stress, p.axes);
			return assemble(r.elasticStrain, p.axes);
		};
		double from = -1e-3, to = 1e-3;
		for (int half = 0; half < 60; ++half) {
			const double middle = 0.5 * (from + to);
			answer(middle);
			(stress.c[1] < normal ? from : to) = middle;
		}
		strain = answer(0.5 * (from + to));
	}
	return std::abs(stress.c[2] / normal);
}

} // namespace gimpm::soil
