// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/explicit_inertia.hpp"
#include "core/base/stopwatch.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/terms/inertia/contact_impulse.hpp"
#include <algorithm>

namespace gimpm {
namespace {

template <int Dim> NodalMass<Dim> massOf(Motion<Dim>& motion, const StepContext<Dim>& step, double& seconds)
{
	const Stopwatch watch(seconds);
	// Full lumping loses angular momentum: it is for bodies of which no cell is filled.
	const int  anyWay  = int(step.faces.size());
	const auto loose   = looseOf(motion, step, anyWay);
	motion.loosePoints = countOfPoints(loose, step);
	return NodalMass<Dim>(step.basis, motion.mass, massFaces(motion, step), step.grid.cellSize, loose, step.ownedNodes);
}

} // namespace

template <int Dim>
ExplicitInertia<Dim>::ExplicitInertia(Motion<Dim>& motion, const StepContext<Dim>& step)
        : motion_(motion)
        , ownedNodes_(step.ownedNodes)
        , copies_(motion, step.division)
        , basis_(step.basis)
        , dofs_(step.dofs)
        , faces_(step.faces)
        , h_(step.grid.cellSize)
        , mass_(massOf(motion, step, seconds_))
{
	const Stopwatch watch(seconds_);
	impulse_ = blow_ = jump_ = Eigen::VectorXd::Zero(step.prescribed.size());
	damping_                 = dampingOf(motion.damping, step);
	begin(step);
	momentum_ = weighedAtNodes(basis_, motion_.mass, atMiddle_, ownedNodes_);
	middle_   = step.prescribed / motion_.duration;
	findMiddle();
	meet();
	findJump();
	acceleration_ = ofHeld<Dim>(Eigen::VectorXd::Zero(step.prescribed.size()), &MovingBase<Dim>::acceleration, motion.bases, step);
}

/// Velocities of the points in the middle of the step, by the accelerations that forces ask for as it begins.
template <int Dim> void ExplicitInertia<Dim>::begin(const StepContext<Dim>& step)
{
	const double          T     = motion_.duration;
	const Eigen::VectorXd zero  = Eigen::VectorXd::Zero(step.prescribed.size());
	Eigen::VectorXd       force = step.imbalance(), a = ofHeld<Dim>(zero, &MovingBase<Dim>::acceleration, motion_.bases, step);
	if (!damping_.empty()) {
		Eigen::VectorXd drag = zero;
		start_               = ofHeld<Dim>(step.prescribed / T, &MovingBase<Dim>::velocity, motion_.bases, step);
		solve(weighedAtNodes(basis_, motion_.mass, motion_.velocity, ownedNodes_), dofs_, start_);
		for (const auto& each : damping_)
			each->addBefore(start_, drag);
		ownedNodes_.complete(drag);
		basis_.affineConstraints.template condense<Dim>(drag);
		force -= drag;
	}
	solve(force, dofs_, a);
	motion_.growth = T / 2 * a;
	atMiddle_      = motion_.velocity;
	forPointNodes(basis_, [&](int i, const Patch<Dim>& patch, const double* value, int count) {
		atMiddle_[basis_.order[i]] += T / 2 * atPoint(patch, value, count, a);
	});
}

template <int Dim> void ExplicitInertia<Dim>::findMiddle()
{
	constexpr double      roundOff = 1e-12;
	const Eigen::VectorXd momentum = momentum_ + impulse_;
	solve(momentum, dofs_, middle_);
	blow_ = blowOf(mass_, middle_, momentum, roundOff, [&](Eigen::Index i) { return isConstrained(i); });
}

template <int Dim> void ExplicitInertia<Dim>::meet()
{
	if (!motion_.bodies || !motion_.bodies->acting) return;
	const ContactImpulse<Dim> contact(*motion_.bodies->acting, mass_, dofs_, motion_.duration);
	const auto                found = contact(middle_);
	meets_                          = found.has_value();
	if (!meets_ || found->isZero(0)) return;
	impulse_ = *found;
	findMiddle();
}

template <int Dim> void ExplicitInertia<Dim>::findJump()
{
	const Eigen::VectorXd all = blow_ + impulse_;
	if (!all.isZero(0)) solve(all, allFree<Dim>(all.size(), basis_.affineConstraints), jump_);
}

template <int Dim> void ExplicitInertia<Dim>::solve(const Eigen::VectorXd& right, const FreeDofs& dofs, Eigen::VectorXd& x, const Eigen::VectorXd* C)
{
	isSingular_ = !mass_.solve({ { right, dofs, x } }, {}, C) || isSingular_;
	basis_.affineConstraints.template distribute<Dim>(x);
}

template <int Dim> std::string ExplicitInertia<Dim>::obstacle() const
{
	for (const auto& each : damping_)
		if (std::string found = each->obstacle(); !found.empty()) return found;
	return "";
}

/// Forces C v that are diagonal act with the velocity at the end, v_1/2 + T/2 a_1: they cost no stability.
template <int Dim> Eigen::VectorXd ExplicitInertia<Dim>::accelerate(const Eigen::VectorXd& imbalance)
{
	const Stopwatch watch(seconds_);
	const double    T     = motion_.duration;
	Eigen::VectorXd force = Eigen::VectorXd::Zero(imbalance.size()), C = force;
	for (const auto& each : damping_) {
		each->add(middle_, 0, { force });
		each->addDiagonal(C);
	}
	if (!damping_.empty()) ownedNodes_.complete(force), ownedNodes_.complete(C);
	basis_.affineConstraints.template condense<Dim>(force);
	C *= T / 2;
	const Eigen::VectorXd driving = imbalance - force;
	solve(driving, dofs_, acceleration_, damping_.empty() ? nullptr : &C);
	end_                 = middle_ + T / 2 * acceleration_;
	Eigen::VectorXd held = mass_ * acceleration_ - driving + blow_ / T;
	for (Eigen::Index i = 0; i < held.size(); ++i)
		if (!isConstrained(i)) held[i] = 0;
	return held;
}

template <int Dim> void ExplicitInertia<Dim>::commit()
{
	const double          T = motion_.duration;
	const Eigen::VectorXd d = displacements(), growth = jump_ + T / 2 * acceleration_;
	Eigen::VectorXd       ghost = Eigen::VectorXd::Zero(d.size());
	addGhostForce(faces_, h_, d, ghost);
	ownedNodes_.complete(ghost);
	motion_.impactWork = energyOfBlow<NodalMass<Dim>>(mass_, middle_, blow_ + impulse_, jump_, middle_);
	// It acts in the second half, on the velocities' way from the one to the other.
	motion_.ghostWork = T / 4 * (middle_ + end_).dot(ghost);
	for (const auto& each : damping_)
		each->commit(d, start_, end_);
	motion_.growth += growth;
	motion_.acceleration.resize(motion_.velocity.size());
	forPointNodes(basis_, [&](int i, const Patch<Dim>& patch, const double* value, int count) {
		const int p             = basis_.order[i];
		motion_.acceleration[p] = atPoint(patch, value, count, acceleration_);
		motion_.velocity[p]     = atMiddle_[p] + atPoint(patch, value, count, growth);
	});
}

template class ExplicitInertia<2>;
template class ExplicitInertia<3>;

} // namespace gimpm
