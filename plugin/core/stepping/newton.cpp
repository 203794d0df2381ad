// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/newton.hpp"
#include "core/stepping/local_balance.hpp"
#include "core/base/stopwatch.hpp"
#include <algorithm>
#include <sstream>

namespace gimpm {
namespace {

/// Out-of-balance forces on the free degrees of freedom, and what they are compared with.
struct Balance {
	Eigen::VectorXd residual;       // by number of the free degree of freedom
	double          size      = 0;  // |residual| [N]
	double          reference = 0;  // |external forces + reactions| [N]
	int             worst     = -1; // nodal degree of freedom
};

Balance balance(const FreeDofs& dofs, const Eigen::VectorXd& external, const Eigen::VectorXd& force)
{
	Balance b { Eigen::VectorXd(dofs.count) };
	// scaled, so that forces as small as 1e-200 N do not vanish when they are squared
	const double scale     = std::max({ external.lpNorm<Eigen::Infinity>(), force.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min() });
	double       imbalance = 0, reference = 0, largest = -1;
	for (int i = 0; i < int(dofs.number.size()); ++i) {
		const int n = dofs.number[i];
		if (n < 0) {
			reference += std::pow(force[i] / scale, 2); // external force + reaction = internal force
			continue;
		}
		const double r = b.residual[n] = external[i] - force[i];
		imbalance += std::pow(r / scale, 2);
		reference += std::pow(external[i] / scale, 2);
		if (std::abs(r) > largest) largest = std::abs(r), b.worst = i;
	}
	b.size      = scale * std::sqrt(imbalance);
	b.reference = scale * std::sqrt(reference);
	return b;
}

/// A full step may raise the residual by this much: points that begin to yield do so in steps that converge well.
constexpr double toleratedGrowth = 1.1;

/// A prediction may start from this many times the residual of zero: where only little load is added in a step, its residual may be the
/// larger one, and it is still much closer to the solution in what counts, which points yield. On the largest slope of the paper, starting
/// from the smaller residual takes 493 solves, this 387, and zero 752.
constexpr double toleratedStart = 2;

/// What the tolerance is multiplied by for the residual around a node over the forces there. Where the whole consists of one kind of soil its
/// norm shall decide: on the paper's largest slope the 160 steps then take 486 instead of 475 solves (with 1: 507), 286 instead of 284
/// factorisations; its scenes of h = 1 m, where every iteration is a full one, take none more.
constexpr double localTolerance = 3;

/// Full steps after one that raised the residual, which may be the way all the same, as in bending: the stretch that straight displacements
/// cause is gone after the next solve. They must bring the residual down quickly, at least to a half each time, until it is smaller than
/// before; else the iteration goes back and shortens the first one (the watchdog technique: Chamberlain et al. 1982).
class Detour {
public:
	Eigen::VectorXd from, step;
	double          before = 0, raised = 0; ///< residual before the first step and after it [N]

	void begin(const Eigen::VectorXd& d, const Eigen::VectorXd& firstStep, double residualBefore, double residual)
	{
		from = d, step = firstStep, before = residualBefore, raised = bound_ = residual, isOpen_ = true;
	}
	/// Whether the next full step, which ended with this residual, is taken.
	bool leadsOn(double residual)
	{
		bound_ /= 2;
		isOpen_ = residual >= before;
		return residual <= bound_;
	}
	void giveUp() { isOpen_ = false, wasVain_ = true; }
	bool isOpen() const { return isOpen_; }
	bool wasVain() const { return wasVain_; }

private:
	double bound_  = 0;
	bool   isOpen_ = false, wasVain_ = false;
};

/// State of the iteration.
template <int Dim> class Newton {
public:
	Newton(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report)
	        : system_(system)
	        , settings_(system.model.newton)
	        , solver_(solver)
	        , method_(system.model.newton.linearSolver)
	        , report_(report)
	        , localBalance_(system, K_)
	        , d_(Eigen::VectorXd::Zero(system.nodalSize()))
	{
		if (system.prescribed.any()) prescribed_ = system.prescribed;
		const Stopwatch watch(report.times.assembly);
		system.prepare(K_);
	}

	/// Starts from zero, or from the prediction (which may be empty) if that is not much further from equilibrium.
	Eigen::VectorXd run(const Eigen::VectorXd& prediction)
	{
		const bool predicts = prediction.size() > 0;
		evaluate(d_, !predicts);
		initial_  = std::max(balance_.size, balance_.reference);
		roundOff_ = roundOff();
		if (predicts) startFrom(prediction);
		while (!finished() && correct())
			++iterations_;
		report_.iterations += iterations_;
		reportReactions();
		return d_;
	}
	bool hasPredicted() const { return predicted_; }

private:
	/// Balance at d, and K on demand. An inverted point or a residual that is not a number leaves balance_.size infinite.
	void evaluate(const Eigen::VectorXd& d, bool withStiffness)
	{
		const Stopwatch watch(report_.times.assembly);
		inverted_     = system_.evaluate(d, force_, withStiffness ? &K_ : nullptr, withStiffness ? nullptr : &sizes_);
		hasStiffness_ = withStiffness;
		hasSizes_     = !withStiffness; // where no stiffness is needed the iteration is about to end
		balance_      = balance(system_.dofs, system_.external, force_);
		if (inverted_ >= 0 || !std::isfinite(balance_.size)) balance_.size = std::numeric_limits<double>::infinity();
	}

	/// Takes the prediction as the start unless its residual is much the larger one. Zero is given the prescribed displacements for that,
	/// without which its residual says nothing of them.
	void startFrom(Eigen::VectorXd prediction)
	{
		const Eigen::VectorXd held = system_.prescribed;
		if (prescribed_.size() > 0) evaluate(held, false);
		const double fromZero = balance_.size;
		for (int i = 0; i < prediction.size(); ++i)
			if (system_.dofs.number[i] < 0) prediction[i] = held[i];
		evaluate(prediction, true);
		predicted_ = balance_.size < toleratedStart * fromZero;
		if (!predicted_) return evaluate(d_, true);
		d_ = std::move(prediction);
		if (prescribed_.size() > 0) noteEntry();
		prescribed_.resize(0);
	}

	/// |residual| / |external forces + reactions|. Where both end at zero, the residual is compared with the forces at the start of the
	/// step, as in unloading, or with those that prescribed displacements cause at first, as in a rigid motion; and it is zero where it is
	/// round-off of stresses that balance each other.
	double relative() const
	{
		if (iterations_ > 0 && balance_.size <= roundOff_) return 0;
		const bool   vanish    = std::max(balance_.size, balance_.reference) <= settings_.tolerance * entering_;
		const double reference = std::max({ balance_.reference, initial_, vanish ? entering_ : 0 });
		return balance_.size == 0 ? 0 : balance_.size / reference;
	}

	/// Norm of the points' internal forces if each had an elastic strain of this size, strain(point) [N].
	template <class F> double elasticForce(F&& strain) const
	{
		const auto&     points = system_.points;
		Eigen::VectorXd force(points.volume0.size());
		for (int i = 0; i < int(force.size()); ++i)
			force[i] = points.volume0[i] * system_.model.materials[points.material[i]].young() * strain(i) / system_.model.grid.cellSize;
		return force.stableNorm();
	}

	/// Strain of a cell of which one side is held while the displacements prescribed in this step move the other.
	double prescribedStrain() const { return system_.prescribed.template lpNorm<Eigen::Infinity>() / system_.model.grid.cellSize; }

	/// Of the internal forces, from the stresses at the start of the step and the displacements prescribed in it [N].
	double roundOff() const
	{
		const double entering = prescribedStrain();
		return 10 * std::numeric_limits<double>::epsilon() * elasticForce([&](int i) { return system_.points.leftCauchyGreen[i].c.norm() + entering; });
	}

	/// Takes note of the forces with which prescribed displacements enter: no more than they can cause by themselves, for points that other
	/// loads have nearly turned inside out resist with any force.
	void noteEntry()
	{
		const double strain = prescribedStrain();
		entering_           = std::min(std::max(balance_.size, balance_.reference), elasticForce([&](int) { return strain; }));
	}

	/// Largest residual around a node over the forces there.
	double localResidual()
	{
		const Stopwatch watch(report_.times.assembly);
		if (!hasSizes_) {
			Eigen::VectorXd force;
			system_.evaluate(d_, force, nullptr, &sizes_);
			hasSizes_ = true;
		}
		return localBalance_.ratio(balance_.residual, sizes_, d_, localTolerance * settings_.tolerance);
	}

	/// How far the iteration is from its end: converged at 1. Parts of the body are looked at when the whole is in balance.
	double excess()
	{
		const double ofWhole = relative() / settings_.tolerance;
		isWholeInBalance_    = ofWhole <= 1;
		if (!isWholeInBalance_) return ofWhole;
		report_.localResidual = localResidual();
		return std::max(ofWhole, report_.localResidual / (localTolerance * settings_.tolerance));
	}

	/// Whether the iteration has come down to round-off, above the tolerance: for some iterations it has not halved what was left.
	bool stalls() const
	{
		constexpr int many = 4;
		const int     n    = int(excess_.size()) - many;
		if (n < 1) return false;
		const double motion = d_.template lpNorm<Eigen::Infinity>() / system_.model.grid.cellSize, precision = 10 * std::numeric_limits<double>::epsilon();
		const double noise  = precision * elasticForce([&](int i) { return system_.points.leftCauchyGreen[i].c.norm() + motion; });
		return balance_.size <= noise && *std::min_element(excess_.begin() + n, excess_.end()) > 0.5 * *std::min_element(excess_.begin(), excess_.begin() + n);
	}

	bool finished()
	{
		const double residual = relative();
		report_.residuals.push_back(residual);
		reportWorst();
		// At least one solve: a load increment below the tolerance must not be lost.
		excess_.push_back(iterations_ > 0 ? excess() : residual / settings_.tolerance);
		const bool converged = iterations_ > 0 ? excess_.back() <= 1 : residual == 0 && prescribed_.size() == 0;
		std::ostringstream text;
		if (inverted_ >= 0) {
			report_.invertedPoint = inverted_;
			return fail(Failure::inverted, "a material point was turned inside out (det F <= 0)");
		}
		if (!std::isfinite(residual)) return fail(Failure::notFinite, "the residual is not finite");
		if (converged) return true;
		if (settings_.interrupted && settings_.interrupted()) return fail(Failure::interrupted, "it was interrupted");
		if (stalls()) {
			const double attained = *std::min_element(excess_.begin(), excess_.end()) * settings_.tolerance;
			text << "the residual stays at " << residual << ", which is round-off here, above the tolerance " << settings_.tolerance
			     << "; what can be attained is a tolerance of about " << std::pow(10, std::ceil(std::log10(2 * attained)));
			return fail(Failure::stalled, text.str());
		}
		if (iterations_ == settings_.maxIterations) return fail(Failure::tooManyIterations, causeOfTooMany());
		return false;
	}

	std::string causeOfTooMany() const
	{
		std::ostringstream text;
		text << "the residual " << report_.residuals.back();
		if (!isWholeInBalance_) text << " is above the tolerance " << settings_.tolerance;
		else
			text << " of the whole is small, but around a node it is still " << report_.localResidual << " of the forces there, more than " << localTolerance
			     << " times the tolerance " << settings_.tolerance << ",";
		text << " after " << iterations_ << " iterations";
		return text.str();
	}

	bool fail(Failure failure, const std::string& cause)
	{
		report_.failure = failure;
		report_.cause   = cause;
		return true;
	}

	/// One solve and the step that it gives. False if the iteration has to end.
	bool correct()
	{
		if (isReusable() && reuse()) return true;
		if (!hasStiffness_) evaluate(d_, true);
		// Prescribed displacements enter in full: the residual before says nothing of them, and a shorter step would lose a part.
		const bool      prescribes = prescribed_.size() > 0;
		const double    before     = balance_.size;
		Eigen::VectorXd step       = Eigen::VectorXd::Zero(d_.size());
		if (!solve(step)) {
			if (detour_.isOpen()) return goBack();
			fail(Failure::singular, "the stiffness matrix is singular to working precision");
			return false;
		}
		evaluate(d_ + step, !isStiffnessSuperfluous());
		if (staysInBalance()) {
			// the whole had converged before, and the step is for a part of it: what is left of the whole says nothing of that
		} else if (predicted_ && !(balance_.size < before)) {
			fail(Failure::diverging, "the prediction leads nowhere"); // and zero is tried
			return false;
		} else if (detour_.isOpen()) {
			if (!detour_.leadsOn(balance_.size)) return goBack();
		} else if (!prescribes && !(balance_.size < toleratedGrowth * before)) {
			if (!mayTakeDetour()) return search(d_, step, before, balance_.size);
			detour_.begin(d_, step, before, balance_.size);
		}
		if (prescribes) noteEntry();
		d_ += step;
		return true;
	}
	/// Whether the whole was in balance before this step and is so after it.
	bool staysInBalance() const { return isWholeInBalance_ && relative() <= settings_.tolerance; }

	/// One in vain is enough for a load step.
	bool mayTakeDetour() const
	{
		return settings_.lineSearchTrials > 0 && !detour_.wasVain() && std::isfinite(balance_.size) && iterations_ + 1 < settings_.maxIterations;
	}
	bool goBack()
	{
		detour_.giveUp();
		return search(detour_.from, detour_.step, detour_.before, detour_.raised);
	}

	/// step = K^-1 (residual - K_fc prescribed), with the prescribed displacements themselves.
	bool solve(Eigen::VectorXd& step)
	{
		Eigen::VectorXd right = balance_.residual, correction;
		if (prescribed_.size() > 0) {
			Eigen::VectorXd held = Eigen::VectorXd::Zero(d_.size());
			K_.multiplyAdd(prescribed_, held);
			for (int i = 0; i < held.size(); ++i)
				if (system_.dofs.number[i] >= 0) right[system_.dofs.number[i]] -= held[i];
			step = prescribed_;
			prescribed_.resize(0);
		}
		if (system_.dofs.count == 0) return true;
		SymmetricCsc reduced;
		{
			const Stopwatch watch(report_.times.assembly);
			reduce(K_, system_.dofs, reduced);
		}
		const auto status = solver_.solve(reduced, right, correction, method_, forcing());
		factored_         = status == LinearSolver::Status::cholesky;
		report_.definiteness = factored_ ? Definiteness::positive : status == LinearSolver::Status::iterative ? report_.definiteness : Definiteness::indefinite;
		if (status != LinearSolver::Status::iterative) method_ = LinearMethod::direct; // what they could not solve once stays difficult
		if (status == LinearSolver::Status::singular) return false;
		report_.luSolves += status == LinearSolver::Status::lu;
		addTo(step, correction);
		return true;
	}

	void addTo(Eigen::VectorXd& step, const Eigen::VectorXd& correction) const
	{
		for (int i = 0; i < step.size(); ++i)
			if (system_.dofs.number[i] >= 0) step[i] += correction[system_.dofs.number[i]];
	}

	/// One step of the modified Newton method, with the last factor. Nothing is changed unless it reduces the residual.
	bool reuse()
	{
		Eigen::VectorXd correction, step = Eigen::VectorXd::Zero(d_.size());
		const double    before = balance_.size;
		if (!solver_.solveAgain(balance_.residual, correction)) return false;
		addTo(step, correction);
		evaluate(d_ + step, false);
		if (!(staysInBalance() ? hasImprovedLocally(d_ + step) : balance_.size < before)) {
			factored_ = false;
			evaluate(d_, true);
			return false;
		}
		++report_.reusedFactors;
		d_ += step;
		return true;
	}

	/// Of the displacements of the last evaluation, against those of the iteration before.
	bool hasImprovedLocally(const Eigen::VectorXd& d)
	{
		return localBalance_.ratio(balance_.residual, sizes_, d, localTolerance * settings_.tolerance) < report_.localResidual;
	}

	/// Part of the residual that an iterative solver may leave (inexact Newton): in proportion to the residual, which keeps the convergence
	/// quadratic, but no less than the step needs in the end; and just that if this solve is foretold to be the last one.
	double forcing() const
	{
		constexpr double first = 1e-3, share = 0.1, attainable = 1e-13;
		const double     residual = report_.residuals.back();
		const double     enough   = excess_.back() > 0 ? share / excess_.back() : first;
		const double     wanted   = willConverge() ? enough : std::max(share * residual, enough);
		return std::max(attainable, std::min(first, wanted));
	}

	/// By how much the last iteration reduced the residual; 1 if it did not.
	double reduction() const
	{
		const auto& r = report_.residuals;
		return r.size() < 2 ? 1 : std::min(1., r.back() / r[r.size() - 2]);
	}

	/// The excess that quadratic convergence foretells for the next iteration.
	double foretold() const { return excess_.back() * std::pow(reduction(), 2); }
	bool   willConverge() const { return foretold() <= 1; }

	/// With the last factor, the error of K is that of the iteration before: it reduces the residual about as much again.
	bool sufficesForLast(double excess, double reduction) const { return settings_.reuseFactor && excess * reduction <= 1; }
	bool isReusable() const { return factored_ && !detour_.isOpen() && sufficesForLast(excess_.back(), reduction()); }

	/// No further stiffness will be needed after this solve.
	bool isStiffnessSuperfluous() const { return willConverge() || (factored_ && sufficesForLast(foretold(), std::pow(reduction(), 2))); }

	/// A full step from d raised the residual to `full`: tries shorter ones (Armijo's condition) and takes the best.
	bool search(const Eigen::VectorXd& d, const Eigen::VectorXd& step, double before, double full)
	{
		double best = full, length = 1, share = 1;
		for (int trial = 0; trial < settings_.lineSearchTrials; ++trial) {
			share /= 2;
			evaluate(d + share * step, false);
			++report_.lineSearchTrials;
			if (balance_.size < best) best = balance_.size, length = share;
			if (balance_.size <= (1 - 1e-4 * share) * before) break;
		}
		const double largest = step.template lpNorm<Eigen::Infinity>();
		if (settings_.lineSearchTrials > 0 && best >= before && length * largest > system_.model.grid.cellSize) {
			std::ostringstream text;
			text << "it diverges: a correction of " << length * largest << " m, more than a cell, does not reduce the residual";
			report_.residuals.push_back(relative());
			fail(Failure::diverging, text.str());
			return false;
		}
		d_ = d + length * step;
		evaluate(d_, true);
		return true;
	}

	void reportWorst()
	{
		if (balance_.worst < 0) return;
		report_.worst.position.setZero();
		report_.worst.position.head<Dim>() = system_.model.grid.nodePosition(Grid<Dim>::index(system_.basis.nodes[balance_.worst / Dim]));
		report_.worst.axis                 = balance_.worst % Dim;
		report_.worst.force                = balance_.residual[system_.dofs.number[balance_.worst]];
	}

	/// The last evaluation was at d.
	void reportReactions()
	{
		const auto& boundary = system_.model.boundary;
		report_.reactions.assign(boundary.boxes().size(), Vec3::Zero());
		for (int i = 0; i < force_.size(); ++i) {
			if (system_.dofs.number[i] >= 0) continue;
			const auto* box = boundary.holder(Grid<Dim>::index(system_.basis.nodes[i / Dim]), i % Dim);
			report_.reactions[box - boundary.boxes().data()][i % Dim] += force_[i] - system_.external[i];
		}
	}

	const StepSystem<Dim>& system_;
	const NewtonSettings&  settings_;
	LinearSolver&          solver_;
	LinearMethod           method_;
	StepReport&            report_;
	NodeMatrix<Dim>        K_;
	LocalBalance<Dim>      localBalance_;
	Eigen::VectorXd        d_, force_, sizes_, prescribed_; // prescribed_: empty once it is part of d
	std::vector<double>    excess_;                         // before the first solve and after each
	Balance                balance_;
	Detour                 detour_;
	InvertedPoint          inverted_     = -1;
	bool                   hasStiffness_ = false, hasSizes_ = false, predicted_ = false, isWholeInBalance_ = false;
	bool                   factored_     = false; // the solver holds a Cholesky factor of this step
	int                    iterations_   = 0;
	double                 initial_      = 0; // |residual| or |external forces + reactions| at the start of the step [N]
	double                 entering_     = 0; // the same where prescribed displacements entered, after the first solve or with the prediction [N]
	double                 roundOff_     = 0; // [N]
};

} // namespace

template <int Dim>
Eigen::VectorXd equilibrium(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction)
{
	if (prediction.size() > 0) {
		StepReport      attempt = report;
		Newton<Dim>     newton(system, solver, attempt);
		Eigen::VectorXd d = newton.run(prediction);
		if (attempt.converged() || attempt.failure == Failure::interrupted || !newton.hasPredicted()) {
			attempt.predicted = newton.hasPredicted();
			report            = std::move(attempt);
			return d;
		}
		report.takeEffort(attempt);
	}
	return Newton<Dim>(system, solver, report).run({});
}

template Eigen::VectorXd equilibrium(const StepSystem<2>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);
template Eigen::VectorXd equilibrium(const StepSystem<3>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);

} // namespace gimpm
