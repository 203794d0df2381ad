// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/shaking/MpmBaseMotion.hpp"
#include "engine/conditions/surface/MpmSurface.hpp"

namespace yade {

class MpmFreeField : public Exposed<MpmFreeField, MpmCondition> {
public:
	shared_ptr<MpmSurface>    surface; // must be given
	shared_ptr<MpmBaseMotion> motion;  // none: no wave comes from beyond
	// Motion and forces of the ground beyond, at the vertices, one time after the other; empty: nothing moves.
	vector<Real>     times, velocities, displacements, forces;
	Real             distance = std::numeric_limits<Real>::infinity();
	bool             acts     = true;
	vector<Vector3r> velocity;
	Vector3r         reaction = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN());
	bool             hasBegun = false;
	vector<Vector3r> borne;      // at the vertices, what goes on acting [N]
	vector<Vector3r> impedances; // impedances of the pieces: rho c_p, rho c_s [N s/m3] and the shear modulus [Pa]

	YADE_API_NAME(MpmFreeField)
	static const char* doc()
	{
		return "Edge that moves with the body, beyond which the ground goes on, among the *loads* of MpmDynamicEngine: dashpots (Lysmer and Kuhlemeyer "
		       "1969) and springs against what moves otherwise than free ground, whose stress acts on the body. Soil does not cross it.\n\n"
		       "Forces that constrained the body there go on acting, as with MpmAbsorbingBoundary. Plane strain.\n\n"
		       "Set first: nothing, mpm.freeField(solver, until=...) makes both sides and the base. Page: plugin/docs/classes/MpmFreeField.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using F                  = MpmFreeField;
		const auto finiteVectors = admitting("vectors of finite numbers", [](const auto& all) { return std::all_of(all.begin(), all.end(), finite); });
		v("surface", &F::surface, 0,
		  "Edge of the body (MpmSurface or points), which is on its inner side, the left of a line from point to point; without default. Each has its own.",
		  admitting("an MpmSurface or points; there is no default", notNull));
		v("motion", &F::motion, 0,
		  "Velocity of the wave that comes from beyond (MpmBaseMotion), half of that at a free surface; None, the default: no wave. Not with *times*.");
		const auto finiteNumbers = admitting("finite numbers", areFinite);
		v("times", &F::times, 0,
		  "Times [s], increasing, of *velocities*, *displacements* and *forces*; linear between. Empty, the default: nothing moves beyond.",
		  admitting("finite numbers that increase", increase));
		v("velocities", &F::velocities, 0,
		  "Velocities of the free ground [m/s]: x and y of each vertex, at each of *times*, one number after the other.", finiteNumbers);
		v("displacements", &F::displacements, 0, "Its displacements [m] since the first of *times*, in the order of *velocities*.", finiteNumbers);
		v("forces", &F::forces, 0, "Forces of its stress, less that at the first of *times*, on the vertices [N], in the order of *velocities*.",
		  finiteNumbers);
		v("distance", &F::distance, 0,
		  "Distance of the centre of the moving body [m] > 0: springs of G / distance along the normal and half of that across it [Pa/m]; inf, the default: none.",
		  admitting("a number > 0, or inf: no springs", [](Real value) { return value > 0; }));
		v("acts", &F::acts, 0, "False: it does nothing, and tells velocities.", AnyValue());
		v("velocity", &F::velocity, readonly, "Velocity of the vertices in the last converged step [m/s]; empty before the first.");
		v("reaction", &F::reaction, readonly, "Force [N] on the body in the last converged step, per metre of thickness, NaN before the first.");
		v("hasBegun", &F::hasBegun, hidden, "", AnyValue());
		v("borne", &F::borne, hidden, "", finiteVectors);
		v("impedances", &F::impedances, hidden, "", finiteVectors);
	}

	// The attributes must go together, too.
	void requireAdmissible() const override;

	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	void                requireFitting(const Analysis&, const string& name) const override;
	string              needsOneBody(const string&) const override { return "an edge of free ground"; }
	string              needsEqualCells(const string& name) const override { return name; }
	const Serializable* ownSurface() const override { return surface.get(); }
	vector<Vector3r>    places() const override { return surface->vertices; }
	void                tell(Rows&, const Analysis&, const Listed&) const override;
	string              firstDoubt(const string& name) const override { return motion ? motion->doubt(name) : ""; }

private:
	// In free_fields.cpp, which is compiled for speed: they are asked in each step.
	static bool areFinite(const vector<Real>&);
	static bool increase(const vector<Real>&);
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmFreeField)
