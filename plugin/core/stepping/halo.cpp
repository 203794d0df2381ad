// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/halo.hpp"
#include <cstring>
#include <unordered_map>

namespace gimpm {
namespace {

template <int Dim, class F> void forColumns(PointCloud<Dim>& cloud, F&& f)
{
	f(cloud.position), f(cloud.position0), f(cloud.halfSize), f(cloud.halfSize0), f(cloud.volume0), f(cloud.defGrad), f(cloud.hoopStretch);
	f(cloud.elasticStrain), f(cloud.stress), f(cloud.force), f(cloud.material);
	for (auto* columns : { &cloud.internals, &cloud.parameters })
		for (auto& column : *columns)
			f(column);
}

/// Which of the columns there are: a process without points cannot tell.
template <int Dim> std::vector<char> columnsOfAll(PointCloud<Dim>& cloud, const Processes& all)
{
	std::vector<std::int64_t> isMissing;
	forColumns(cloud, [&](const auto& column) { isMissing.push_back(column.empty()); });
	all.smallest(isMissing.data(), int(isMissing.size()));
	std::vector<char> isThere;
	for (const std::int64_t missing : isMissing)
		isThere.push_back(!missing);
	return isThere;
}

template <class T> void fillWithZeros(std::vector<T>& column, int points)
{
	column.resize(points);
	std::memset(static_cast<void*>(column.data()), 0, points * sizeof(T));
}

using Numbers = std::vector<double>;

void                    append(Numbers& to, int number) { to.push_back(number); }
template <class T> void append(Numbers& to, const T& value)
{
	static_assert(sizeof(T) % sizeof(double) == 0);
	to.resize(to.size() + sizeof(T) / sizeof(double));
	std::memcpy(&to.back() + 1 - sizeof(T) / sizeof(double), &value, sizeof(T));
}

void                    take(const double*& from, int& number) { number = int(*from++); }
template <class T> void take(const double*& from, T& value)
{
	std::memcpy(static_cast<void*>(&value), from, sizeof(T));
	from += sizeof(T) / sizeof(double);
}

/// The own points that each process needs.
template <int Dim> std::vector<std::vector<int>> wanted(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	const Division&                           division = *model.division;
	const bool                                isWide   = model.fBar || model.ghost.factor != 0;
	std::vector<std::vector<int>>             points(division.processes->size());
	std::unordered_map<Key, std::vector<int>> known;
	for (int p = 0; p < division.own(); ++p) {
		const Key lowest          = lowestCell<Dim>(cloud.position[p], cloud.halfSize[p], model.grid, model.basis);
		const auto [found, isNew] = known.try_emplace(lowest);
		if (isNew) found->second = neededBy<Dim>(division, lowest, model.grid, isWide);
		for (const int process : found->second)
			if (process != division.processes->rank()) points[process].push_back(p);
	}
	return points;
}

/// Number, ids and then column by column.
template <int Dim> Numbers packed(PointCloud<Dim>& cloud, const Division& division, const std::vector<int>& points, const std::vector<char>& isThere)
{
	Numbers numbers;
	if (points.empty()) return numbers;
	append(numbers, int(points.size()));
	for (const int p : points)
		append(numbers, division.id[p]);
	int k = 0;
	forColumns(cloud, [&](const auto& column) {
		if (isThere[k++])
			for (const int p : points)
				append(numbers, column[p]);
	});
	return numbers;
}

template <int Dim> void unpack(const Numbers& numbers, PointCloud<Dim>& cloud, Division& division, const std::vector<char>& isThere)
{
	if (numbers.empty()) return;
	const double* from  = numbers.data();
	int           count = 0, k = 0;
	take(from, count);
	for (int i = 0; i < count; ++i)
		take(from, division.copied.emplace_back());
	forColumns(cloud, [&](auto& column) {
		if (!isThere[k++]) return;
		column.resize(column.size() + count);
		for (auto value = column.end() - count; value != column.end(); ++value)
			take(from, *value);
	});
}

} // namespace

template <int Dim> Halo<Dim>::Halo(PointCloud<Dim>& cloud, const Model<Dim>& model) : cloud_(cloud), division_(model.division.get())
{
	if (!division_) return;
	const Processes& all     = *division_->processes;
	const auto       isThere = columnsOfAll(cloud, all);
	int              k       = 0;
	forColumns(cloud, [&](auto& column) { // point loads that only others have
		if (isThere[k++] && column.empty()) fillWithZeros(column, division_->own());
	});
	division_->lent = wanted(cloud, model);
	std::vector<Numbers> own;
	for (const auto& points : division_->lent)
		own.push_back(packed(cloud, *division_, points, isThere));
	for (const Numbers& received : exchanged(all, own))
		unpack(received, cloud, *division_, isThere);
}

template <int Dim> Halo<Dim>::~Halo()
{
	if (!division_) return;
	forColumns(cloud_, [this](auto& column) { column.resize(std::min<std::size_t>(column.size(), division_->own())); });
	division_->copied.clear(), division_->lent.clear();
}

template class Halo<2>;
template class Halo<3>;

} // namespace gimpm
