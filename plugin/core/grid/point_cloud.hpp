// SPDX-License-Identifier: GPL-2.0-or-later
// Material points as structure of arrays.
#pragma once
#include "core/base/checksum.hpp"
#include "core/base/types.hpp"
#include <Eigen/LU>
#include <tuple>
#include <vector>

namespace gimpm {

/// Column policy of a cloud.
enum class ColumnPolicy {
	always,   ///< there is a value for each point
	ifNeeded, ///< the column is empty where none of the points needs it
};

/// A column of a cloud, or a list of columns, each of which may be empty.
template <class Cloud, class Values> struct CloudColumn {
	Values Cloud::*of;
	ColumnPolicy   policy;
};

/// All columns that are there have the same length. A new one is a member and its entry in columns(), without which
/// nothing compiles: so it goes wherever points go, from process to process too.
template <int Dim> struct PointCloud {
	std::vector<Vec<Dim>>       position;       ///< [m]
	std::vector<Vec<Dim>>       position0;      ///< initial positions [m]; empty: points are there still, or no boundary moves nodes
	std::vector<Vec<Dim>>       halfSize;       ///< current half lengths of the domains [m], at most half a cell
	std::vector<Vec<Dim>>       halfSize0;      ///< initial half lengths [m]
	std::vector<double>         volume0;        ///< initial volume [m3], per metre of thickness in plane strain, of the whole ring around an axis
	std::vector<Mat<Dim>>       defGrad;        ///< deformation gradient
	std::vector<double>         hoopStretch;    ///< around an axis of symmetry, beside the deformation gradient; else empty
	std::vector<SymTensor<Dim>> elasticStrain;  ///< logarithmic
	std::vector<SymTensor<Dim>> stress;         ///< Cauchy stress [Pa], a result
	InternalColumns             internals;      ///< internal variables of the laws
	ParameterColumns            parameters;     ///< parameters of points with their own, for the laws
	std::vector<double>         excessPressure; ///< pressure of water that cannot leave its pores, over that of given water [Pa]; empty: there is none
	std::vector<Vec<Dim>>       force;          ///< point load at load factor 1 [N]; empty: no point loads
	std::vector<int>            material;       ///< position in the list of materials
	std::vector<int>            layer;          ///< body that the point is part of (Grid::layer); empty: all are of one

	static constexpr auto columns()
	{
		using C              = PointCloud;
		const auto all       = [](auto C::*of) { return CloudColumn<C, std::decay_t<decltype(std::declval<C>().*of)>> { of, ColumnPolicy::always }; };
		const auto sometimes = [](auto C::*of) { return CloudColumn<C, std::decay_t<decltype(std::declval<C>().*of)>> { of, ColumnPolicy::ifNeeded }; };
		return std::make_tuple(
		        all(&C::position), sometimes(&C::position0), all(&C::halfSize), all(&C::halfSize0), all(&C::volume0), all(&C::defGrad),
		        sometimes(&C::hoopStretch), all(&C::elasticStrain), all(&C::stress), sometimes(&C::internals), sometimes(&C::parameters),
		        sometimes(&C::excessPressure), sometimes(&C::force), all(&C::material), sometimes(&C::layer));
	}

	std::size_t size() const { return position.size(); }
	int         layerOf(int p) const { return layer.empty() ? 0 : layer[p]; }

	/// Current volume over the initial one.
	double volumeRatio(std::size_t p) const
	{
		const double J = defGrad[p].determinant();
		return hoopStretch.empty() ? J : J * hoopStretch[p];
	}

	/// Those that are always there, and of the lists of columns those that are not empty.
	void resize(std::size_t n);
};

/// Calls f(column, policy) for each column of a cloud, also for those that are empty and for each of a list.
template <class Cloud, class F> void forColumns(Cloud& cloud, F&& f)
{
	const auto visit = [&](auto& values, ColumnPolicy policy) {
		using Column = typename std::decay_t<decltype(values)>::value_type;
		if constexpr (std::is_same_v<Column, std::vector<double>>)
			for (auto& column : values)
				f(column, policy);
		else
			f(values, policy);
	};
	std::apply([&](const auto&... column) { (visit(cloud.*column.of, column.policy), ...); }, std::decay_t<Cloud>::columns());
}

/// Bytes of the members that a list of columns names.
template <class Cloud, class... Values> constexpr std::size_t sizeOfColumns(const std::tuple<CloudColumn<Cloud, Values>...>&) { return (sizeof(Values) + ...); }

static_assert(sizeOfColumns(PointCloud<2>::columns()) == sizeof(PointCloud<2>), "PointCloud::columns() has to name each member of PointCloud, once");
static_assert(sizeOfColumns(PointCloud<3>::columns()) == sizeof(PointCloud<3>), "PointCloud::columns() has to name each member of PointCloud, once");

template <int Dim> void PointCloud<Dim>::resize(std::size_t n)
{
	for (auto* columns : { &internals, &parameters })
		for (auto& column : *columns)
			if (!column.empty()) column.resize(n);
	forColumns(*this, [n](auto& column, ColumnPolicy policy) {
		if (policy == ColumnPolicy::always) column.resize(n);
	});
}

/// Checksum of all columns: the same where points are the same, to the last bit.
template <int Dim> std::uint64_t checksumOf(const PointCloud<Dim>& cloud)
{
	Checksum sum;
	forColumns(cloud, [&](const auto& column, ColumnPolicy) { sum.mix(column); });
	return sum.take() ^ cloud.size();
}

} // namespace gimpm
