// SPDX-License-Identifier: GPL-2.0-or-later
// Action of bars and beams on the soil that they are in.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/structures/structure_system.hpp"
#include "core/terms/coupled_term.hpp"

namespace gimpm {

/// At each iterate the structure's own unknowns are those of its equilibrium with the soil as it is there. What is left
/// is a force on the nodes around it and its derivative, which is symmetric, dense among these nodes, and exact.
template <int Dim> class StructureForce : public CoupledTerm<Dim> {
public:
	/// The structure is moved in commitCoupled().
	StructureForce(Structure<Dim>&, const StepContext<Dim>&);

	void                        markCouplings(Couplings&) const override;
	std::optional<PointFailure> addCoupled(const State&, const FieldSum<Dim>&) const override;
	void                        addCoupledBefore(const State&, const FieldSum<Dim>&) const override;
	void                        commitCoupled(const State&) override;
	std::string                 obstacle() const override { return obstacle_; }
	double                      fromOutside(const Eigen::VectorXd& d) override;
	void                        restrain(const typename Term<Dim>::Constrain&) override;
	Refusal                     refusal(const Eigen::VectorXd& d) override;

private:
	static constexpr int field = 1; ///< of the pressures

	/// True where air does not take the place of water that pulls.
	bool presses(int node) const { return structure_.beam->waterPulls || water_[node] > 0; }

	std::vector<Vec<Dim>>     positions() const;
	std::vector<SoilAtVertex> soilAround(const StepContext<Dim>&);
	void                      lookBesideBeam(const StepContext<Dim>&, std::vector<SoilAtVertex>&) const;
	void                      partAlongBeam(const StepContext<Dim>&, std::vector<SoilAtVertex>&);
	void                      bondAheadOfTips(const StepContext<Dim>&, std::vector<SoilAtVertex>&);
	void                      wet(const StepContext<Dim>&);
	void                      keepWater();
	double                    pressureAt(int position) const;
	std::string               missingSoil(const StepContext<Dim>&, const std::vector<SoilAtVertex>&) const;
	std::string               pulledOut(const std::vector<SoilAtVertex>&) const;
	Eigen::VectorXd           soilAt(const Eigen::VectorXd& d) const;
	void                      addPressures(Eigen::VectorXd& soil) const;
	void                      distributeVolumes(const EnergySum&, const FieldSum<Dim>&) const;
	void                      markWater(Couplings&) const;
	void                      addWater(const Eigen::MatrixXd& K, Couplings&) const;
	Eigen::VectorXd           equilibrium(const Eigen::VectorXd& d) const;
	EnergySum                 asItBegins() const;
	void                      distribute(const EnergySum&, const FieldSum<Dim>&) const;
	template <class F> void   forVertices(F&& f) const;
	template <class F> void   forJoined(F&& f) const;
	template <class F> void   forWater(F&& f) const;

	Structure<Dim>&                             structure_;
	std::vector<std::optional<Attachment<Dim>>> attached_; ///< positions by vertex, and behind them those to the right of vertices of the beam
	std::vector<SoilAtVertex>                   soil_;
	std::optional<StructureSystem<Dim>>         system_;
	std::string                                 obstacle_;
	Eigen::VectorXd                             waterBefore_; ///< pressures of water that flows at nodes, as the step begins; empty: there is none
	mutable Eigen::VectorXd                     water_;       ///< pressures at the last iterate
	mutable Eigen::VectorXd                     last_;        ///< solution at the last iterate, from which the next one is looked for
};

} // namespace gimpm
