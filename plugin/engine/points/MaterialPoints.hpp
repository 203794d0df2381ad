// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The material points among the bodies of a scene.
#include "core/materials/material.hpp"
#include "engine/materials/MpmMaterial.hpp"
#include "engine/materials/refusals.hpp"
#include "engine/points/MpmPoint.hpp"
#include "engine/points/MpmState.hpp"
#include <atomic>

namespace yade {

// Keeps its parts alive when the script erases the body while the scene runs in the background.
struct MaterialPoint {
	Body::id_t                 id;
	shared_ptr<const MpmPoint> shape; // whoever changes values takes a PointWriter
	shared_ptr<const MpmState> state;
	shared_ptr<MpmMaterial>    material;

	// std::invalid_argument unless all its values can be computed with in this dimension (2 or 3), in two of them
	// as a ring or in plane strain. Its material is not looked at.
	void requireAdmissible(int dim, bool isRing) const;

	// std::invalid_argument unless its material admits that a step begins from its stress.
	void requireStart(const Matrix3r& stress) const;

	// True if it is where it was filled, as it was then.
	bool isUnmoved() const { return state->pos == state->refPos && state->defGrad.isIdentity(0); }

	// Internal variables in the order of its law.
	Real         internalOf(const gimpm::Law&, size_t k) const;
	vector<Real> internalsOf(const gimpm::Law&) const;

	// std::invalid_argument names one of them that its variable does not admit, or one of the state that the law
	// does not have.
	void requireInternals(const gimpm::Law&) const;

	// Index into O.materials, -1 if it is not in there. The number in the material itself may be that of another
	// scene's list.
	int materialIndex(const Scene&) const;
};

// Access to values of points, for those who change them. Each is counted: an engine begins a step with the columns that
// its last one has left, as long as nobody else has changed what is in them.
class PointWriter {
public:
	PointWriter() { ++made; }

	// Mark of results that no column of the core begins with.
	struct OfResults { };
	explicit PointWriter(OfResults) { }

	MpmState& state(const MaterialPoint& point) const { return const_cast<MpmState&>(*point.state); }
	MpmPoint& shape(const MaterialPoint& point) const { return const_cast<MpmPoint&>(*point.shape); }

	static long count() { return made; }

private:
	static inline std::atomic_long made { 0 };
};

// True if an engine with this mask is to read the body: 0 and -1 mean all, also a body whose groupMask has no bits.
inline bool maskMatches(const Body& body, int mask) { return mask == 0 || mask == -1 || (body.groupMask & Body::mask_t(mask)) != Body::mask_t(0); }

// All bodies with an MpmPoint shape that the mask means, in order of body id. std::invalid_argument if one of them is
// incomplete, is left to YADE's collider or integrator, alone or in a clump, or if another body has a material that is
// for material points only.
vector<MaterialPoint> materialPoints(const Scene&, int mask = 0);

// The same, from those of before, which are kept as far as they are still there, which is quicker. That they are others
// counts as a change of values.
void updateMaterialPoints(vector<MaterialPoint>&, const Scene&, int mask);

} // namespace yade
