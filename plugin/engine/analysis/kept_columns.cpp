// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/kept_columns.hpp"
#include "yade_api/attribute.hpp"
#include <utility>

namespace yade {

long KeptColumns::changes()
{
	const AttributeTable &ofState = MpmState::table(), &ofPoint = MpmPoint::table();
	return ofState.areLent() || ofPoint.areLent() ? -1 : PointWriter::count() + ofState.assignments() + ofPoint.assignments();
}

template <int Dim> const gimpm::PointCloud<Dim>* KeptColumns::cloud() const
{
	const auto& cloud = std::get<LeftColumns<Dim>>(columns).cloud;
	const long  now   = changes();
	return cloud.size() > 0 && now >= 0 && seen == now ? &cloud : nullptr;
}

template <int Dim> LeftColumns<Dim> KeptColumns::take()
{
	LeftColumns<Dim> left;
	if (cloud<Dim>()) std::swap(left, std::get<LeftColumns<Dim>>(columns));
	columns = {};
	seen    = changes();
	return left;
}

template <int Dim> void KeptColumns::keep(gimpm::PointCloud<Dim>&& cloud, const std::vector<gimpm::Material>& materials)
{
	auto& left = std::get<LeftColumns<Dim>>(columns);
	left.cloud = std::move(cloud);
	for (const auto& material : materials)
		left.ofLaws.push_back(material.law->columns);
}

template const gimpm::PointCloud<2>* KeptColumns::cloud() const;
template const gimpm::PointCloud<3>* KeptColumns::cloud() const;

template LeftColumns<2> KeptColumns::take();
template LeftColumns<3> KeptColumns::take();
template void           KeptColumns::keep(gimpm::PointCloud<2>&&, const std::vector<gimpm::Material>&);
template void           KeptColumns::keep(gimpm::PointCloud<3>&&, const std::vector<gimpm::Material>&);

} // namespace yade
