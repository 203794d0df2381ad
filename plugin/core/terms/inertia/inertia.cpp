// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/inertia.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/terms/bodies/body_contact.hpp"
#include "core/terms/contact/contact.hpp"
#include <algorithm>
#include <numeric>

namespace gimpm {

template <int Dim>
Inertia<Dim>::Inertia(Motion<Dim>& motion, const StepContext<Dim>& step)
        : motion_(motion)
        , division_(step.division)
        , ownedNodes_(step.ownedNodes)
        , copies_(motion, step.division)
        , basis_(step.basis)
        , dofs_(step.dofs)
        , prescribed_(step.prescribed)
        , faces_(step.faces)
        , h_(step.grid.cellSize)
        , loose_(looseOf(motion, step))
        , mass_(massMatrix(motion, step, loose_))
        , nodal_(mass_, basis_.affineConstraints)
        , iterates_(motion.ghostMass > 0)
{
	imbalance_ = neglected_ = acceleration_ = expected_ = blow_ = jump_ = Eigen::VectorXd::Zero(prescribed_.size());
	velocity_ = ofHeld<Dim>(prescribed_ / motion.duration, &MovingBase<Dim>::velocity, motion.bases, step);
	if (motion.scheme.dependsOnStart()) expected_ = ofHeld<Dim>(acceleration_, &MovingBase<Dim>::acceleration, motion.bases, step);
	damping_ = dampingOf(motion.damping, step);
	findExtent(step);
	findStart(step);
}

template <int Dim> void Inertia<Dim>::findExtent(const StepContext<Dim>& step)
{
	motion_.loosePoints = countOfPoints(loose_, step);
	if (motion_.loosePoints == 0) return;
	extent_ = std::make_unique<MassMatrix<Dim>>(step.basis.nodes.size(), extentOf(loose_, motion_, step), 1);
	extent_->complete(ownedNodes_, step.basis.nodes);
}

/// It takes part at the end of a step, as long as cells are loose.
template <int Dim> Eigen::VectorXd Inertia<Dim>::ofExtent(const Eigen::VectorXd& acceleration) const
{
	const double ofEnd = (1 - motion_.scheme.alphaM) / (1 - motion_.scheme.alphaF);
	return *extent_ * (ofEnd * acceleration);
}

/// Velocities and accelerations at the nodes, those of the points, or where they are at the beginning the accelerations
/// of equilibrium. What the latter would do besides is kept for the balance of energy: found anew in each step, they
/// would throw nodes of hardly any mass about, and in long steps change their sign from one to the next.
template <int Dim> void Inertia<Dim>::findStart(const StepContext<Dim>& step)
{
	const bool isDriven = motion_.scheme.dependsOnStart();
	const bool isFirst  = begins(motion_, division_);
	findVelocity(isDriven && !isFirst);
	mend(step, isDriven && !isFirst);
	if (!isDriven) return;
	const Eigen::VectorXd all = imbalanceOf(step), contact = ofContact(nullptr);
	if (isFirst) solve({ { all, dofs_, expected_ } });
	acceleration_ = expected_;
	if (!contact.isZero(0)) acceleration_ -= solved(contact);
	imbalance_ = all - contact;
	neglected_ = imbalance_ - nodal_ * acceleration_;
	for (Eigen::Index i = 0; i < imbalance_.size(); ++i) {
		if (isConstrained(i)) neglected_[i] = 0;
		if (isConstrained(i) || motion_.scheme.alphaF == 0) imbalance_[i] = 0;
	}
}

/// Imbalance of all forces as the step begins, also at constrained nodes.
template <int Dim> Eigen::VectorXd Inertia<Dim>::imbalanceOf(const StepContext<Dim>& step) const
{
	Eigen::VectorXd all = step.imbalance();
	if (!damping_.empty()) {
		Eigen::VectorXd damping = Eigen::VectorXd::Zero(all.size());
		for (const auto& each : damping_)
			each->addBefore(velocity_, damping);
		ownedNodes_.complete(damping);
		basis_.affineConstraints.template condense<Dim>(damping);
		all -= damping;
	}
	return all;
}

/// Finds nodal velocities, and where nodes are constrained also those without the constraint: the blow of the
/// constraint has changed them by the difference.
template <int Dim> void Inertia<Dim>::findVelocity(bool withAcceleration)
{
	const double          roundOff = motion_.exactness;
	const Eigen::VectorXd momentum = weighedAtNodes(basis_, motion_.mass, motion_.velocity, ownedNodes_);
	const Eigen::VectorXd carried  = withAcceleration ? weighedAtNodes(basis_, motion_.mass, motion_.acceleration, ownedNodes_) : Eigen::VectorXd();
	const FreeDofs        all      = allFree<Dim>(momentum.size(), basis_.affineConstraints);
	const bool            together = iterates_ && dofs_.count < all.count;
	Eigen::VectorXd       before   = Eigen::VectorXd::Zero(momentum.size());
	std::vector<Side>     sides    = { { momentum, dofs_, velocity_ } };
	if (withAcceleration) sides.push_back({ carried, dofs_, expected_ });
	if (together) sides.push_back({ momentum, all, before });
	solve(sides);
	blow_ = blowOf(nodal_, velocity_, momentum, roundOff, [&](Eigen::Index i) { return isConstrained(i); });
	if (blow_.isZero(0)) return;
	if (together) jump_ = velocity_ - before;
	else
		solve({ { blow_, all, jump_ } });
}

/// Mends velocities that would tear loose cells: they are found again, with more mass there.
template <int Dim> void Inertia<Dim>::mend(const StepContext<Dim>& step, bool withAcceleration)
{
	if (motion_.loosePoints == 0) return;
	const auto torn = tornOf(loose_, velocity_, motion_, step);
	if (division_.sum(double(torn.size())) == 0) return;
	mass_       = massMatrix(motion_, step, loose_, torn);
	nodal_      = NodalMass<Dim>(mass_, basis_.affineConstraints);
	iterates_   = true;
	factorised_ = {};
	jump_.setZero();
	findVelocity(withAcceleration);
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::ofContact(const Eigen::VectorXd* d) const
{
	Eigen::VectorXd resistance = Eigen::VectorXd::Zero(prescribed_.size());
	if (motion_.contacts && motion_.contacts->acting) motion_.contacts->acting->addUnweighted(d, resistance);
	if (motion_.bodies && motion_.bodies->acting) motion_.bodies->acting->addUnweighted(d, resistance);
	basis_.affineConstraints.template condense<Dim>(resistance);
	return -resistance;
}

/// (M + M_g) x = right at the free degrees of freedom, with the values that the constrained ones have. Conjugate
/// gradients where ghost mass bounds the condition number; for little of it, or points that lie alone, the factor is
/// cheaper.
template <int Dim> void Inertia<Dim>::solve(const std::vector<Side>& sides)
{
	constexpr int worthwhile = 300;
	iterates_                = iterates_ && nodal_.solve(sides, { motion_.exactness, worthwhile }); // else there is a factor in this step
	if (!iterates_) solveByFactor(sides);
	for (const Side& side : sides)
		basis_.affineConstraints.template distribute<Dim>(side.x);
}

template <int Dim> void Inertia<Dim>::solveByFactor(const std::vector<Side>& sides)
{
	for (const Side& side : sides) {
		for (Eigen::Index i = 0; i < side.x.size(); ++i)
			if (side.dofs.number[i] >= 0) side.x[i] = 0;
		const Eigen::VectorXd rest = side.right - nodal_ * side.x;
		for (int axis = 0; axis < Dim; ++axis)
			solveAlong(axis, side, rest);
	}
}

/// Solves with a factor, which is kept in this step.
template <int Dim> void Inertia<Dim>::solveAlong(int axis, const Side& side, const Eigen::VectorXd& rest)
{
	const int       solver = &side.dofs == &dofs_ ? axis : Dim;
	Eigen::VectorXd free(rest.size() / Dim), found;
	int             n = 0;
	for (Eigen::Index i = axis; i < rest.size(); i += Dim)
		if (side.dofs.number[i] >= 0) free[n++] = rest[i];
	if (n == 0) return;
	free.conservativeResize(n);
	if (!factorised_[solver])
		isSingular_ = motion_.solvers[solver].solve(mass_.reduced(side.dofs, axis), free, found) == LinearSolver::Status::singular || isSingular_;
	else
		motion_.solvers[solver].solveAgain(free, found);
	factorised_[solver] = true;
	if (isSingular_) return;
	n = 0;
	for (Eigen::Index i = axis; i < rest.size(); i += Dim)
		if (side.dofs.number[i] >= 0) side.x[i] = found[n++];
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::solved(const Eigen::VectorXd& right)
{
	Eigen::VectorXd x = Eigen::VectorXd::Zero(right.size());
	solve({ { right, dofs_, x } });
	return x;
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::accelerationAt(const Eigen::VectorXd& d) const
{
	const double beta = motion_.scheme.beta, T = motion_.duration;
	return (d - T * velocity_) / (beta * T * T) - (1 / (2 * beta) - 1) * acceleration_;
}

/// Velocity at the time at which the scheme takes the forces of the step.
template <int Dim> Eigen::VectorXd Inertia<Dim>::velocityAt(const Eigen::VectorXd& d) const
{
	const auto& scheme = motion_.scheme;
	if (scheme.atMiddle) return d / motion_.duration;
	return velocity_ + motion_.duration * ((1 - scheme.gamma) * acceleration_ + scheme.gamma * accelerationAt(d));
}

template <int Dim> void Inertia<Dim>::mark(NodeMatrix<Dim>& K) const
{
	mass_.mark(K);
	if (extent_) extent_->mark(K);
	for (const auto& each : damping_)
		each->mark(K);
}

template <int Dim> bool Inertia<Dim>::isSymmetric() const
{
	return std::all_of(damping_.begin(), damping_.end(), [](const auto& each) { return each->isSymmetric(); });
}

template <int Dim> std::string Inertia<Dim>::obstacle() const
{
	for (const auto& each : damping_)
		if (std::string found = each->obstacle(); !found.empty()) return found;
	return {};
}

template <int Dim> std::optional<PointFailure> Inertia<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	const auto&           scheme = motion_.scheme;
	const double          weight = 1 - scheme.alphaF, ofEnd = (1 - scheme.alphaM) / weight;
	const Eigen::VectorXd a     = accelerationAt(d);
	Eigen::VectorXd       force = nodal_ * a;
	if (scheme.isAlpha()) {
		const Eigen::VectorXd weighted = nodal_ * (ofEnd * a + scheme.alphaM / weight * acceleration_) - scheme.alphaF / weight * imbalance_;
		for (Eigen::Index i = 0; i < force.size(); ++i)
			if (!isConstrained(i)) force[i] = weighted[i]; // those at constrained nodes are reactions at the end of the step
	}
	force += blow_ / motion_.duration;
	if (extent_) force += ofExtent(a);
	sum.force += force;
	if (sum.absoluteContributions) *sum.absoluteContributions += force.cwiseAbs();
	const double massFactor = ofEnd / (scheme.beta * motion_.duration * motion_.duration);
	if (sum.K) mass_.addTo(*sum.K, massFactor);
	if (sum.K && extent_) extent_->addTo(*sum.K, massFactor);
	if (damping_.empty()) return std::nullopt;
	const Eigen::VectorXd v = velocityAt(d);
	for (const auto& each : damping_)
		each->add(v, scheme.atMiddle ? 1 / motion_.duration : scheme.gamma / (scheme.beta * motion_.duration), sum);
	return std::nullopt;
}

template <int Dim> double Inertia<Dim>::fromOutside(const Eigen::VectorXd& d)
{
	Eigen::VectorXd force = nodal_ * accelerationAt(d);
	for (Eigen::Index i = 0; i < force.size(); ++i)
		if (isConstrained(i)) force[i] = 0; // they are part of the reactions
	double squares = force.squaredNorm();
	for (const auto& each : damping_)
		squares += std::pow(each->fromOutside(velocityAt(d)), 2);
	return std::sqrt(squares);
}

template <int Dim> void Inertia<Dim>::addRoundOff(const Eigen::VectorXd& d, Eigen::VectorXd& absoluteContributions) const
{
	constexpr double roundOff = 10 * std::numeric_limits<double>::epsilon();
	const double     T        = motion_.duration;
	const double     factor   = roundOff / (motion_.scheme.beta * T * T);
	const auto       moved    = (d.cwiseAbs() + T * velocity_.cwiseAbs()).eval();
	absoluteContributions += factor * mass_.absoluteTimes(moved);
	if (extent_) absoluteContributions += factor * extent_->absoluteTimes(moved);
	basis_.affineConstraints.template condense<Dim>(absoluteContributions);
}

/// Bodies that meet might move far into each other by themselves, and what touches as the step begins would not be what
/// touches at its end. Where that would take larger forces than to stop all nodes they stay where they are.
template <int Dim> Eigen::VectorXd Inertia<Dim>::inertialPredictor() const
{
	const double    T = motion_.duration;
	Eigen::VectorXd d = T * velocity_ + T * T / 2 * expected_;
	for (Eigen::Index i = 0; i < d.size(); ++i)
		if (isConstrained(i)) d[i] = prescribed_[i];
	basis_.affineConstraints.template distribute<Dim>(d);
	if (!motion_.bodies || !motion_.bodies->acting) return d;
	Eigen::VectorXd contact = Eigen::VectorXd::Zero(d.size()), stopping = nodal_ * accelerationAt(prescribed_);
	motion_.bodies->acting->addUnweighted(&d, contact);
	basis_.affineConstraints.template condense<Dim>(contact);
	for (Eigen::Index i = 0; i < d.size(); ++i)
		if (isConstrained(i)) contact[i] = stopping[i] = 0;
	return contact.norm() > stopping.norm() ? prescribed_ : d;
}

template <int Dim> void Inertia<Dim>::restrain(const typename Term<Dim>::Constrain& constrain)
{
	for (int n = 0; n < mass_.nodes(); ++n)
		for (int a = 0; a < Dim; ++a)
			constrain(n, Vec<Dim>::Unit(a), Vec<Dim>::Zero());
}

/// Local error of d: (beta - 1/6) T^2 (a_1 - a_0) (Zienkiewicz and Xie 1991), at the nodes.
template <int Dim> LocalError Inertia<Dim>::localError(const Eigen::VectorXd& d) const
{
	if (motion_.tolerance == Motion<Dim>::infinite) return {};
	const double          T = motion_.duration, part = motion_.scheme.beta - 1. / 6;
	const Eigen::VectorXd error = part * T * T * (accelerationAt(d) - acceleration_);
	return { error.template lpNorm<Eigen::Infinity>(), motion_.tolerance };
}

template <int Dim> double Inertia<Dim>::kineticEnergy() const
{
	double sum = 0;
	for (int p = 0, own = division_.ownOf(motion_.velocity.size()); p < own; ++p)
		sum += motion_.mass[p] * motion_.velocity[p].squaredNorm() / 2;
	return division_.sum(sum);
}

template <int Dim> auto Inertia<Dim>::pushedAt(const Eigen::VectorXd& d) -> const Pushed&
{
	if (pushed_.d.size() == d.size() && pushed_.d == d) return pushed_;
	const Eigen::VectorXd force = ofContact(&d);
	pushed_                     = { d, force, force.isZero(0) ? force : solved(force) };
	return pushed_;
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::withoutContact(const Eigen::VectorXd& d)
{
	return accelerationAt(d) - pushedAt(d).acceleration / (2 * motion_.scheme.beta);
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::growthAt(const Eigen::VectorXd& d)
{
	const double gamma = motion_.scheme.gamma;
	return motion_.duration * ((1 - gamma) * acceleration_ + gamma * withoutContact(d) + pushedAt(d).acceleration);
}

/// Work of the mean of the forces at both ends, those of equilibrium at nodes that are constrained, less what the
/// kinetic energy of the nodes grows by: what a new grid takes and, where equilibrium is weighed, what the scheme
/// damps.
template <int Dim> double Inertia<Dim>::gridWork(const Eigen::VectorXd& d)
{
	const auto& scheme = motion_.scheme;
	if (!scheme.isAlpha()) return (1 - scheme.gamma) * d.dot(neglected_);
	const double          weight = 1 - scheme.alphaF;
	const Eigen::VectorXd others = withoutContact(d), growth = growthAt(d), first = nodal_ * acceleration_ + neglected_;
	Eigen::VectorXd       last = nodal_ * others;
	const Eigen::VectorXd weighed
	        = nodal_ * ((1 - scheme.alphaM) / weight * others + scheme.alphaM / weight * acceleration_) - scheme.alphaF / weight * first;
	for (Eigen::Index i = 0; i < last.size(); ++i)
		if (!isConstrained(i)) last[i] = weighed[i];
	return d.dot((first + last) / 2 + pushedAt(d).force) - (velocity_ + growth / 2).dot(nodal_ * growth);
}

template <int Dim> void Inertia<Dim>::commit(const Eigen::VectorXd& d)
{
	const double          gamma = motion_.scheme.gamma, T = motion_.duration;
	const Eigen::VectorXd end = withoutContact(d) + pushedAt(d).acceleration, growth = jump_ + growthAt(d);
	Eigen::VectorXd       ghost = Eigen::VectorXd::Zero(d.size());
	addGhostForce(faces_, h_, d, ghost);
	ownedNodes_.complete(ghost);
	motion_.impactWork           = energyOfBlow(nodal_, velocity_, blow_, jump_, prescribed_ / T);
	motion_.gridWork             = gridWork(d);
	const Eigen::VectorXd looked = velocityAt(d);
	for (const auto& each : damping_)
		each->commit(d, motion_.scheme.atMiddle ? looked : velocity_, looked);
	motion_.acceleration.resize(motion_.velocity.size());
	std::vector<double> ofPoints(motion_.velocity.size());
	forPointNodes(basis_, [&](int i, const Patch<Dim>& patch, const double* value, int count) {
		const int      p        = basis_.order[i];
		const Vec<Dim> gained   = atPoint(patch, value, count, growth);
		motion_.acceleration[p] = atPoint(patch, value, count, end);
		motion_.velocity[p] += gained;
		ofPoints[p] = motion_.mass[p] * gained.squaredNorm();
	});
	const double gained = std::accumulate(ofPoints.begin(), ofPoints.begin() + division_.ownOf(ofPoints.size()), 0.);
	motion_.growth      = growth;
	// the force of the ghost stiffness begins at zero in each step; points do not take over what the nodes change
	// in the ghost mass
	const double ofEnd = motion_.scheme.isAlpha() ? 0.5 : gamma; // forces of its two ends, as in gridWork
	motion_.ghostWork  = ofEnd * d.dot(ghost) + (growth.dot(nodal_ * growth) - division_.sum(gained)) / 2;
	if (extent_) motion_.ghostWork += ofEnd * d.dot(ofExtent(accelerationAt(d)));
}

template class Inertia<2>;
template class Inertia<3>;

} // namespace gimpm
