// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/terms/internal_force.hpp"
#include <algorithm>
#include <numeric>
#include <sstream>

namespace gimpm {

template <int Dim> std::vector<GhostFace<Dim>> massFaces(const Motion<Dim>& motion, const Beginning<Dim>& step)
{
	if (motion.ghostMass == 0) return {};
	std::vector<GhostFace<Dim>> faces   = step.faces;
	const PointStiffness        density = [&](int p) {
                const double volume = step.stiffnessOf(p).volume;
                return VolumeAndModulus { volume, motion.mass[p] / volume };
	};
	weighGhostFaces(faces, step.basis, density, step.grid, motion.ghostMass, GhostScaling::paper);
	return faces;
}

template <int Dim> std::vector<LooseCell<Dim>> looseOf(const Motion<Dim>& motion, const Beginning<Dim>& step, int reach)
{
	if (motion.ghostMass == 0) return {};
	return looseCells(step.basis, motion.mass, step.faces, step.grid, reach);
}

template <int Dim> Eigen::VectorXd weighedAtNodes(const CloudBasis<Dim>& basis, const std::vector<double>& mass, const std::vector<Vec<Dim>>& ofPoints)
{
	std::vector<Vec<Dim>> weighted(ofPoints.size());
	for (std::size_t p = 0; p < weighted.size(); ++p)
		weighted[p] = mass[p] * ofPoints[p];
	Eigen::VectorXd sum = Eigen::VectorXd::Zero(Dim * Eigen::Index(basis.nodes.size()));
	addPointForces(basis, weighted, sum);
	return sum;
}

template <int Dim>
Eigen::VectorXd ofHeld(const Eigen::VectorXd& otherwise, OfBase<Dim> value, const std::vector<MovingBase<Dim>>& bases, const Beginning<Dim>& step)
{
	Eigen::VectorXd x = otherwise;
	for (const auto& base : bases)
		for (std::size_t n = 0; n < step.basis.nodes.size(); ++n)
			for (int a = 0; a < Dim; ++a)
				if (step.dofs.number[Dim * n + a] < 0 && base.box.holds(Grid<Dim>::index(step.basis.nodes[n]), a))
					x[Dim * n + a] = (base.*value)[a];
	return x;
}

template <int Dim>
Inertia<Dim>::Inertia(Motion<Dim>& motion, const Beginning<Dim>& step)
        : motion_(motion)
        , basis_(step.basis)
        , dofs_(step.dofs)
        , prescribed_(step.prescribed)
        , faces_(step.faces)
        , h_(step.grid.cellSize)
        , mass_(step.basis, motion.mass, massFaces(motion, step), step.grid.cellSize, looseOf(motion, step))
{
	imbalance_ = neglected_ = acceleration_ = expected_ = blow_ = jump_ = Eigen::VectorXd::Zero(prescribed_.size());
	const auto held = [&](const Eigen::VectorXd& otherwise, OfBase<Dim> value) { return ofHeld(otherwise, value, motion.bases, step); };
	findVelocity(held(prescribed_ / motion.duration, &MovingBase<Dim>::velocity));
	for (const auto& make : motion.damping)
		damping_.push_back(make(step));
	if (motion.scheme.dependsOnStart()) findAcceleration(step, held(acceleration_, &MovingBase<Dim>::acceleration));
}

/// Of all forces as the step begins, also at held nodes.
template <int Dim> Eigen::VectorXd Inertia<Dim>::imbalanceOf(const Beginning<Dim>& step) const
{
	const Eigen::VectorXd others = step.imbalance();
	if (damping_.empty()) return others;
	Eigen::VectorXd damping = Eigen::VectorXd::Zero(others.size());
	for (const auto& each : damping_)
		each->addBefore(velocity_, damping);
	return others - damping;
}

template <int Dim> void Inertia<Dim>::findVelocity(const Eigen::VectorXd& ofHeld)
{
	constexpr double      roundOff = 1e-13;
	const Eigen::VectorXd momentum = weighedAtNodes(basis_, motion_.mass, motion_.velocity);
	velocity_                      = solve(momentum, ofHeld);
	blow_                          = blowOf(mass_, velocity_, momentum, roundOff, [&](Eigen::Index i) { return isHeld(i); });
	FreeDofs all;
	all.number.assign(blow_.size(), 0);
	for (int axis = 0; axis < Dim; ++axis) {
		bool isHit = false;
		for (Eigen::Index i = axis; i < blow_.size(); i += Dim)
			isHit = isHit || blow_[i] != 0;
		if (!isHit) continue;
		solve(axis, Dim, all, blow_, jump_);
	}
}

/// Those of the points, or where they are at the beginning those of equilibrium. What the latter would do besides is kept for the balance of energy: found anew in each
/// step, they would throw nodes of hardly any mass about, and in long steps change their sign from one to the next.
template <int Dim> void Inertia<Dim>::findAcceleration(const Beginning<Dim>& step, const Eigen::VectorXd& ofHeld)
{
	const Eigen::VectorXd contact = ofContact(nullptr), all = imbalanceOf(step);
	const bool            begins = std::all_of(motion_.acceleration.begin(), motion_.acceleration.end(), [](const Vec<Dim>& a) { return a.isZero(0); });
	const Eigen::VectorXd force  = begins ? all : weighedAtNodes(basis_, motion_.mass, motion_.acceleration);
	acceleration_                = solve(force - contact, ofHeld);
	expected_                    = contact.isZero(0) ? acceleration_ : solve(force, ofHeld);
	imbalance_                   = all - contact;
	if (!motion_.scheme.isAlpha()) neglected_ = imbalance_ - mass_ * acceleration_;
	for (Eigen::Index i = 0; i < imbalance_.size(); ++i) {
		if (isHeld(i)) neglected_[i] = 0;
		if (isHeld(i) || motion_.scheme.alphaF == 0) imbalance_[i] = 0;
	}
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::ofContact(const Eigen::VectorXd* d) const
{
	Eigen::VectorXd resistance = Eigen::VectorXd::Zero(prescribed_.size());
	if (!motion_.contacts || !motion_.contacts->acting) return resistance;
	if (!d) motion_.contacts->acting->addBefore(resistance);
	else
		motion_.contacts->acting->add(*d, { resistance });
	return -resistance / (d ? motion_.contacts->weight : 1);
}

/// x of (M + M_g) x = momentum at the free degrees of freedom, with the values that the held ones have.
template <int Dim> Eigen::VectorXd Inertia<Dim>::solve(const Eigen::VectorXd& momentum, const Eigen::VectorXd& ofHeld)
{
	Eigen::VectorXd       x    = ofHeld;
	const Eigen::VectorXd rest = momentum - mass_ * ofHeld;
	for (int axis = 0; axis < Dim; ++axis)
		solve(axis, axis, dofs_, rest, x);
	return x;
}

/// Sets x at the free degrees of freedom along an axis. A solver keeps the factor of its matrix in this step.
template <int Dim> void Inertia<Dim>::solve(int axis, int solver, const FreeDofs& dofs, const Eigen::VectorXd& right, Eigen::VectorXd& x)
{
	Eigen::VectorXd free(x.size() / Dim), found;
	int             n = 0;
	for (Eigen::Index i = axis; i < x.size(); i += Dim)
		if (dofs.number[i] >= 0) free[n++] = right[i];
	if (n == 0) return;
	free.conservativeResize(n);
	if (!factorised_[solver])
		isSingular_ = motion_.solvers[solver].solve(mass_.reduced(dofs, axis), free, found) == LinearSolver::Status::singular || isSingular_;
	else
		motion_.solvers[solver].solveAgain(free, found);
	factorised_[solver] = true;
	if (isSingular_) return;
	n = 0;
	for (Eigen::Index i = axis; i < x.size(); i += Dim)
		if (dofs.number[i] >= 0) x[i] = found[n++];
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::accelerationAt(const Eigen::VectorXd& d) const
{
	const double beta = motion_.scheme.beta, T = motion_.duration;
	return (d - T * velocity_) / (beta * T * T) - (1 / (2 * beta) - 1) * acceleration_;
}

/// Where the forces of the step are looked at.
template <int Dim> Eigen::VectorXd Inertia<Dim>::velocityAt(const Eigen::VectorXd& d) const
{
	const auto& scheme = motion_.scheme;
	if (scheme.atMiddle) return d / motion_.duration;
	return velocity_ + motion_.duration * ((1 - scheme.gamma) * acceleration_ + scheme.gamma * accelerationAt(d));
}

template <int Dim> void Inertia<Dim>::mark(NodeMatrix<Dim>& K) const
{
	mass_.mark(K);
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

template <int Dim> std::optional<PointFailure> Inertia<Dim>::add(const Eigen::VectorXd& d, const TermSum<Dim>& sum) const
{
	const auto&           scheme = motion_.scheme;
	const double          weight = 1 - scheme.alphaF, ofEnd = (1 - scheme.alphaM) / weight;
	const Eigen::VectorXd a     = accelerationAt(d);
	Eigen::VectorXd       force = mass_ * a;
	if (scheme.isAlpha()) {
		const Eigen::VectorXd weighted = mass_ * (ofEnd * a + scheme.alphaM / weight * acceleration_) - scheme.alphaF / weight * imbalance_;
		for (Eigen::Index i = 0; i < force.size(); ++i)
			if (!isHeld(i)) force[i] = weighted[i]; // those at held nodes are reactions at the end of the step
	}
	force += blow_ / motion_.duration;
	sum.force += force;
	if (sum.sizes) *sum.sizes += force.cwiseAbs();
	if (sum.K) mass_.addTo(*sum.K, ofEnd / (scheme.beta * motion_.duration * motion_.duration));
	if (damping_.empty()) return std::nullopt;
	const Eigen::VectorXd v = velocityAt(d);
	for (const auto& each : damping_)
		each->add(v, scheme.atMiddle ? 1 / motion_.duration : scheme.gamma / (scheme.beta * motion_.duration), sum);
	return std::nullopt;
}

template <int Dim> double Inertia<Dim>::fromOutside(const Eigen::VectorXd& d) const
{
	Eigen::VectorXd force = mass_ * accelerationAt(d);
	for (Eigen::Index i = 0; i < force.size(); ++i)
		if (isHeld(i)) force[i] = 0; // they are part of the reactions
	double squares = force.squaredNorm();
	for (const auto& each : damping_)
		squares += std::pow(each->fromOutside(velocityAt(d)), 2);
	return std::sqrt(squares);
}

template <int Dim> void Inertia<Dim>::addRoundOff(const Eigen::VectorXd& d, Eigen::VectorXd& sizes) const
{
	constexpr double roundOff = 10 * std::numeric_limits<double>::epsilon();
	const double     T        = motion_.duration;
	sizes += roundOff / (motion_.scheme.beta * T * T) * mass_.sizesTimes(d.cwiseAbs() + T * velocity_.cwiseAbs());
}

template <int Dim> Eigen::VectorXd Inertia<Dim>::ownMotion() const
{
	const double    T = motion_.duration;
	Eigen::VectorXd d = T * velocity_ + T * T / 2 * expected_;
	for (Eigen::Index i = 0; i < d.size(); ++i)
		if (isHeld(i)) d[i] = prescribed_[i];
	return d;
}

template <int Dim> void Inertia<Dim>::restrain(const typename Term<Dim>::Hold& hold) const
{
	for (int n = 0; n < mass_.nodes(); ++n)
		for (int a = 0; a < Dim; ++a)
			hold(n, Vec<Dim>::Unit(a), Vec<Dim>::Zero());
}

/// What one step leaves out of d: (beta - 1/6) T^2 (a_1 - a_0) (Zienkiewicz and Xie 1991), at the nodes.
template <int Dim> LocalError Inertia<Dim>::localError(const Eigen::VectorXd& d) const
{
	if (motion_.tolerance == Motion<Dim>::infinite) return {};
	const double          T = motion_.duration, part = motion_.scheme.beta - 1. / 6;
	const Eigen::VectorXd error = part * T * T * (accelerationAt(d) - acceleration_);
	return { error.template lpNorm<Eigen::Infinity>(), motion_.tolerance };
}

template <int Dim> void Inertia<Dim>::commit(const Eigen::VectorXd& d)
{
	const double          beta = motion_.scheme.beta, gamma = motion_.scheme.gamma, T = motion_.duration;
	const Eigen::VectorXd force = ofContact(&d), zero = Eigen::VectorXd::Zero(d.size());
	const Eigen::VectorXd contact = force.isZero(0) ? zero : solve(force, zero), others = accelerationAt(d) - contact / (2 * beta);
	const Eigen::VectorXd end = others + contact, growth = jump_ + T * ((1 - gamma) * acceleration_ + gamma * others + contact);
	Eigen::VectorXd       ghost = Eigen::VectorXd::Zero(d.size());
	addGhostForce(faces_, h_, d, ghost);
	motion_.impactWork           = energyOfBlow(mass_, velocity_, blow_, jump_, prescribed_ / T);
	motion_.gridWork             = (1 - gamma) * d.dot(neglected_);
	const Eigen::VectorXd looked = velocityAt(d);
	for (const auto& each : damping_)
		each->commit(d, motion_.scheme.atMiddle ? looked : velocity_, looked);
	motion_.acceleration.assign(motion_.velocity.size(), Vec<Dim>::Zero());
	std::vector<double> ofPoints(motion_.velocity.size());
	forPointNodes(basis_, [&](int i, const Patch<Dim>& patch, const double* value, int count) {
		const int p      = basis_.order[i];
		Vec<Dim>  gained = Vec<Dim>::Zero();
		for (int n = 0; n < count; ++n) {
			if (patch.node[n] < 0) continue;
			gained += value[n] * growth.template segment<Dim>(Dim * patch.node[n]);
			motion_.acceleration[p] += value[n] * end.template segment<Dim>(Dim * patch.node[n]);
		}
		motion_.velocity[p] += gained;
		ofPoints[p] = motion_.mass[p] * gained.squaredNorm();
	});
	// the force of the ghost stiffness begins at zero in each step; points do not take over what the nodes change in the ghost mass
	motion_.ghostWork = gamma * d.dot(ghost) + (growth.dot(mass_ * growth) - std::accumulate(ofPoints.begin(), ofPoints.end(), 0.)) / 2;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template class Inertia<Dim>;                                                                                                                           \
	template std::vector<LooseCell<Dim>> looseOf(const Motion<Dim>&, const Beginning<Dim>&, int);                                                          \
	template std::vector<GhostFace<Dim>> massFaces(const Motion<Dim>&, const Beginning<Dim>&);                                                             \
	template Eigen::VectorXd             weighedAtNodes(const CloudBasis<Dim>&, const std::vector<double>&, const std::vector<Vec<Dim>>&);                 \
	template Eigen::VectorXd             ofHeld(const Eigen::VectorXd&, OfBase<Dim>, const std::vector<MovingBase<Dim>>&, const Beginning<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
