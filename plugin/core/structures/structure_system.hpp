// SPDX-License-Identifier: GPL-2.0-or-later
// Bars and a beam in equilibrium with given displacements of the soil around them.
#pragma once
#include "core/structures/structure.hpp"

namespace gimpm {

/// The soil at a vertex as a step begins.
struct SoilAtVertex {
	bool   exists       = false;
	int    sides        = 0;     ///< sides of a beam: bit 0 to its left, bit 1 to its right
	double normalStress = 0;     ///< on the line, pressure positive [Pa]
	double shearStress  = 0;     ///< on what is to the left of the line, from what is to its right, along it [Pa]
	double young        = 0;     ///< [Pa]
	double cellSize     = 1;     ///< [m]
	double area         = 0;     ///< area of a bond [m], around an axis [m2]
	bool   isWet        = false; ///< water that flows in it presses on the beam, and fills what opens between the two
};

/// Unknowns are the displacements of the soil at the vertices that have some, Dim each, the pressures of its water
/// there, and then those of the structure itself: of a beam's vertices, and slips. Displacements are those of the step.
/// They minimise an energy of the step, here with respect to the structure's own unknowns, so that these never reach
/// the unknowns of the grid. Its derivative by a pressure is the volume that closes between soil and beam.
template <int Dim> class StructureSystem {
public:
	/// The structure must outlive it; the soil by vertex, those of the beam first. Behind them all, by vertex of
	/// the beam, is the soil to its right where that is another body than that to its left; then, by bond ahead
	/// of its first and of its last vertex, the soil to the left and to the right; these may be missing.
	StructureSystem(Structure<Dim>&, const std::vector<SoilAtVertex>&);

	int  soilUnknowns() const { return soilUnknowns_; }
	bool hasOwnUnknowns() const { return unknowns_ > soilUnknowns_; }
	/// First unknown of the soil, numbered as it is given; -1: it has none.
	int soilUnknown(int position) const
	{
		const int right = position - int(stations_.size()), bond = right - ofBeam();
		if (right < 0) return stations_[position].soil;
		return bond < 0 ? stations_[right].toTheRight : bondSoil_[bond];
	}
	/// Unknown pressure of the water there, numbered as the soil is given; -1: there is none.
	int waterUnknown(int position) const { return water_[position]; }
	/// Pairs of vertices that a piece without unknowns of its own joins, each once, with the vertex itself.
	std::vector<std::pair<int, int>> joinedVertices() const;

	struct Solution {
		Eigen::VectorXd x;
		bool            isFound = true;
	};
	/// Solution of the structure's equilibrium, from a first guess of its own unknowns; all zero if that is empty.
	Solution solve(const Eigen::VectorXd& soil, const Eigen::VectorXd& guess) const;

	/// Displacement of a vertex against the soil around it, of two sides the one that it moves less
	/// against [m]; 0: it has none.
	double moveInSoil(int vertex, const Eigen::VectorXd& x) const;

	/// On the soil at equilibrium: the force by which the structure resists its displacements, and the derivative.
	EnergySum       energyAt(const Eigen::VectorXd& x, bool secants = false) const;
	Eigen::MatrixXd condensed(const EnergySum&) const;

	/// Takes over the state at x.
	void commit(const Eigen::VectorXd& x);

private:
	/// A vertex: what its displacement is made of.
	struct Station {
		int                soil       = -1;   ///< first unknown of the soil around it
		int                toTheRight = -1;   ///< beam: first unknown of the soil to its right, where that is another body
		bool               moves      = true; ///< it moves with the soil
		int                slip       = -1;   ///< unknown along `direction`
		Vec<Dim>           direction  = Vec<Dim>::Zero();
		std::array<int, 3> own { -1, -1, -1 }; ///< beam: unknowns x, y, turn
		int                turnBehind = -1;    ///< hinge in a shell: unknown of the piece behind it
		bool               isFree     = false; ///< vertex of a beam
	};
	/// A side of a vertex of the beam where soil is wet, and the position of that soil.
	struct WetSide {
		int vertex, side, position;
	};
	/// A spring with a limited force.
	struct Spring {
		LinearForm form;
		double     stiffness, force, limit; ///< force: as the step begins
		bool       oneSided;                ///< a force that cannot be negative, without memory of what it would have been
		double*    memory;
		double*    gap  = nullptr;
		double     area = 1; ///< area that the force is divided by to be remembered
	};

	void                            number(const std::vector<SoilAtVertex>&);
	void                            numberSoil(const std::vector<SoilAtVertex>&);
	void                            numberWater(const std::vector<SoilAtVertex>&);
	bool                            isSecondOfRing(int vertex) const;
	void                            numberBeam();
	void                            addSprings(const std::vector<SoilAtVertex>&);
	void                            addBeamSprings(int vertex, const std::vector<SoilAtVertex>&);
	void                            addBonds(const std::vector<SoilAtVertex>&);
	void                            addSpringsOfSide(int vertex, int side, const SoilAtVertex&, bool isParted);
	std::array<LinearForm, 2 * Dim> ends(int first, int second) const;
	LinearForm                      component(const Station&, int axis) const;
	BarPiece<Dim>                   piece(const Reinforcement<Dim>&, std::size_t number) const;
	std::array<LinearForm, 6>       beamEnds(int first) const;
	BeamPiece                       beamPiece(std::size_t number) const;
	ShellPiece                      shellPiece(std::size_t number) const;
	Energy<6>                       energyOfPiece(std::size_t number, const Eigen::Matrix<double, 6, 1>& u) const;
	void                            addLoads(const Eigen::VectorXd& x, EnergySum&) const;
	void                            addWater(const Eigen::VectorXd& x, EnergySum&) const;
	void                            commitBar(Reinforcement<Dim>&, int first, const Eigen::VectorXd& x);
	void                            commitPiece(std::size_t number, const Eigen::Matrix<double, 6, 1>& u);
	void                            commitBeam(const Eigen::VectorXd& x);
	Eigen::VectorXd                 direction(const EnergySum&) const;
	double                          farthestMove(const Eigen::VectorXd& step) const;
	Solution                        iterate(Eigen::VectorXd from, int mostSteps, bool secants) const;

	int ofBeam() const { return structure_.beam ? int(structure_.beam->positions.size()) : 0; }

	template <class F> void forBars(F&& f) const
	{
		int first = ofBeam();
		for (auto& bar : structure_.bars) {
			f(bar, first);
			first += int(bar.positions.size());
		}
	}

	Structure<Dim>&      structure_;
	std::vector<Station> stations_;
	std::vector<Spring>  springs_;
	std::vector<int>     bondSoil_; ///< first unknowns of the soil to the left and right, by bond
	std::vector<double>  bondArea_; ///< [m], around an axis [m2]
	std::vector<int>     water_;    ///< unknown pressures by position of the soil
	std::vector<WetSide> wetSides_;
	int                  soilUnknowns_ = 0, unknowns_ = 0;
};

} // namespace gimpm
