// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/refinement.hpp"
#include "engine/grid/MpmAdaptation.hpp"
#include "engine/grid/MpmBody.hpp"
#include "engine/grid/MpmRefinement.hpp"

namespace yade {

class MpmGrid : public Exposed<MpmGrid, Serializable> {
public:
	Real     cellSize     = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Vector3r origin       = Vector3r::Zero();
	int      dim          = 2;
	Vector3r period       = Vector3r::Zero();
	bool     axisymmetric = false;

	vector<shared_ptr<MpmRefinement>> refinements;
	vector<shared_ptr<MpmAdaptation>> adaptation;
	// Boxes of the last step, which the engine makes for the adaptation.
	vector<shared_ptr<MpmRefinement>> adapted;
	vector<shared_ptr<MpmBody>>       bodies;

	YADE_API_NAME(MpmGrid)
	static const char* doc()
	{
		return "Background grid of square (dim=2) or cubic (dim=3) cells. It is unbounded: there are no extents to declare, and only cells that material "
		       "points touch take memory.\n\n"
		       "Set first: *cellSize*, a tenth of what decides, as the width of a footing or the height of a slope, and 2 points a cell; then half of it, "
		       "to see what changes. *dim* = 2 and *axisymmetric* wherever they do. Page: plugin/docs/classes/MpmGrid.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("cellSize", &MpmGrid::cellSize, 0, "Edge length h of a cell [m] > 0, without default; of the largest ones with *refinements*.",
		  admitting("a finite number > 0 [m]; there is no default", positive));
		v("origin", &MpmGrid::origin, 0,
		  "Position of a node [m], finite; all others are whole cells away from it. With dim=2, mpm.fill puts the points into its plane z.", finite);
		v("dim", &MpmGrid::dim, 0, "2: plane strain in x-y, per metre of thickness, or *axisymmetric*; 3: three-dimensional.", oneOf(2, 3));
		v("period", &MpmGrid::period, 0,
		  "Lengths [m] along x, y, z after which the scene repeats itself, from *origin* on: whole numbers of cells, at least 3. 0, the default: it does not.",
		  nonNegative);
		v("axisymmetric", &MpmGrid::axisymmetric, 0,
		  "Bodies of revolution about the grid line x = 0, with dim=2. x is the radius, y goes along the axis; volumes and forces are of the whole circle.");
		v("refinements", &MpmGrid::refinements, 0,
		  "Boxes (MpmRefinement) in which cells are halved; empty, the default: all are equal. Read as a tuple, so assign a new one to change it, also between steps.");
		v("adaptation", &MpmGrid::adaptation, 0,
		  "Rules (MpmAdaptation) by which cells are halved anew in each step; empty, the default: only *refinements* halve cells.");
		v("adapted", &MpmGrid::adapted, readonly, "Boxes (MpmRefinement) in which *adaptation* has halved cells in the last step.");
		v("bodies", &MpmGrid::bodies, 0,
		  "Bodies of points with a name (MpmBody), in the order in which mpm.fill(..., body=...) has named them; empty, the default: none has one.");
	}

	// True if all cells are of one size.
	bool hasEqualCells() const { return refinements.empty() && adaptation.empty(); }

	// Name of what makes them differ, for messages.
	string severalSizes() const { return string("MpmGrid.") + (refinements.empty() ? "adaptation" : "refinements") + ", cells of several sizes,"; }

	// The place of a body of this name among the bodies, or -1.
	int bodyNamed(const string& name) const;

	// Name by which a script knows a body: that of the whole of which it is a part.
	const string& nameOfWhole(int body) const;

	// Size [m] of the smallest cells that there may be.
	Real smallestCell() const;

	// Grid of the core. std::invalid_argument unless periods are whole numbers of cells, as many as basis
	// functions need, and the axis of symmetry is on nodes.
	template <int Dim> gimpm::Grid<Dim> lattice() const;

	// The refinements must be admissible, too.
	void requireAdmissible() const override;

private:
	Vector3i periodInCells() const;
	void     requireAxis() const;
	void     requireLevels(const string& name, int halvings) const;

	template <int Dim> void refine(gimpm::Grid<Dim>&) const;
};

// For mpm.fill: sizes of the cells (N double) at positions (N x 3 double), on a line between cells of two sizes that of
// the smaller one, as a bytearray.
py::object cellSizesForPython(const MpmGrid&, const py::object& positions);

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmGrid)
