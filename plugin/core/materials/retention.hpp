// SPDX-License-Identifier: GPL-2.0-or-later
// Water that a soil retains at a suction, and the relative permeability there.
#pragma once
#include <utility>
#include <vector>

namespace gimpm {

/// Retention curve of a soil whose air has the pressure zero: a pressure of the water below that is a suction s.
///
///     van Genuchten: S_e = (1 + (a s)^n)^-m, m = 1 - 1/n     exponential (Gardner): S_e = exp(-a s)
///     Brooks and Corey: S_e = (a s)^-n where a s > 1          table: linear between its suctions
///
/// Relative permeability k_r: by Mualem's integral of the curve; exp(-a s); S_e^(3 + 2/n); or a table, linear in its
/// logarithm. In a soil that deforms suction counts times a power of the void ratio over the initial one (Gallipoli
/// and others 2003), see suctionFactor().
struct Retention {
	enum class Curve { vanGenuchten, exponential, brooksCorey, table };
	enum class Permeability { mualem, exponential, brooksCorey, table };
	using Table = std::vector<std::pair<double, double>>; ///< suctions [Pa], which rise from zero, and values, which fall

	/// A value, and its derivative by the pressure [1/Pa].
	struct Value {
		double value, slope;
	};

	Curve        curve        = Curve::vanGenuchten;
	Permeability permeability = Permeability::mualem;
	double       alpha        = 0;            ///< [1/Pa]
	double       exponent     = 0;            ///< n [-]
	double       residual = 0, saturated = 1; ///< degrees of saturation: the least and the largest
	Table        retained {}, conducted {};   ///< degree of saturation and relative permeability
	double       voidExponent = 0;            ///< power of the void ratio over the initial one that multiplies suction [-]

	/// Part of the water between the residual and the largest saturation.
	Value effective(double pressure) const;
	Value saturation(double pressure) const;
	Value relativePermeability(double pressure) const;

private:
	Value mualem(double suction) const;
};

} // namespace gimpm
