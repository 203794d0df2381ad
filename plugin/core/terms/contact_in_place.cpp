// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact_in_place.hpp"

namespace gimpm {
namespace {

/// Between a corner where it is in the cloud and its body, nothing taken off.
template <int Dim> double distance(const ContactSystem<Dim>& system, const ContactRecord<Dim>& record, const PointCloud<Dim>& cloud)
{
	const PointDomain<Dim> domain(cloud, record.point);
	const auto&            body = system.bodies[record.body];
	return body.proximity(body.end, domain.corner(record.corner), body.sideOf(body.end, domain.centre())).gap;
}

} // namespace

template <int Dim> void shrinkGaps(ContactSystem<Dim>& system, const PointCloud<Dim>& cloud, double scale)
{
	for (auto& record : system.records)
		record.gap = record.touches ? scale * record.gap : distance(system, record, cloud) - record.offset;
	keepGaps(system, cloud);
}

template <int Dim> void keepGaps(ContactSystem<Dim>& system, const PointCloud<Dim>& cloud)
{
	for (auto& record : system.records)
		record.offset = distance(system, record, cloud) - record.gap;
}

template void shrinkGaps(ContactSystem<2>&, const PointCloud<2>&, double);
template void shrinkGaps(ContactSystem<3>&, const PointCloud<3>&, double);
template void keepGaps(ContactSystem<2>&, const PointCloud<2>&);
template void keepGaps(ContactSystem<3>&, const PointCloud<3>&);

} // namespace gimpm
