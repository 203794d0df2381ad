// SPDX-License-Identifier: GPL-2.0-or-later
// Water that flows beside beams: its pressures, and the volumes that open between soil and beam.
#include "core/structures/structure_force.hpp"

namespace gimpm {

/// Says where the soil beside a beam, and on both sides ahead of its tips, is wet.
template <int Dim> void StructureForce<Dim>::wet(const StepContext<Dim>& step)
{
	waterBefore_ = water_ = *step.water;
	for (std::size_t position = 0; position < soil_.size(); ++position)
		soil_[position].isWet = structure_.beam && soil_[position].exists && attached_[position]
		        && (position < structure_.beam->positions.size() || int(position) >= structure_.vertices());
}

/// Pressure of the water at a position of the soil, at the last iterate.
template <int Dim> double StructureForce<Dim>::pressureAt(int position) const
{
	const auto& at  = *attached_[position];
	double      sum = 0;
	for (int n = 0; n < at.nodes; ++n)
		if (presses(at.node[n])) sum += at.weight[n] * water_[at.node[n]];
	return sum;
}

/// Keeps the pressures beside a beam for users.
template <int Dim> void StructureForce<Dim>::keepWater()
{
	if (!structure_.beam) return;
	Beam&             beam  = *structure_.beam;
	const std::size_t count = beam.positions.size(), all = structure_.vertices();
	for (const int side : { 0, 1 }) {
		beam.sides[side].water.assign(count, 0);
		for (std::size_t v = 0; v < count; ++v) {
			const bool isParted = all + v < soil_.size() && soil_[all + v].exists;
			if (soil_[v].exists && (isParted || soil_[v].sides == 1 << side))
				beam.sides[side].water[v] = pressureAt(int(isParted && side == 1 ? all + v : v));
		}
	}
}

template <int Dim> void StructureForce<Dim>::addPressures(Eigen::VectorXd& soil) const
{
	for (int position = 0; position < int(attached_.size()); ++position)
		if (const int at = system_->waterUnknown(position); at >= 0) soil[at] = pressureAt(position);
}

/// Calls f(position, node, weight) for nodes the water of which presses on the structure.
template <int Dim> template <class F> void StructureForce<Dim>::forWater(F&& f) const
{
	for (int position = 0; position < int(attached_.size()); ++position)
		for (int n = 0; system_->waterUnknown(position) >= 0 && n < attached_[position]->nodes; ++n)
			f(position, attached_[position]->node[n], attached_[position]->weight[n]);
}

template <int Dim> void StructureForce<Dim>::markWater(Couplings& K) const
{
	forWater([&](int, int wet, double) {
		for (int v = 0; v < int(attached_.size()); ++v)
			for (int n = 0; system_->soilUnknown(v) >= 0 && n < attached_[v]->nodes; ++n)
				K.mark({ 0, attached_[v]->node[n] }, { field, wet });
		forWater([&](int, int other, double) { K.mark({ field, wet }, { field, other }); });
	});
}

/// Derivatives by the pressures, and those of the volumes that open.
template <int Dim> void StructureForce<Dim>::addWater(const Eigen::MatrixXd& K, Couplings& couplings) const
{
	forWater([&](int position, int wet, double weight) {
		if (!presses(wet)) return;
		const int w = system_->waterUnknown(position);
		for (int v = 0; v < int(attached_.size()); ++v) {
			const int u = system_->soilUnknown(v);
			for (int n = 0; u >= 0 && n < attached_[v]->nodes; ++n) {
				const Vec<Dim> block = weight * attached_[v]->weight[n] * K.template block<Dim, 1>(u, w);
				couplings.add({ 0, attached_[v]->node[n] }, { field, wet }, block);
				if (!couplings.isSymmetric())
					couplings.add({ field, wet }, { 0, attached_[v]->node[n] }, Eigen::Matrix<double, 1, Dim>(-block.transpose()));
			}
		}
		forWater([&](int other, int node, double part) {
			if (presses(node)) couplings.add({ field, wet }, { field, node }, -weight * part * K(w, system_->waterUnknown(other)));
		});
	});
}

/// Gives the volumes that open between soil and beam to the balance of the water around.
template <int Dim> void StructureForce<Dim>::distributeVolumes(const EnergySum& at, const FieldSum<Dim>& sum) const
{
	forWater([&](int position, int node, double weight) {
		if (!presses(node)) return;
		const int w = system_->waterUnknown(position);
		sum.force[field][node] -= weight * at.gradient[w];
		sum.absoluteContributions[field][node] += std::abs(weight) * at.absoluteContributions[w];
	});
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template void StructureForce<Dim>::wet(const StepContext<Dim>&);                                                                                       \
	template void StructureForce<Dim>::keepWater();                                                                                                        \
	template void StructureForce<Dim>::addPressures(Eigen::VectorXd&) const;                                                                               \
	template void StructureForce<Dim>::markWater(Couplings&) const;                                                                                        \
	template void StructureForce<Dim>::addWater(const Eigen::MatrixXd&, Couplings&) const;                                                                 \
	template void StructureForce<Dim>::distributeVolumes(const EnergySum&, const FieldSum<Dim>&) const;
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
