// SPDX-License-Identifier: GPL-2.0-or-later
// Soil in front of a contact point on the surface of a body.
#pragma once
#include "core/base/types.hpp"
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace gimpm {

/// The domain of a material point near a body.
template <int Dim> struct SoilDomain {
	Vec<Dim> centre, half; ///< [m]
	double   young;        ///< [Pa]
	Vec<Dim> outward;      ///< normal of the body's surface closest to its centre, unit
	double   gap = 0;      ///< of its centre, < 0 in the body [m]

	bool isInFrontOf(const Vec<Dim>& normal) const { return outward.dot(normal) > 0.7; }

	/// True if the line along a normal passes it by more than this.
	bool isPassed(const Vec<Dim>& position, const Vec<Dim>& normal, double beside) const
	{
		const Vec<Dim> away = centre - position;
		return ((away - away.dot(normal) * normal).array().abs() > half.array() + beside).any();
	}
};

/// Soil in front of a contact point.
struct Sight {
	double gap;          ///< to it along the normal, < 0 where it overlaps the body [m]
	double areaFraction; ///< from 0, no soil, to 1, soil in full
	double young;        ///< mean modulus [Pa]
};

/// The domains near one body, by bins of the size of the smallest cells.
template <int Dim> class SoilNear {
public:
	/// `isSmall`: the body is a ball of few cells, whose normals lead into the soil at all angles.
	SoilNear(std::vector<SoilDomain<Dim>>, double cellSize, bool isSmall = false);

	/// Looks from a contact point along the normal, no farther than the reach. Soil whose closest side of the body
	/// looks elsewhere, as beyond an edge or behind a thin body, does not count, nor what is hidden: a test of the
	/// centres of domains, empty where nothing hides any.
	using Hides = std::function<bool(const Vec<Dim>& centre)>;
	std::optional<Sight> from(const Vec<Dim>& position, const Vec<Dim>& normal, double reach, const Hides& = {}) const;

	/// Least gap of the centres in the body that are in front of a contact point, or rather behind it; no more than
	/// the one given.
	double deepest(const Vec<Dim>& position, const Vec<Dim>& normal, double gap) const;

	std::pair<Vec<Dim>, Vec<Dim>> bounds() const { return { low_, high_ }; }

private:
	double                  gapFrom(const Vec<Dim>& position, const Vec<Dim>& normal, double reach, const Hides&) const;
	template <class F> void forIn(const Vec<Dim>& low, const Vec<Dim>& high, F&& f) const;
	Index<Dim>              bin(const Vec<Dim>& x) const { return ((x - low_) / cellSize_).array().floor().template cast<int>(); }

	std::vector<SoilDomain<Dim>>              domains_, inside_; ///< all, and those with their centres in the body
	std::vector<std::pair<std::int64_t, int>> bins_;             ///< and numbers of domains, sorted
	Vec<Dim>                                  low_, high_;
	Index<Dim>                                size_;
	double                                    cellSize_, largest_ = 0;
	bool                                      isSmall_;
};

} // namespace gimpm
