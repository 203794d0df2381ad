// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// One material point in place of the two halves of one.
#include "core/materials/material.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <optional>

namespace yade {

// The inverse of halve(), after both have deformed: mass, volume, momentum and centre are kept; deformation gradient,
// elastic strain and history are means by initial volume, the first one scaled to the volume.
class UnitedHalves {
public:
	// None: they are not alike, or the law does not admit the mean of their states. `material` is theirs.
	static std::optional<UnitedHalves> of(const MaterialPoint& lower, const MaterialPoint& upper, const gimpm::Material& material, int dim);

	// Elastic and kinetic energy that the mean has less than the halves [J].
	Real lostEnergy(const MaterialPoint& lower, const MaterialPoint& upper) const;

	// Makes the lower half the whole. The size of its domain depends on the grid, too, and is not set.
	void assignTo(const MaterialPoint& lower, const MaterialPoint& upper) const;

	Vector3r centre, halfSize0;
	Matrix3r defGrad;

private:
	UnitedHalves() = default;

	Real     share; // of the upper half in the initial volume
	int      dim;
	Matrix3r elasticStrain, stress;
	Vector3r velocity;

	vector<std::pair<const gimpm::InternalVariable*, Real>> internals;
};

} // namespace yade
