// SPDX-License-Identifier: GPL-2.0-or-later
// Loads on bars and beams: those that are given, and the pressures of water that flows.
#include "core/structures/structure_system.hpp"

namespace gimpm {

namespace {

/// Adds a force that stays as it is.
void addForce(const LinearForm& along, double force, const Eigen::VectorXd& x, EnergySum& sum)
{
	if (force == 0) return;
	Energy<1> energy;
	energy.value       = -force * along.at(x);
	energy.gradient[0] = -force;
	sum.add<1>({ along }, energy);
}

} // namespace

template <int Dim> void StructureSystem<Dim>::addLoads(const Eigen::VectorXd& x, EnergySum& sum) const
{
	const auto add = [&](const LinearForm& along, double force) { addForce(along, force, x, sum); };
	forBars([&](const Reinforcement<Dim>& bar, int first) {
		const Vec<Dim> outwards = (bar.positions[0] - bar.positions[1]).normalized();
		for (int a = 0; a < Dim; ++a)
			add(component(stations_[first], a), bar.pull * outwards[a]);
	});
	if (!structure_.beam) return;
	const Beam& beam = *structure_.beam;
	for (int v = 0; v < int(beam.positions.size()) - beam.isClosed; ++v) {
		const Vec<2> t     = beam.tangentAt(v);
		const Vec<2> water = beam.waterPressure ? Vec<2>((*beam.waterPressure)[v] * Vec<2>(t[1], -t[0])) : Vec<2>(0, 0);
		for (int i = 0; i < 3; ++i) {
			LinearForm own;
			own.add(stations_[v].own[i], 1);
			double force = i < 2 ? (beam.weight[i] + water[i]) * beam.sizeAt(v) : 0;
			if (v == 0) force += i < 2 ? beam.headForce[i] : beam.headMoment;
			add(own, force);
		}
	}
	if constexpr (Dim == 2) addWater(x, sum);
}

/// Adds the pressures of water that flows: on each side of the beam they press soil and beam apart, and ahead of its
/// tips the two sides of the soil. The energy is less by the pressure times the volume that opens: water fills it.
template <int Dim> void StructureSystem<Dim>::addWater(const Eigen::VectorXd& x, EnergySum& sum) const
{
	const Beam& beam  = *structure_.beam;
	const auto  press = [&](int first, const std::array<int, 3>& own, const LinearForm& pressure, const Vec<2>& area) {
                for (int a = 0; a < 2; ++a) {
                        LinearForm apart;
                        apart.add(first + a, 1);
                        apart.add(own[a], -1);
                        Energy<2> energy;
                        energy.value    = -area[a] * pressure.at(x) * apart.at(x);
                        energy.gradient = -area[a] * Eigen::Vector2d(pressure.at(x), apart.at(x));
                        energy.hessian << 0, -area[a], -area[a], 0;
                        sum.add<2>({ apart, pressure }, energy);
                }
	};
	for (const WetSide& wet : wetSides_) {
		const Vec<2> t = beam.tangentAt(wet.vertex), n = (wet.side == 1 ? -1 : 1) * Vec<2>(-t[1], t[0]);
		LinearForm   pressure;
		pressure.add(waterUnknown(wet.position), 1);
		press(soilUnknown(wet.position), stations_[wet.vertex].own, pressure, beam.sizeAt(wet.vertex) * n);
	}
	const int count = int(beam.positions.size()), bonds = int(stations_.size()) + count;
	for (std::size_t i = 0; i + 1 < bondSoil_.size(); i += 2) {
		const int left = bondSoil_[i], right = bondSoil_[i + 1];
		if (left < 0 || right < 0) continue;
		const int    end = int(i / 2) / bondsOfTip;
		const Vec<2> t   = beam.tangentAt(end == 0 ? 0 : count - 1);
		LinearForm   pressure;
		for (const int side : { 0, 1 })
			pressure.add(waterUnknown(bonds + int(i) + side), 0.5);
		press(left, { right, right + 1, -1 }, pressure, bondArea_[i / 2] * Vec<2>(-t[1], t[0]));
	}
}

#define GIMPM_INSTANTIATE(Dim) template void StructureSystem<Dim>::addLoads(const Eigen::VectorXd&, EnergySum&) const;
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
