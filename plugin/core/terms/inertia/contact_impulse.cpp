// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/contact_impulse.hpp"
#include "core/solvers/conjugate_gradients.hpp"

namespace gimpm {
namespace {

/// Tolerances on the impulse of all contact forces, and on momenta.
constexpr double impulseTolerance = 1e-9, roundOff = 1e-14;

/// Symmetric derivatives of rough contact leave out what friction gains as pressure does, and so it takes more.
constexpr int mostImpulses = 60;

void keepFree(const FreeDofs& dofs, Eigen::VectorXd& x)
{
	for (Eigen::Index i = 0; i < x.size(); ++i)
		if (dofs.number[i] < 0) x[i] = 0;
}

/// M + T^2 K at the free degrees of freedom.
template <int Dim> struct MassAndContact : SymmetricOperator {
	const NodalMass<Dim>& mass;
	const Couplings&      contact;
	const FreeDofs&       dofs;
	double                duration;

	MassAndContact(const NodalMass<Dim>& mass, const Couplings& contact, const FreeDofs& dofs, double duration)
	        : mass(mass), contact(contact), dofs(dofs), duration(duration)
	{
	}

	void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override
	{
		Eigen::VectorXd springs = Eigen::VectorXd::Zero(x.size());
		contact.multiplyAdd(x, springs);
		y = mass * x + duration * duration * springs;
		for (Eigen::Index i = 0; i < x.size(); ++i)
			if (dofs.number[i] < 0) y[i] = x[i];
	}
	Eigen::VectorXd diagonal() const override
	{
		Eigen::VectorXd sum(Eigen::Index(dofs.number.size()));
		for (Eigen::Index i = 0; i < sum.size(); ++i)
			sum[i] = mass.diagonal(int(i) / Dim);
		contact.forBlocks([&](const FieldNode& row, const FieldNode& column, const double* values) {
			for (int a = 0; a < Dim && row.node == column.node; ++a)
				sum[Dim * row.node + a] += duration * duration * values[a * Dim + a];
		});
		for (Eigen::Index i = 0; i < sum.size(); ++i)
			if (dofs.number[i] < 0) sum[i] = 1;
		return sum;
	}
};

} // namespace

template <int Dim>
ContactImpulse<Dim>::ContactImpulse(const BodyContact<Dim>& contact, const NodalMass<Dim>& mass, const FreeDofs& dofs, double duration)
        : contact_(contact)
        , mass_(mass)
        , dofs_(dofs)
        , duration_(duration)
        , map_(int(dofs.number.size()) / Dim, { { "displacement", "m", Dim } })
        , known_(Eigen::VectorXd::Zero(map_.size()))
{
	contact_.addUnweighted(nullptr, known_);
}

template <int Dim> auto ContactImpulse<Dim>::at(Eigen::VectorXd velocity, const Eigen::VectorXd& free, Couplings* K) const -> Iterate
{
	Eigen::VectorXd resistance = -known_;
	contact_.addWithTangent(duration_ * velocity, resistance, K);
	Iterate now { std::move(velocity), -duration_ * resistance, {}, 0 };
	now.rest = mass_ * (now.velocity - free) - now.impulse;
	now.size = impulseTolerance * duration_ * (resistance + known_).norm() + roundOff * (mass_ * free).norm();
	keepFree(dofs_, now.rest);
	return now;
}

template <int Dim> std::optional<Eigen::VectorXd> ContactImpulse<Dim>::change(const Iterate& now, const Couplings& K) const
{
	constexpr double          exactness = 1e-6;
	const MassAndContact<Dim> A(mass_, K, dofs_, duration_);
	ConjugateGradients        iteration(A, now.rest, exactness);
	iteration.iterate(mostIterations);
	Eigen::VectorXd found;
	if (!iteration.take(found).empty()) return std::nullopt;
	return found;
}

template <int Dim> std::optional<Eigen::VectorXd> ContactImpulse<Dim>::operator()(const Eigen::VectorXd& free) const
{
	Iterate now = at(free, free, nullptr);
	if (now.impulse.isZero(0)) return now.impulse;
	Couplings K;
	K.reset(map_, true);
	contact_.markCouplings(K);
	for (int i = 0; i < mostImpulses; ++i) {
		K.setZero();
		now = at(now.velocity, free, &K);
		if (now.rest.norm() <= now.size) return now.impulse;
		const auto found = change(now, K);
		if (!found) return std::nullopt;
		Iterate next = at(now.velocity - *found, free, nullptr);
		for (double part = 0.5; next.rest.norm() > now.rest.norm() && part > 0.05; part /= 2)
			next = at(now.velocity - part * *found, free, nullptr);
		now = std::move(next);
	}
	return std::nullopt;
}

template class ContactImpulse<2>;
template class ContactImpulse<3>;

} // namespace gimpm
