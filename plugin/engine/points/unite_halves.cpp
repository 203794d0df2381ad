// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/unite_halves.hpp"
#include "engine/materials/laws.hpp"
#include "engine/points/energies.hpp"
#include <Eigen/LU>

namespace yade {

namespace {
	// Largest difference of halves that may become one: of deformation gradients, and of internal variables as a
	// part of the larger one.
	constexpr Real mostDifference = 0.05;

	template <class T> T mean(const T& lower, const T& upper, Real share) { return (1 - share) * lower + share * upper; }

	bool areOfOne(const MaterialPoint& lower, const MaterialPoint& upper, int dim)
	{
		const MpmState &l = *lower.state, &u = *upper.state;
		return lower.material == upper.material && l.parameters == u.parameters && l.body == u.body && l.splits == u.splits
		        && lower.shape->halfSize0.head(dim).isApprox(upper.shape->halfSize0.head(dim), 1e-9);
	}

	bool areAlike(const vector<Real>& lower, const vector<Real>& upper)
	{
		for (size_t k = 0; k < lower.size(); ++k)
			if (std::abs(lower[k] - upper[k]) > mostDifference * std::max(std::abs(lower[k]), std::abs(upper[k]))) return false;
		return true;
	}

	// Initial axis across which two halves of a point lie beside each other.
	int axisBetween(const MaterialPoint& lower, const MaterialPoint& upper)
	{
		int axis = 0;
		(upper.state->refPos - lower.state->refPos).cwiseQuotient(lower.shape->halfSize0).cwiseAbs().maxCoeff(&axis);
		return axis;
	}

	// Gradient that is scaled in the plane, or in space, to a determinant.
	Matrix3r withDeterminant(Matrix3r F, Real J, int dim)
	{
		if (dim == 3) return F * std::cbrt(J / F.determinant());
		F.topLeftCorner<2, 2>() *= std::sqrt(J / F.determinant());
		return F;
	}
}

std::optional<UnitedHalves> UnitedHalves::of(const MaterialPoint& lower, const MaterialPoint& upper, const gimpm::Material& material, int dim)
{
	const MpmState &l = *lower.state, &u = *upper.state;
	if (!areOfOne(lower, upper, dim) || (l.defGrad - u.defGrad).norm() > mostDifference) return std::nullopt;
	const auto lowerInternals = lower.internalsOf(material.law), upperInternals = upper.internalsOf(material.law);
	if (!areAlike(lowerInternals, upperInternals)) return std::nullopt;
	UnitedHalves whole;
	whole.dim       = dim;
	whole.share     = u.volume0 / (l.volume0 + u.volume0);
	whole.centre    = mean(Vector3r(l.pos), Vector3r(u.pos), whole.share);
	whole.velocity  = mean(l.vel, u.vel, whole.share);
	whole.halfSize0 = (lower.shape->halfSize0 + upper.shape->halfSize0) / 2;
	whole.halfSize0[axisBetween(lower, upper)] *= 2;
	const Real J        = (l.volume + u.volume) / (l.volume0 + u.volume0);
	whole.defGrad       = withDeterminant(mean(l.defGrad, u.defGrad, whole.share), J, dim);
	whole.elasticStrain = mean(l.elasticStrain, u.elasticStrain, whole.share);
	vector<Real> internals;
	for (size_t k = 0; k < lowerInternals.size(); ++k) {
		internals.push_back(mean(lowerInternals[k], upperInternals[k], whole.share));
		whole.internals.emplace_back(&gimpm::internalVariables[material.law->columns[k]], internals[k]);
	}
	try {
		whole.stress = kirchhoffStressOf(material, whole.elasticStrain, internals) / J;
	} catch (const std::invalid_argument&) {
		return std::nullopt;
	}
	return whole;
}

Real UnitedHalves::lostEnergy(const MaterialPoint& lower, const MaterialPoint& upper) const
{
	const MpmState &l = *lower.state, &u = *upper.state;
	const Real      elastic = 0.5 * (l.volume + u.volume) * stress.cwiseProduct(elasticStrain).sum();
	const Real      kinetic = 0.5 * (1 - share) * share * (l.mass + u.mass) * (l.vel - u.vel).squaredNorm();
	return elasticEnergy(lower) + elasticEnergy(upper) - elastic + kinetic;
}

void UnitedHalves::assignTo(const MaterialPoint& lower, const MaterialPoint& upper) const
{
	const PointWriter writer;
	MpmState&         l = writer.state(lower);
	const MpmState&   u = *upper.state;
	l.pos = centre, l.vel = velocity, l.defGrad = defGrad, l.elasticStrain = elasticStrain, l.stress = stress;
	l.refPos           = (l.refPos + u.refPos) / 2;
	l.acceleration     = mean(l.acceleration, u.acceleration, share);
	l.porePressure     = mean(l.porePressure, u.porePressure, share);
	l.excessPressure   = mean(l.excessPressure, u.excessPressure, share);
	l.saturation       = mean(l.saturation, u.saturation, share);
	l.pressureOnGrains = mean(l.pressureOnGrains, u.pressureOnGrains, share);
	l.waterFlux        = mean(l.waterFlux, u.waterFlux, share);
	for (const auto& [variable, value] : internals)
		l.setInternal(variable->name, value);
	MpmState::amounts([&](auto member) { l.*member += u.*member; });
	l.splits -= 1;
	writer.shape(lower).halfSize0 = halfSize0;
	writer.shape(lower).radius *= std::pow(2, 1. / dim);
}

} // namespace yade
