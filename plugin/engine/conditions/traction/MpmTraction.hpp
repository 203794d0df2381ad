// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/MpmCondition.hpp"
#include "engine/conditions/load_curves.hpp"
#include "engine/conditions/surface/MpmSurface.hpp"

namespace yade {

class MpmTraction : public Exposed<MpmTraction, MpmCondition> {
public:
	shared_ptr<MpmSurface>  surface; // must be given
	Real                    pressure = 0;
	Vector3r                traction = Vector3r::Zero();
	string                  body;  // empty: the one that is near
	gimpm::LoadCurve::Knees curve; // empty: that of the engine
	Vector3r                resultant = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN());

	YADE_API_NAME(MpmTraction)
	static const char* doc()
	{
		return "Load on a surface of the body that moves with it: *pressure* follows the surface, *traction* keeps its direction. Vertices move with the "
		       "background grid, and pieces are divided until their sides are at most a quarter of a cell; each vertex must lie on material, to a quarter "
		       "of a cell.\n\n"
		       "Set first: *surface* = mpm.surface(region, min=..., max=...) and *pressure* [Pa], which is positive if it presses. Page: "
		       "plugin/docs/classes/MpmTraction.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("surface", &MpmTraction::surface, 0,
		  "Loaded surface (MpmSurface, points, triangles or gts.Surface) with the body on its inner side; without default. Each load has its own.",
		  admitting("an MpmSurface, points or triangles; there is no default", notNull));
		v("pressure", &MpmTraction::pressure, 0, "Pressure [Pa] against the outer side of the deformed surface at load factor 1, finite; < 0 pulls.",
		  finite);
		v("traction", &MpmTraction::traction, 0, "Force over initial area [Pa] at load factor 1, finite; its direction stays.", finite);
		v("curve", &MpmTraction::curve, 0,
		  "Load factor [-] as a sequence of (time [s], factor), as *MpmImplicitEngine.loadCurve*; empty, the default: that one.", curveOrNothing);
		v("body", &MpmTraction::body, 0,
		  "Body of points that it acts on, as given to mpm.fill(..., body=...), with contact between bodies (MpmBodyContact); empty, the default: the one that all of the "
		  "surface lies on.");
		v("resultant", &MpmTraction::resultant, readonly,
		  "Force [N] on the body at the end of the last converged step; per metre of thickness in plane strain, NaN before the first.");
	}

	// The attributes must go together, too.
	void requireAdmissible() const override;

	std::shared_ptr<Condition<2>> make(InPlane, const Group&, const Analysis&) const override;
	std::shared_ptr<Condition<3>> make(InSpace, const Group&, const Analysis&) const override;

	Real                end(const Analysis&) const override;
	void                requireFitting(const Analysis&, const string& name) const override;
	string              onlyOn() const override { return body; }
	const Serializable* ownSurface() const override { return surface.get(); }
	vector<Vector3r>    places() const override; // vertices and middles of pieces
	bool                actsAlong(int axis) const override { return traction[axis] != 0; }
	void                tell(Rows&, const Analysis&, const Listed&) const override;
	const char*         picture() const override { return "loads"; }
	void                draw(Picture&, const Analysis&, const Listed&) const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmTraction)
