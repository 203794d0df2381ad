// SPDX-License-Identifier: GPL-2.0-or-later
// Water that flows through a saturated soil which deforms: the balance of its volume, and its pressure on the soil.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/terms/coupled_term.hpp"
#include "core/terms/ghost.hpp"
#include "core/terms/near_nodes.hpp"
#include "core/terms/passage.hpp"
#include "core/terms/water/curves_at_nodes.hpp"
#include "core/terms/water/flow_point.hpp"
#include "core/terms/water/soil_water.hpp"
#include <deque>
#include <memory>
#include <utility>

namespace gimpm {

template <int Dim> struct FlowBlocks;

/// Constrained moduli of points of the cloud [Pa].
using ConstrainedModulus = std::function<double(int point)>;

/// The field of the excess pressures. Of nodes where there was none before it begins with that of their points. `scale`
/// as of Field. All are kept by reference.
template <int Dim> NodalField<Dim> pressureField(SoilWater<Dim>&, const Division&, double scale);

/// Implicit Euler: at the end of the step the volume that a point has gained is filled by what has flowed to it. The
/// balance is that of volumes, so that the sum of all nodes is exact at any strain: functions add up to one, and their
/// gradients to zero. Equal functions for displacements and pressures leave pressures that change from node to node
/// where water cannot flow; what is not linear of their growth in a cell is penalised. Both penalties add nothing to
/// the sum.
template <int Dim> class Flow : public CoupledTerm<Dim> {
public:
	static constexpr int field = 1;

	/// The water is kept by reference, and written in commitCoupled().
	Flow(SoilWater<Dim>&, const ConstrainedModulus&, const StepContext<Dim>&, const State& begin);
	~Flow() override;

	/// Symmetry with the sign of the field. The Jacobian of pore flow by displacements has no transpose; it is
	/// added where the matrix is not symmetric anyway, or where Newton's method asks for it.
	bool                        isSymmetric() const override { return !isExact_; }
	bool                        makeExact() override { return !std::exchange(isExact_, true); }
	std::string                 obstacle() const override { return obstacle_; }
	void                        mark(NodeMatrix<Dim>&) const override;
	void                        markCouplings(Couplings&) const override;
	std::optional<PointFailure> addCoupled(const State&, const FieldSum<Dim>&) const override;
	void                        addCoupledRoundOff(const State&, std::vector<Eigen::VectorXd>& absoluteContributions) const override;
	std::optional<FieldGrowth>  expected() const override;
	std::vector<LocalError>     fieldErrors(const State&) const override;
	void                        commitCoupled(const State&) override;

private:
	static constexpr int corners = 1 << Dim;

	/// A leaf whose pressures are kept from changing from node to node.
	struct Cell {
		std::array<int, corners> node;
		double                   weight; ///< filled volume over the modulus
	};
	/// A position of a drain: conductance [m3/Pa] in the step and pressure outside, or the volume that leaves [m3].
	struct Outlet {
		int             drain;
		Attachment<Dim> at;
		double          conductance = 0, given = 0;
		bool            isOneWay = false; ///< water can leave only
		bool            isRain   = false;
		double          rain     = 0; ///< the most that enters, or evaporates if negative [m3]

		std::array<double, corners> felt {}; ///< weights of the pressure that decides what passes

		double pressure(const Eigen::VectorXd& P) const
		{
			double sum = 0;
			for (int n = 0; n < at.nodes; ++n)
				sum += felt[n] * P[at.node[n]];
			return sum;
		}
	};
	void beginUnsaturated(const Eigen::VectorXd& before);
	void commitSaturation(const State&);

	UnsaturatedPoint<Dim> unsaturated(
	        int p, const Patch<Dim>& patch, const PointFunctions<Dim>& f, const FlowPoint<Dim>& s, const CurvesOfNodes::Wetness& now) const
	{
		const PorePoint&  point  = points_[p];
		const auto *const shared = curves_->of(p, before_), *const sharedNow = curves_->of(p, now);
		const auto make = [&](auto&& before, auto&& at) -> UnsaturatedPoint<Dim> {
			return { *water_.whole, point, before, at, now.pressures, correction_[p], patch, f, s };
		};
		if (shared) return make([&](int n) { return (*shared)[n].saturation.value; }, [&](int n) { return (*sharedNow)[n]; });
		const auto before  = [&](int n) { return saturationOf(*point.pores, before_.pressures[n], point.ratio).value; };
		const auto wetness = [&](int n) { return wetnessOf(*point.pores, now.pressures[n], s.poreRatio(point)); };
		return make(before, wetness);
	}
	/// Conductivity of a cell in the direction of a unit vector.
	double conductivityAlong(int cell, const Vec<Dim>& direction) const
	{
		if (cellRise_.empty()) return cellConductivity_[cell];
		return cellConductivity_[cell] + cellRise_[cell] * std::pow(water_.vertical.dot(direction), 2);
	}
	void        weighCells(const ConstrainedModulus&, const StepContext<Dim>&);
	void        addCell(Key, double weight, const StepContext<Dim>&);
	void        weighFaces(const std::vector<double>& softness, const std::vector<double>& permeability, const StepContext<Dim>&);
	bool        hasDirections() const;
	void        findNear(const StepContext<Dim>&);
	void        attachDrains(const StepContext<Dim>&);
	std::string attachDrain(int number, const StepContext<Dim>&);
	void        attachPassages(const StepContext<Dim>&);
	std::string enclosure(const StepContext<Dim>&) const;

	const FlowBlocks<Dim>& blocksIn(Couplings&) const;

	void   addPenalties(const Eigen::VectorXd& growth, const FieldSum<Dim>&, const FlowBlocks<Dim>*) const;
	void   addDrains(const Eigen::VectorXd& P, const FieldSum<Dim>&) const;
	double conductanceNow(const Outlet&, double pressure) const;
	double outflow(const Outlet&, double pressure) const;
	void   moveDrains(const Eigen::VectorXd& d, const Eigen::VectorXd& P);
	double workOn(const State&) const;
	void   keepGrowth(const State&) const;

	SoilWater<Dim>&              water_;
	const CloudBasis<Dim>&       basis_;
	double                       h_;
	const OwnedNodes&            ownedNodes_;
	const Division&              division_;
	std::vector<GhostFace<Dim>>  faces_;
	NearNodes<Dim>               near_;
	bool                         isExact_;
	std::vector<Pores>           ownPores_;         ///< pores of each point of the cloud, where some have their own; else empty
	std::deque<Retention>        ownCurves_;        ///< curves of points of other processes that have their own
	std::vector<PorePoint>       points_;           ///< points of the cloud
	std::vector<double>          cellConductivity_; ///< horizontal
	std::vector<double>          cellRise_;         ///< vertical less horizontal conductivity; empty where they are the same everywhere
	std::optional<CurvesOfNodes> curves_;           ///< where pores need not be full
	CurvesOfNodes::Wetness       before_;           ///< as the step begins
	std::vector<double>          correction_;       ///< what a point has more than its nodes say, over the initial volume
	std::vector<Cell>            cells_;
	Eigen::VectorXd              filled_; ///< volume that is filled around each node, if there is rain
	std::vector<Outlet>          outlets_;
	std::vector<Passage<Dim>>    passages_; ///< through cuts in the body
	std::vector<Attachment<Dim>> vertices_; ///< vertices of the drains, one after the other
	std::string                  obstacle_;

	mutable std::unique_ptr<FlowBlocks<Dim>> blocks_;
	mutable const double*                    blockValues_ = nullptr; ///< values of the matrix that they are in
};

} // namespace gimpm
