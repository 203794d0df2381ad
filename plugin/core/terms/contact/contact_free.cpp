// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/contact_free.hpp"
#include "core/solvers/least_squares.hpp"
#include <Eigen/Geometry>
#include <algorithm>

namespace gimpm {
namespace {

constexpr double balanced = 1e-11; ///< admitted rest of forces, over their absolute contributions
constexpr int    most     = 200;   ///< iterations

/// A body that touches nothing and has no inertia goes by its externalLoad to the first place that it meets.
template <int Dim> double wayToSoil(const FreeBody<Dim>& body, const std::vector<FreeContactPoint<Dim>>& contactPoints)
{
	Vec<Dim> externalLoad = body.externalLoad.template head<Dim>();
	for (int a = 0; a < Dim; ++a)
		if (body.isGiven[a]) externalLoad[a] = 0;
	if (externalLoad.isZero(0)) return 0;
	const Vec<Dim> along = externalLoad.normalized();
	double         least = std::numeric_limits<double>::infinity();
	for (const auto& contactPoint : contactPoints)
		if (const double speed = along.dot(contactPoint.normal); speed > 1e-3) least = std::min(least, contactPoint.gap / speed);
	return std::isfinite(least) ? least : 0;
}

} // namespace

Vec<2> turnsArm(const Vec<2>& arm) { return { -arm[1], arm[0] }; }
Mat3   turnsArm(const Vec3& a) { return (Mat3() << 0, a[2], -a[1], -a[2], 0, a[0], a[1], -a[0], 0).finished(); }

Mat<2> rotationOf(const Turn<2>& turn) { return Eigen::Rotation2Dd(turn[0]).toRotationMatrix(); }
Mat3   rotationOf(const Turn<3>& turn)
{
	const double angle = turn.norm();
	return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3(Mat3::Identity());
}

template <> FreeBody<2>::Matrix incrementsOf<2>(const FreeBody<2>::Vector&) { return FreeBody<2>::Matrix::Identity(); }
template <> FreeBody<3>::Matrix incrementsOf<3>(const FreeBody<3>::Vector& motion)
{
	FreeBody<3>::Matrix result = FreeBody<3>::Matrix::Identity();
	const Vec3          turn   = motion.tail<3>();
	const double        angle  = turn.norm();
	const Mat3          across = -turnsArm(turn); // its product with a vector is the cross product
	// The coefficients (1 - cos a) / a^2 and (a - sin a) / a^3, of small angles by their series.
	const double first  = angle < 1e-3 ? 0.5 - angle * angle / 24 : (1 - std::cos(angle)) / (angle * angle);
	const double second = angle < 1e-3 ? 1. / 6 - angle * angle / 120 : (angle - std::sin(angle)) / (angle * angle * angle);
	result.bottomRightCorner<3, 3>() += first * across + second * across * across;
	return result;
}

template <int Dim> RigidBodyJacobian<Dim>::RigidBodyJacobian(const FreeContactPoint<Dim>& contactPoint)
{
	constexpr int turns = Turn<Dim>::RowsAtCompileTime;
	moves << Mat<Dim>::Identity(), turnsArm(contactPoint.arm);
	turned.setZero(), byPosition.setZero(), byBody.setZero();
	turned.template rightCols<turns>()        = turnsArm(contactPoint.force);
	byPosition.template bottomRows<turns>()   = -turnsArm(contactPoint.force).transpose();
	byBody.template block<turns, Dim>(Dim, 0) = turnsArm(contactPoint.force).transpose();
}

template <int Dim> typename FreeBody<Dim>::Matrix compliance(const FreeBody<Dim>& body, double size, const std::vector<FreeContactPoint<Dim>>& contactPoints)
{
	using Free                       = FreeBody<Dim>;
	typename Free::Matrix K          = body.inertia;
	const auto            increments = incrementsOf<Dim>(body.motion);
	for (const auto& contactPoint : contactPoints)
		K += RigidBodyJacobian<Dim>(contactPoint).bodyByBody(contactPoint.tangent) * increments;
	typename Free::Vector scale = Free::Vector::Ones();
	scale.template tail<Turn<Dim>::RowsAtCompileTime>() /= size;
	for (int i = 0; i < Free::unknowns; ++i)
		if (body.isGiven[i]) scale[i] = 0;
	const typename Free::Matrix scaled  = scale.asDiagonal() * K * scale.asDiagonal();
	const typename Free::Matrix inverse = leastSquares(scaled, Free::Matrix::Identity());
	return scale.asDiagonal() * inverse * scale.asDiagonal();
}

namespace {

/// Search for the equilibrium of a free body, step by step.
template <int Dim> class Search {
public:
	using Vector = typename FreeBody<Dim>::Vector;
	using Look   = std::function<std::vector<FreeContactPoint<Dim>>(const Vector&)>;

	Search(FreeBody<Dim>& body, double size, const Look& look) : body_(body), size_(size), look_(look), at_(seenAt(body.motion)) { }

	bool          isDone() const { return at_.left <= balanced * at_.whole; }
	double        imbalance() const { return at_.whole > 0 ? at_.left / at_.whole : 0; }
	const Vector& motion() const { return at_.motion; }

	/// False: there is nowhere to go.
	bool next()
	{
		if (!at_.touches && body_.inertia.isZero(0)) return falls();
		if (!newton()) creep();
		return true;
	}

private:
	struct Seen {
		Vector                             motion, residual;
		std::vector<FreeContactPoint<Dim>> contactPoints;
		double                             left, whole; // sizes of the residual and of its absolute contributions
		bool                               touches = false;
	};
	Seen seenAt(const Vector& motion) const
	{
		const Vector inertial = body_.inertia * motion;
		Seen         seen { motion, inertial - body_.externalLoad, look_(motion), 0, 0 };
		Vector       absoluteContributions = inertial.cwiseAbs() + body_.externalLoad.cwiseAbs();
		for (const auto& contactPoint : seen.contactPoints) {
			const Vector force = RigidBodyJacobian<Dim>(contactPoint).moves.transpose() * contactPoint.force;
			seen.residual += force, absoluteContributions += force.cwiseAbs();
			seen.touches = seen.touches || contactPoint.gap <= 0;
		}
		for (int i = 0; i < FreeBody<Dim>::unknowns; ++i)
			if (body_.isGiven[i]) seen.residual[i] = 0;
		const auto sizeOf = [this](Vector x) { // moments as forces at the distance of its size
			x.template tail<Turn<Dim>::RowsAtCompileTime>() /= size_;
			return x.norm();
		};
		seen.left = sizeOf(seen.residual), seen.whole = sizeOf(absoluteContributions);
		return seen;
	}
	FreeBody<Dim> here() const
	{
		FreeBody<Dim> body = body_;
		body.motion        = at_.motion;
		return body;
	}
	bool falls()
	{
		const double way = wayToSoil(body_, at_.contactPoints);
		if (!(way > 0)) return false;
		Vector step               = Vector::Zero();
		step.template head<Dim>() = (way + 1e-6 * size_) * body_.externalLoad.template head<Dim>().normalized();
		for (int a = 0; a < Dim; ++a)
			if (body_.isGiven[a]) step[a] = 0;
		at_ = seenAt(at_.motion + step);
		return true;
	}
	/// Newton's step, or a part of it, where that lessens what is out of balance.
	bool newton()
	{
		const Vector step = -(compliance(here(), size_, at_.contactPoints) * at_.residual);
		double       part = 1;
		for (int halving = 0; halving < 8; ++halving, part /= 2) {
			Seen there = seenAt(at_.motion + part * step);
			if (!(there.left < (1 - 0.1 * part) * at_.left)) continue;
			at_ = std::move(there), drag_ = std::max(drag_ / 4, 1e-4);
			return true;
		}
		return false;
	}
	/// Replaces friction of slipping contact points by a spring with the secant stiffness of the present slip: a
	/// body that has been moved too far along itself comes back.
	static std::vector<FreeContactPoint<Dim>> withSecants(std::vector<FreeContactPoint<Dim>> contactPoints)
	{
		for (auto& contactPoint : contactPoints) {
			const Vec<Dim> n = contactPoint.normal, T = contactPoint.force - contactPoint.force.dot(n) * n;
			if (T.isZero(0) || contactPoint.tangent.isZero(0)) continue;
			const double across = -n.dot(contactPoint.tangent * n);
			double       along  = across / 20;
			if constexpr (Dim == 3) {
				const Vec3 beside = n.cross(T).normalized();
				along             = std::max(0., -beside.dot(contactPoint.tangent * beside));
			}
			contactPoint.tangent = -across * n * n.transpose() - along * (Mat<Dim>::Identity() - n * n.transpose());
		}
		return contactPoints;
	}
	/// Moves the body slowly, like in a thick liquid: one that tips over has to get to the next position that
	/// constrains it.
	void creep()
	{
		Vector resists = body_.inertia.diagonal();
		for (const auto& contactPoint : at_.contactPoints) {
			resists.template head<Dim>().array() += contactPoint.tangent.norm();
			resists.template tail<Turn<Dim>::RowsAtCompileTime>().array() += contactPoint.tangent.norm() * size_ * size_;
		}
		auto thick = here();
		thick.inertia += drag_ * Vector(resists).asDiagonal();
		Vector       step = -(compliance(thick, size_, withSecants(at_.contactPoints)) * at_.residual);
		const double way  = step.template head<Dim>().norm() + size_ * step.template tail<Turn<Dim>::RowsAtCompileTime>().norm();
		const double most = 0.02 * size_;
		if (way > most) step *= most / way;
		Seen       there    = seenAt(at_.motion + step);
		const bool isBetter = there.left < at_.left;
		drag_               = std::clamp(isBetter ? drag_ / 2 : 2 * drag_, 1e-4, 1.);
		at_                 = std::move(there);
	}

	FreeBody<Dim>& body_;
	double         size_, drag_ = 0.01;
	const Look&    look_;
	Seen           at_;
};

} // namespace

template <int Dim>
bool solveRigidBodyMotion(
        FreeBody<Dim>& body, double size, const std::function<std::vector<FreeContactPoint<Dim>>(const typename FreeBody<Dim>::Vector&)>& look)
{
	Search<Dim> search(body, size, look);
	for (int iteration = 0; iteration < most && !search.isDone() && search.next(); ++iteration) { }
	body.motion    = search.motion();
	body.imbalance = search.imbalance();
	body.isAtRest  = body.imbalance <= 1e3 * balanced;
	look(body.motion);
	return body.isAtRest;
}

template struct RigidBodyJacobian<2>;
template struct RigidBodyJacobian<3>;
template bool                solveRigidBodyMotion(FreeBody<2>&, double, const std::function<std::vector<FreeContactPoint<2>>(const FreeBody<2>::Vector&)>&);
template bool                solveRigidBodyMotion(FreeBody<3>&, double, const std::function<std::vector<FreeContactPoint<3>>(const FreeBody<3>::Vector&)>&);
template FreeBody<2>::Matrix compliance(const FreeBody<2>&, double, const std::vector<FreeContactPoint<2>>&);
template FreeBody<3>::Matrix compliance(const FreeBody<3>&, double, const std::vector<FreeContactPoint<3>>&);

} // namespace gimpm
