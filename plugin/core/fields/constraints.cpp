// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/fields/constraints.hpp"

namespace gimpm {
namespace {

/// Calls f(values by node) for each component of the fields besides the displacements.
template <class F> void forComponents(const DofMap& map, Eigen::VectorXd& all, F&& f)
{
	for (int field = 1; field < map.fields(); ++field)
		for (int i = 0; i < map[field].width; ++i) {
			Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<>> component(
			        all.data() + map.begin(field) + i, map.nodes(), Eigen::InnerStride<>(map[field].width));
			Eigen::VectorXd values = component;
			f(values);
			component = values;
		}
}

} // namespace

void Constraints::reset(const DofMap& map, const AffineConstraints& affineConstraints)
{
	prescribed = Eigen::VectorXd::Zero(map.size());
	dofs.number.assign(map.size(), -1);
	dofs.count             = 0;
	dofs.affineConstraints = affineConstraints.empty() ? nullptr : &affineConstraints;
}

Constraints Constraints::ofDisplacements(const DofMap& map) const
{
	Constraints own { { { dofs.number.begin(), dofs.number.begin() + map.end(0) }, 0, dofs.affineConstraints }, map.displacements(prescribed) };
	for (const int number : own.dofs.number)
		own.dofs.count += number >= 0;
	return own;
}

template <int Dim> void Constraints::distribute(const DofMap& map, Eigen::VectorXd& values) const
{
	if (!dofs.affineConstraints) return;
	dofs.affineConstraints->template distribute<Dim>(values); // values of the first block
	forComponents(map, values, [&](Eigen::VectorXd& component) { dofs.affineConstraints->template distribute<1>(component); });
}

template <int Dim> void Constraints::condense(const DofMap& map, Eigen::VectorXd& forces) const
{
	if (!dofs.affineConstraints) return;
	dofs.affineConstraints->template condense<Dim>(forces);
	forComponents(map, forces, [&](Eigen::VectorXd& component) { dofs.affineConstraints->template condense<1>(component); });
}

template void Constraints::distribute<2>(const DofMap&, Eigen::VectorXd&) const;
template void Constraints::distribute<3>(const DofMap&, Eigen::VectorXd&) const;
template void Constraints::condense<2>(const DofMap&, Eigen::VectorXd&) const;
template void Constraints::condense<3>(const DofMap&, Eigen::VectorXd&) const;

} // namespace gimpm
