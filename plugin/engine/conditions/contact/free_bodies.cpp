// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/free_bodies.hpp"
#include "core/base/sentence.hpp"
#include "core/base/small_matrices.hpp"

namespace yade {

namespace {
	using Stiffness = gimpm::ContactLoad::Stiffness;

	// Stiffness of the soil under a body, within a time.
	Real stiffnessOf(const SoilAtBody& soil, const gimpm::ContactLoad& load, Real time)
	{
		const Real area = std::max(load.area, soil.cellSize * soil.cellSize), young = load.young / load.area;
		return 2 * young * std::sqrt(area) + 2 * 0.3 * soil.density * soil.cellSize * area / (time * time);
	}
}

Real frequency2(const State& state, const Stiffness& K)
{
	const auto isFree = [&](int dof) { return !(state.blockedDOFs >> dof & 1); };
	const bool spins  = isFree(3) && isFree(4) && isFree(5);
	Stiffness  moves  = Stiffness::Zero(); // root of the inverse of the masses
	const auto axes   = state.ori.toRotationMatrix();
	for (int i = 0; i < 3; ++i) {
		if (isFree(i)) moves(i, i) = 1 / std::sqrt(state.mass);
		if (isFree(3 + i)) moves(3 + i, 3 + i) = 1 / std::sqrt(state.inertia[i]);
	}
	if (spins) moves.bottomRightCorner<3, 3>() = (axes * moves.bottomRightCorner<3, 3>() * axes.transpose()).eval();
	return gimpm::symmetricEigen(moves * K * moves).values[5];
}

void requirePeriod(const Body& body, const gimpm::ContactLoad& load, const SoilAtBody& soil, Real dt, Real period)
{
	if (load.area == 0) return;
	const Real penalty    = gimpm::symmetricEigen(load.stiffness.topLeftCorner<3, 3>()).values[2];
	const Real fastest    = frequency2(*body.state, load.stiffness);
	const auto isAdmitted = [&](Real time) {
		const Real yields = soil.answers ? 1 + penalty / stiffnessOf(soil, load, time) : 1;
		return fastest * time * time <= yields * (1 + 1e-9);
	};
	if (isAdmitted(period)) return;
	const auto count    = std::lround(period / dt);
	auto       admitted = count - 1;
	while (admitted > 1 && !isAdmitted(admitted * dt))
		--admitted;
	throw std::invalid_argument(gimpm::sentence(
	        "iterPeriod = ", count, ": body #", body.id, " of ", body.state->mass,
	        " kg would gain energy on the soil that it is handed the force of every ", period,
	        " s, O.dt times iterPeriod, as it is too light for that, or the contact too stiff (", penalty, " N/m on ", load.area,
	        " m2). Admitted is iterPeriod up to ", admitted, ", as it touches now; or give a smaller O.dt or MpmContact.stiffness, or a heavier body."));
}

} // namespace yade
