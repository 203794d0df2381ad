// SPDX-License-Identifier: GPL-2.0-or-later
// Water that flows through the pores of a saturated soil, as it is kept from step to step. Its pressure is the excess
// over that of water which stands still.
#pragma once
#include "core/grid/surface.hpp"
#include "core/materials/pores.hpp"
#include "core/materials/retention.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gimpm {

/// A surface of the body by which water leaves or enters; it moves with the body.
template <int Dim> struct Drain {
	enum class Kind {
		pressure, ///< there is a given pressure
		seepage,  ///< same pressure, but water cannot enter
		flux,     ///< so much leaves, whatever the pressure
		rain      ///< so much enters, as long as the soil takes it in, or leaves, as long as it is not too dry
	};
	/// Water stands outside up to a height, other than that of the still water over which pressures are in excess.
	/// Above it water can only leave, into the air.
	struct Level {
		double height, still, weight; ///< heights outside and of still water, NaN: pressures are whole ones; weight of water by volume
		int    axis;
		double up; ///< 1 or -1: heights are up * x[axis]

		/// In excess [Pa].
		double pressureAt(const Eigen::Matrix<double, Dim, 1>& x) const
		{
			const double z = up * x[axis];
			return weight * (std::max(height - z, 0.) - (std::isnan(still) ? 0 : still - z));
		}
		bool isInAir(const Eigen::Matrix<double, Dim, 1>& x) const { return up * x[axis] > height; }
	};

	Surface<Dim>         surface; ///< at the start of the step, with sides of at most `pieceLimit`
	Kind                 kind   = Kind::pressure;
	double               given  = 0;    ///< at the end of the step: excess pressure [Pa], or volume that leaves by area and time [m/s], of rain that enters
	double               driest = -1e8; ///< least pressure to which evaporation goes on [Pa]
	std::optional<Level> level {};      ///< in place of a pressure that is the same everywhere
	/// Water passes its skin as it passes so many parts of a cell: conductance over conductivity and cell size.
	double      conductance = 30;
	std::string name        = "a drain";
	double      out         = 0; ///< volume that has left by it in the last step that was accepted [m3]
};

/// Factor by which suction acts on the grains (Bishop).
enum class Bishop { effectiveSaturation, saturation };

/// Water that has its weight, and the pressure over that of the air: pores need not be full.
template <int Dim> struct WholeWater {
	Eigen::Matrix<double, Dim, 1> weight;     ///< by volume [N/m3]
	double                        factor = 1; ///< of the weight that the soil carries, at the end of the step
	Bishop                        bishop = Bishop::effectiveSaturation;
	/// Tolerance on the error that the length of a step leaves in the saturation [-].
	double              saturationTolerance = std::numeric_limits<double>::infinity();
	std::vector<double> saturation {}; ///< of each point, as the last accepted step has left it; NaN: that of its pressure
	std::vector<double> push {};       ///< pressure on the grains of each point then [Pa]

	std::vector<std::shared_ptr<const Retention>> curves {};    ///< those that Pores refer to
	std::deque<Retention>                         ownCurves {}; ///< those of points that have their own
};

template <int Dim> struct SoilWater {
	std::vector<Pores>            pores;                                                   ///< pores by material
	std::vector<Pores>            ownPores {};                                             ///< pores of each point, where some have their own; else empty
	double                        modulus       = std::numeric_limits<double>::infinity(); ///< bulk modulus of the water [Pa]
	double                        duration      = 0;                                       ///< duration of the step [s]
	Eigen::Matrix<double, Dim, 1> vertical      = Eigen::Matrix<double, Dim, 1>::Unit(Dim - 1); ///< axis of Pores::verticalRatio
	double                        stabilisation = 1;    ///< against pressures that change from node to node: over 1 / constrained modulus
	double                        ghost         = 0.01; ///< penalty on jumps of the gradient in nearly empty cells [-]
	std::vector<Drain<Dim>>       drains {};

	std::optional<WholeWater<Dim>> whole {}; ///< none: pressures are in excess of still water, and all pores are full

	/// Tolerances on the errors that the length of a step leaves in displacements [m] and pressures [Pa], as roots
	/// of mean squares over the volume. Both need the growth in the last step.
	double displacementTolerance = std::numeric_limits<double>::infinity(), pressureTolerance = displacementTolerance;

	std::vector<double>                        pressure {}; ///< pressure at each point [Pa], as the last accepted step has left it
	std::vector<Eigen::Matrix<double, Dim, 1>> flux {};     ///< volume by area and time [m/s]
	std::map<std::uint64_t, double>            atNodes {};  ///< pressure by key of the node [Pa]
	/// Growth of displacements and pressure in the last accepted step, by key of the node, and its duration [s]; 0:
	/// there was none, or it is not kept.
	std::map<std::uint64_t, Eigen::Matrix<double, Dim + 1, 1>> growth {};
	double                                                     lastDuration = 0;
	bool                                                       keepsGrowth  = true;  ///< growth tells where the next step may begin, too
	double                                                     stored       = 0;     ///< volume taken up by the body in the last accepted step [m3]
	bool                                                       wantsWork    = false; ///< in time steps
	double                                                     work         = 0; ///< work of the excess pressures on the soil in the last accepted step [J]
};

} // namespace gimpm
