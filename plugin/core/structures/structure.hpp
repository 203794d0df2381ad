// SPDX-License-Identifier: GPL-2.0-or-later
// Bars and beams in the soil: what they are made of, and how they are as a step begins.
#pragma once
#include "core/structures/bar_element.hpp"
#include "core/structures/beam_element.hpp"
#include "core/structures/parting_lines.hpp"
#include "core/structures/shell_element.hpp"
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gimpm {

/// Integration points of the bond ahead of a tip, and their distance [cells].
constexpr int    bondsOfTip    = 12;
constexpr double bondOfOnePart = 0.25;

/// Lines are divided until their pieces are at most so long, in cells.
constexpr double lengthOfPieces = 0.5;

/// A line of vertices in the soil that carries forces along itself only. Vertices move with the soil, and along the bar
/// against it where the bond yields.
template <int Dim> struct Reinforcement {
	static constexpr double inf = std::numeric_limits<double>::infinity();

	enum class Head {
		bonded, ///< the first vertex is as the others
		plate,  ///< it is fixed to the soil there
		pulled, ///< there is no soil around it: a force pulls it along the bar
		joined  ///< it is fixed to a vertex of the beam
	};
	std::string name = "a bar"; ///< name in messages
	BarSection  section;
	Head        head          = Head::bonded;
	int         joint         = -1;    ///< vertex of the beam that the head is joined to
	bool        hasFreeLength = false; ///< the first piece has no bond between its ends
	/// Bond, per length of the bar.
	double bondStiffness = inf; ///< force over slip [N/m2]; infinite: there is no slip
	double bond          = inf; ///< strength without normal stress [N/m]
	double friction      = 0;   ///< and for each Pa of normal stress on the bar: perimeter times tan(delta) [m]

	double                pull       = 0; ///< on the head at the end of the step, outwards along the bar [N]
	double                pullBefore = 0; ///< the same as the step begins
	std::optional<double> jack {};        ///< force of a jack at the end of the step: in the free length, or if there is none everywhere [N]

	/// State as the step begins.
	std::vector<Vec<Dim>> positions; ///< positions of the vertices [m]
	std::vector<double>   length0;   ///< lengths of the pieces without stress [m]
	std::vector<double>   strain;    ///< strain of the pieces: logarithmic, elastic, < 0 where they are slack
	std::vector<double>   bondForce; ///< force at each vertex: along the bar, on the bar against its slip [N]
	std::vector<double>   slip;      ///< slip at each vertex: on along the bar against the soil [m]

	std::vector<double> force; ///< force in the pieces, in the last step that was accepted, tension positive [N]

	/// A new one along these vertices.
	void begin(std::vector<Vec<Dim>> vertices)
	{
		positions = std::move(vertices);
		for (std::size_t i = 0; i + 1 < positions.size(); ++i)
			length0.push_back((positions[i + 1] - positions[i]).norm());
		strain.assign(length0.size(), 0);
		force = strain;
		bondForce.assign(positions.size(), 0);
		slip = bondForce;
	}
	bool slips() const { return std::isfinite(bondStiffness); }
};

/// Soil on one side of a beam, by vertex.
struct BeamSide {
	std::vector<double> normalForce; ///< force of the beam on it [N]
	std::vector<double> gap;         ///< gap that the beam has left [m]
	std::vector<double> shearForce;  ///< on it, along the beam [N]
	/// Pressure of water that flows in it at the end of the last step [Pa], which presses the two apart besides;
	/// empty: there is none.
	std::vector<double> water {};
};

/// Stress between the two sides of the soil ahead of a tip, at one integration point of the bond that keeps them
/// together (StructureForce).
struct TipBond {
	bool   isActive = false; ///< the cut reaches so far
	double pressure = 0;     ///< normal stress, pressure positive [Pa]
	double shear    = 0;     ///< on what is to the left of the line, from what is to its right, along it [Pa]
};

/// A line of vertices in the plane, each with a position and a turn of its own, that the soil acts on by springs.
/// Around an axis it is the meridian of a shell of revolution: forces are those on the whole ring then.
struct Beam : PartingLine {
	static constexpr double inf = std::numeric_limits<double>::infinity();

	Beam() { isBonded = true; }

	std::string         name = "a beam";
	BeamSection         section;
	double              plasticMoment = inf;            ///< [N m]
	Vec<2>              weight        = Vec<2>::Zero(); ///< at the end of the step, over initial length [N/m]; of a shell over area
	bool                isShell       = false;          ///< around the axis x = 0
	std::vector<char>   isHinge;                        ///< flag by vertex: no moment there
	std::array<bool, 3> fixedHead {}, fixedFoot {};     ///< x, y and turn of the first and of the last vertex
	Vec<2>              headForce  = Vec<2>::Zero();    ///< at the end of the step [N]
	double              headMoment = 0;                 ///< [N m]
	bool                waterPulls = true;              ///< water that flows, where its pressure is below zero; else air gets between soil and beam
	/// Water pressure to the left of each vertex less that to its right, at the end of the step [Pa]; null: none.
	const std::vector<double>* waterPressure = nullptr;
	double                     shrinkage     = 1; ///< in this step: lengths without stress after it over those before

	/// Loads as the step begins.
	struct Loads {
		Vec<2> weight = Vec<2>::Zero(), headForce = Vec<2>::Zero();
		double headMoment = 0;
	} before {};

	/// Springs: stiffness over Young's modulus of the soil per cell [-]; strength of each side along it.
	double stiffness = 10;
	double adhesion  = inf; ///< [Pa]
	double friction  = 0;   ///< tan(delta)

	/// State as the step begins.
	std::vector<double>     turns;      ///< turns of the vertices in all [rad]
	std::vector<double>     length0;    ///< lengths of the pieces [m]
	std::vector<double>     radius0;    ///< shell: radii of the vertices without stress [m]
	std::vector<double>     slope0;     ///< shell: sine of the angle of the pieces to the radius, without stress
	std::vector<double>     elongation; ///< elongation of the pieces [m]
	std::vector<Vec<2>>     bend;       ///< elastic turns of the ends of the pieces [rad]
	std::array<BeamSide, 2> sides;      ///< left and right
	/// Ahead of the first and of the last vertex, by integration point.
	std::array<std::array<TipBond, bondsOfTip>, 2> bonds {};
	/// Flags of vertices that have had soil on both sides only as one body, or none yet. When that is parted the
	/// beam bears the stress that was in it.
	std::vector<char> isStuck;

	/// In the last step that was accepted; of a shell by metre of its sections.
	std::vector<double> axialForce; ///< force in the pieces [N]
	std::vector<double> shearForce; ///< force in the pieces [N]
	std::vector<Vec<2>> moments;    ///< at the ends of the pieces, counterclockwise [N m]
	std::vector<double> hoopForce;  ///< shell: force in the pieces [N]
	std::vector<Vec<2>> hoopMoment; ///< shell: moments at the ends of the pieces, positive where it is bent to its left [N m]

	/// A new one along these vertices, with an axial force [N].
	void begin(std::vector<Vec<2>> vertices, double prestress = 0)
	{
		positions            = std::move(vertices);
		const double stretch = prestress == 0 ? 1 : 1 + prestress / section.axialStiffness;
		for (std::size_t i = 0; i + 1 < positions.size(); ++i)
			length0.push_back((positions[i + 1] - positions[i]).norm() / stretch);
		for (std::size_t i = 0; i < length0.size() && isShell; ++i)
			slope0.push_back((positions[i + 1][1] - positions[i][1]) / length0[i]);
		for (std::size_t v = 0; v < positions.size() && isShell; ++v)
			radius0.push_back(positions[v][0]);
		for (const double length : length0)
			elongation.push_back((stretch - 1) * length);
		shearForce.assign(length0.size(), 0);
		axialForce.assign(length0.size(), prestress);
		bend.assign(length0.size(), Vec<2>::Zero());
		moments = bend;
		turns.assign(positions.size(), 0);
		for (BeamSide& side : sides)
			side = { turns, turns, turns };
		isStuck.assign(positions.size(), 1);
		if (isHinge.empty()) isHinge.assign(positions.size(), 0);
	}
	/// A vertex's part of the pieces beside it [m]: half of each; of a shell by area [m2], so that what is even
	/// along a piece turns neither of its ends.
	double sizeAt(int vertex) const
	{
		const int last = int(length0.size());
		double    sum  = 0;
		if (vertex > 0 || isClosed) sum += partOfPiece(vertex > 0 ? vertex - 1 : last - 1, 1);
		if (vertex < last || isClosed) sum += partOfPiece(vertex % last, 0);
		return sum;
	}
	double partOfPiece(int piece, int end) const
	{
		if (!isShell) return length0[piece] / 2;
		const double own = radius0[piece + end], other = radius0[piece + 1 - end];
		return M_PI * (2 * own + other) / 3 * length0[piece];
	}
	bool isOnAxis(int vertex) const { return isShell && radius0[vertex] == 0; }
};

/// Connected structure: bars, and a beam that some of them may be anchors of.
template <int Dim> struct Structure {
	std::vector<Reinforcement<Dim>> bars;
	std::optional<Beam>             beam {}; ///< in the plane

	double work = 0; ///< on the soil in the last step that was accepted [J]

	/// Copy with the loads and lengths that the step begins with.
	Structure asItBegins() const;

	/// Number of vertices, those of the beam first.
	int vertices() const
	{
		std::size_t sum = beam ? beam->positions.size() : 0;
		for (const auto& bar : bars)
			sum += bar.positions.size();
		return int(sum);
	}
	std::string name() const { return beam ? beam->name : bars.front().name; }

	/// Length of all lines without stress [m].
	double length() const;

	/// All of it as much stiffer as the soil around it is made, with what has given way elastically as much less.
	void stiffen(double scale);

	/// Positions of the bars, and of the beam behind them.
	std::vector<std::vector<Vec<Dim>>> positions() const;
	void                               putBack(const std::vector<std::vector<Vec<Dim>>>&);
};

/// Divides a line until its pieces are at most so long.
template <int Dim> std::vector<Vec<Dim>> divided(const std::vector<Vec<Dim>>& line, double longest)
{
	std::vector<Vec<Dim>> fine { line.front() };
	for (std::size_t i = 0; i + 1 < line.size(); ++i) {
		const int pieces = std::max(1, int(std::ceil((line[i + 1] - line[i]).norm() / longest - 1e-9)));
		for (int p = 1; p <= pieces; ++p)
			fine.push_back(line[i] + double(p) / pieces * (line[i + 1] - line[i]));
	}
	return fine;
}

} // namespace gimpm
