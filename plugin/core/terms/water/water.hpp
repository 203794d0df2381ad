// SPDX-License-Identifier: GPL-2.0-or-later
// Water with a given pressure in the pores of the body and around it.
#pragma once
#include "core/terms/term.hpp"
#include "core/terms/water/water_pressure.hpp"
#include <functional>

namespace gimpm {

/// Domain of the pressure: in the pores only, on the surface only, or both.
enum class WaterDomain { everywhere, pores, outside };

/// Pressure forces at the end of a step, and as it begins.
template <int Dim> struct Water {
	using Pressure             = std::shared_ptr<const WaterPressure<Dim>>;
	WaterDomain         domain = WaterDomain::everywhere;
	Pressure            pressure {}, before {};
	double              factor = 1, factorBefore = 1; ///< factors of the pressures
	bool                wantsWork = false;            ///< work takes two passes over the points
	std::vector<double> shares {};                    ///< part of the force by material; empty: all

	/// Beside walls where the pressure jumps: number of the side that a position is on, from 1, 0 elsewhere; and by
	/// side the pressure as it goes on from there. Null: as elsewhere.
	std::function<int(const Vec<Dim>&)> sideOf {};
	std::vector<Pressure>               beside {}, besideBefore {};

	// results of the last step that was accepted
	std::vector<double>                   porePressure {}; ///< pressure at each point of the cloud, at its end [Pa]
	std::vector<std::pair<Key, Vec<Dim>>> onWalls {};      ///< force on what constrains nodes [N]; zero where free
	double                                work = 0;        ///< work by the mean of the forces at both ends [J]
};

/// The laws know the effective stress s' = s + p I alone. With the surface loaded by the same pressure as the pores,
/// all that is left of p in the virtual work of a displacement v is that of a body force (divergence theorem): pores +
/// outside: -int p div v dV + int p n.v dA = int v.grad p dV. So
///
///     everywhere: V0 grad p S_a     pores: -V p grad S_a     outside: V (grad p S_a + p grad S_a)
///
/// All but the first take the current volume V and its derivative. In the first, water that the pores lose takes its
/// weight along, which the mass of a point, constant, does not know: with the initial volume V0, (density - that of
/// water) V0 g is exactly the weight of submerged soil, however it deforms. The second one has no symmetric stiffness.
template <int Dim> class WaterForce : public Term<Dim> {
public:
	/// Results are written to the water in commit().
	WaterForce(Water<Dim>&, const StepContext<Dim>&);

	void                        mark(NodeMatrix<Dim>&) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;
	void                        addBefore(Eigen::VectorXd& force) override;
	bool                        isSymmetric() const override
	{
		return water_.domain == WaterDomain::everywhere || (water_.domain == WaterDomain::outside && water_.pressure->fall().isZero(0));
	}
	double fromOutside(const Eigen::VectorXd& d) override;
	void   commit(const Eigen::VectorXd& d) override;

private:
	struct Start { // state of a point
		Vec<Dim> position, halfSize;
		double   volume0, volume;
		int      side; ///< side of a wall
	};
	enum class When { before, now };
	const WaterPressure<Dim>&                      pressureFor(const Start&, When) const;
	template <class F> std::optional<PointFailure> forWetPoints(When, WaterDomain, const Eigen::VectorXd& d, F&&) const;

	Water<Dim>&            water_;
	const CloudBasis<Dim>& basis_;
	const Grid<Dim>&       grid_;
	const FreeDofs&        dofs_;
	const OwnedNodes&      ownedNodes_;
	std::vector<Start>     start_; // in the order of the basis: the cloud goes on before commit()
};

} // namespace gimpm
