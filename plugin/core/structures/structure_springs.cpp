// SPDX-License-Identifier: GPL-2.0-or-later
// Springs between bars, beams and the soil, and between the two sides of soil ahead of a tip.
#include "core/structures/structure_system.hpp"

namespace gimpm {

template <int Dim> void StructureSystem<Dim>::addSprings(const std::vector<SoilAtVertex>& soil)
{
	if constexpr (Dim == 2)
		for (int v = 0; structure_.beam && v < int(structure_.beam->positions.size()); ++v)
			addBeamSprings(v, soil);
	if constexpr (Dim == 2) addBonds(soil);
	forBars([&](Reinforcement<Dim>& bar, int first) {
		for (std::size_t v = 0; v < bar.positions.size() && bar.slips(); ++v) {
			const Station& station = stations_[first + v];
			if (station.slip < 0 || !station.moves) continue;
			double length = 0; // length of the bar that is bonded here
			if (v > 0 && !(v == 1 && bar.hasFreeLength)) length += bar.length0[v - 1] / 2;
			if (v < bar.length0.size()) length += bar.length0[v] / 2;
			Spring spring { {}, length * bar.bondStiffness, bar.bondForce[v], length * bar.bond, false, &bar.bondForce[v] };
			if (bar.friction > 0) spring.limit += length * bar.friction * std::max(0., soil[first + v].normalStress);
			spring.form.add(station.slip, 1);
			springs_.push_back(spring);
		}
	});
}

/// Adds the springs of a beam. Where soil that has been one body, or a part of one in which the beam is put, is parted,
/// the beam takes over the stress that was in it.
template <int Dim> void StructureSystem<Dim>::addBeamSprings(int v, const std::vector<SoilAtVertex>& soil)
{
	Beam& beam = *structure_.beam;
	if (isSecondOfRing(v)) return;
	const bool isParted = stations_[v].toTheRight >= 0;
	for (const int side : { 0, 1 }) {
		const SoilAtVertex& beside = soil[isParted && side == 1 ? stations_.size() + v : v];
		BeamSide&           memory = beam.sides[side];
		if (!(soil[v].sides >> side & 1) || stations_[v].soil < 0) {
			memory.normalForce[v] = memory.shearForce[v] = memory.gap[v] = 0;
			continue;
		}
		if (isParted && beam.isStuck[v]) {
			memory.normalForce[v] = beam.sizeAt(v) * std::max(0., beside.normalStress);
			memory.shearForce[v]  = beam.sizeAt(v) * (side == 0 ? 1 : -1) * beside.shearStress;
		}
		addSpringsOfSide(v, side, beside, isParted);
	}
	beam.isStuck[v] = soil[v].sides == 3 && !isParted;
}

/// One that presses, and one along the beam. Those of both sides of soil that is one body are stressed against each
/// other by what nobody knows: what such soil bears along the beam is told by its stress.
template <int Dim> void StructureSystem<Dim>::addSpringsOfSide(int v, int side, const SoilAtVertex& soil, bool isParted)
{
	Beam&          beam    = *structure_.beam;
	BeamSide&      memory  = beam.sides[side];
	const Station& station = stations_[v];
	const int      first   = isParted && side == 1 ? station.toTheRight : station.soil;
	const Vec<2>   t = beam.tangentAt(v), n = (side == 1 ? -1 : 1) * Vec<2>(-t[1], t[0]);
	const double   length = beam.sizeAt(v), stiffness = beam.stiffness * soil.young / soil.cellSize * length;
	const auto     along = [&](const Vec<2>& e) {
                LinearForm form;
                for (int a = 0; a < 2; ++a) {
                        form.add(station.own[a], e[a]);
                        form.add(first + a, -e[a]);
                }
                return form;
	};
	const double pressed = memory.normalForce[v];
	springs_.push_back({ along(n), stiffness, pressed - stiffness * memory.gap[v], Beam::inf, true, &memory.normalForce[v], &memory.gap[v] });
	const bool   isOne    = soil.sides == 3 && !isParted;
	const double pressure = isOne ? length * std::max(0., soil.normalStress) : std::max(0., pressed);
	const double adhesion = memory.gap[v] > 0 && !isOne ? 0 : length * beam.adhesion;
	springs_.push_back({ along(t), stiffness, memory.shearForce[v], adhesion + beam.friction * pressure, false, &memory.shearForce[v] });
}

/// Two springs between the sides of the soil at each integration point ahead of a tip. Where a cut begins to reach
/// so far they take over the stress that is in the soil.
template <int Dim> void StructureSystem<Dim>::addBonds(const std::vector<SoilAtVertex>& soil)
{
	for (int i = 0; i < 2 * bondsOfTip && !bondSoil_.empty(); ++i) {
		const int           left = bondSoil_[2 * i], right = bondSoil_[2 * i + 1], end = i / bondsOfTip;
		const SoilAtVertex& here = soil[stations_.size() + ofBeam() + 2 * i];
		Beam&               beam = *structure_.beam;
		TipBond&            bond = beam.bonds[end][i % bondsOfTip];
		bondArea_.push_back(here.area);
		if (left < 0) {
			bond = {};
			continue;
		}
		if (!bond.isActive) bond = { true, here.normalStress, here.shearStress };
		const Vec<2> t         = beam.tangentAt(end == 0 ? 0 : ofBeam() - 1), n(-t[1], t[0]);
		const double stiffness = beam.stiffness * here.young / here.cellSize * here.area;
		const auto   across    = [&](const Vec<2>& e) {
                        LinearForm form;
                        for (int a = 0; a < 2; ++a) {
                                form.add(right + a, e[a]);
                                form.add(left + a, -e[a]);
                        }
                        return form;
		};
		springs_.push_back({ across(n), stiffness, here.area * bond.pressure, Beam::inf, false, &bond.pressure, nullptr, here.area });
		springs_.push_back({ across(t), stiffness, here.area * bond.shear, Beam::inf, false, &bond.shear, nullptr, here.area });
	}
}

#define GIMPM_INSTANTIATE(Dim) template void StructureSystem<Dim>::addSprings(const std::vector<SoilAtVertex>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
