// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/water/water.hpp"
#include "core/terms/points/internal_force.hpp"
#include <Eigen/LU>
#include <atomic>
#include <limits>

namespace gimpm {
namespace {

/// A point with displacements d of its nodes.
template <int Dim> struct MovedPoint {
	const Patch<Dim>& patch;
	int               count = 1; // number of nodes
	double            value[windowNodes<Dim>];
	Vec<Dim>          shapeGradient[windowNodes<Dim>]; // gradient where it is now, in the section of a ring
	double            hoop[windowNodes<Dim>];          // dilation of the ring by its radial displacement
	int               code[windowNodes<Dim>];          // code of the position in the patch, as offset
	Vec<Dim>          displacement = Vec<Dim>::Zero();
	double            J            = 1; // current volume over that at the start of the step

	MovedPoint(const CloudBasis<Dim>& basis, const Patch<Dim>& of, int p, const Eigen::VectorXd& d) : patch(of)
	{
		const Mat<Dim> G       = Mat<Dim>::Identity() + unmoved(basis, p, d);
		const double   around  = 1 + stretchAround_;
		J                      = G.determinant() * around;
		const Mat<Dim> inverse = G.inverse().transpose();
		for (int n = 0; n < count; ++n)
			shapeGradient[n] = (inverse * shapeGradient[n]).eval(), hoop[n] /= around;
	}
	/// Derivative of the volume, over the volume, by the displacement of node n.
	Vec<Dim> dilation(int n) const
	{
		Vec<Dim> w = shapeGradient[n];
		w[0] += hoop[n];
		return w;
	}
	bool isThere(int n) const { return patch.node[n] >= 0; }

private:
	/// Functions as the step begins; returns the gradient of d.
	Mat<Dim> unmoved(const CloudBasis<Dim>& basis, int p, const Eigen::VectorXd& d)
	{
		for (int a = 0; a < Dim; ++a)
			count *= patch.nodesAlong(a);
		Mat<Dim> gradient = Mat<Dim>::Zero();
		for (int n = 0; n < count; ++n) {
			std::array<int, 3> along {};
			value[n] = 1, shapeGradient[n].setOnes();
			for (int a = 0, rest = n; a < Dim; rest /= patch.nodesAlong(a), ++a) {
				along[a]         = rest % patch.nodesAlong(a);
				const auto& axis = basis.axes[p][a];
				value[n] *= axis.value[along[a]];
				for (int b = 0; b < Dim; ++b)
					shapeGradient[n][b] *= (a == b ? axis.gradient : axis.value)[along[a]];
			}
			code[n] = NodeMatrix<Dim>::code(along);
			hoop[n] = basis.isAxisymmetric() ? basis.hoop[p][along[0]] * basis.axes[p][1].value[along[1]] : 0;
			if (!isThere(n)) continue;
			const Vec<Dim> u = d.template segment<Dim>(Dim * patch.node[n]);
			displacement += value[n] * u;
			gradient += u * shapeGradient[n].transpose();
			stretchAround_ += hoop[n] * u[0];
		}
		return gradient;
	}
	double stretchAround_ = 0;
};

/// Calls f(position in the basis, moved point) for all points, no two of which share a node at a time.
template <int Dim, class F> void forMovedPoints(const CloudBasis<Dim>& basis, const Eigen::VectorXd& d, F&& f)
{
	for (const auto& colour : basis.colours) {
#pragma omp parallel for schedule(dynamic)
		for (std::size_t range = 0; range < colour.size(); ++range)
			for (int i = colour[range].first; i < colour[range].second; ++i)
				for (int p = basis.patches[i].first, end = p + basis.patches[i].count; p < end; ++p)
					f(p, MovedPoint<Dim>(basis, basis.patches[i], p, d));
	}
}

/// Pressure, volumes and what acts, of one point. The parts: `weighs` of the gradient with S, `presses` of the pressure
/// with grad S.
template <int Dim> struct WetPoint {
	const MovedPoint<Dim>&     at;
	const PressureAround<Dim>& p;
	double                     weighs, presses;  // volumes [m3]
	const double*              beyond = nullptr; // gain of the pressure from the node to its image that is near the point [Pa]; null: nothing

	WetPoint(const MovedPoint<Dim>& moved, const PressureAround<Dim>& around, WaterDomain domain, double volume0, double volume)
	        : at(moved)
	        , p(around)
	        , weighs(domain == WaterDomain::everywhere        ? volume0
	                         : domain == WaterDomain::outside ? volume
	                                                          : 0)
	        , presses(domain == WaterDomain::everywhere        ? 0
	                          : domain == WaterDomain::outside ? volume
	                                                           : -volume)
	        , follows_(domain == WaterDomain::outside)
	{
	}
	/// Resisting force.
	Vec<Dim> force(int n) const { return weighs * at.value[n] * p.gradient + presses * valueFor(n) * at.dilation(n); }

	Mat<Dim> stiffness(int n, int m) const
	{
		const Vec<Dim> wn = at.dilation(n), wm = at.dilation(m);
		Mat<Dim>       K = weighs * at.value[n] * at.value[m] * p.hessian;
		if (follows_) K += weighs * at.value[n] * p.gradient * wm.transpose();
		if (presses == 0) return K;
		Mat<Dim> turn = wn * wm.transpose() - at.shapeGradient[m] * at.shapeGradient[n].transpose();
		turn(0, 0) -= at.hoop[n] * at.hoop[m];
		return K + presses * (valueFor(n) * turn + at.value[m] * wn * p.gradient.transpose());
	}
	bool isDry() const { return p.value == 0 && p.gradient.isZero(0) && !beyond; }
	bool isStiff() const { return presses != 0 || !p.hessian.isZero(0); }

private:
	double valueFor(int n) const { return beyond ? p.value - beyond[n] : p.value; }
	bool   follows_;
};

template <int Dim> void addTo(const AssembledTerms<Dim>& sum, const WetPoint<Dim>& wet, double factor)
{
	const auto& at = wet.at;
	for (int n = 0; n < at.count; ++n) {
		if (!at.isThere(n)) continue;
		const Vec<Dim> f = factor * wet.force(n);
		sum.force.template segment<Dim>(Dim * at.patch.node[n]) += f;
		if (sum.absoluteContributions) sum.absoluteContributions->template segment<Dim>(Dim * at.patch.node[n]) += f.cwiseAbs();
		for (int m = 0; m < at.count && sum.K && wet.isStiff(); ++m)
			if (at.isThere(m)) sum.K->add(at.patch.node[n], at.patch.node[m], at.code[m] - at.code[n], factor * wet.stiffness(n, m));
	}
}

/// Gain of pressure from a node of the periodic grid to its image near a position: all of a node's forces come from one
/// side of the period.
template <int Dim>
std::array<double, windowNodes<Dim>> gainBeyond(
        const MovedPoint<Dim>& moved, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const Vec<Dim>& domain, const Vec<Dim>& fall)
{
	std::array<double, windowNodes<Dim>> gain {};
	for (int n = 0; n < moved.count; ++n) {
		if (!moved.isThere(n)) continue;
		const Vec<Dim> node = grid.nodePosition(Grid<Dim>::index(basis.nodes[moved.patch.node[n]]));
		for (int a = 0; a < Dim; ++a)
			if (fall[a] != 0) gain[n] += fall[a] * std::round((domain[a] - node[a]) / (grid.cellSize * grid.period[a]));
	}
	return gain;
}

} // namespace

template <int Dim>
WaterForce<Dim>::WaterForce(Water<Dim>& water, const StepContext<Dim>& step)
        : water_(water), basis_(step.basis), grid_(step.grid), dofs_(step.dofs), ownedNodes_(step.ownedNodes)
{
	for (const int p : basis_.order) {
		const double    volume0 = water.shares.empty() ? step.cloud.volume0[p] : water.shares[step.cloud.material[p]] * step.cloud.volume0[p];
		const Vec<Dim>& x       = step.cloud.position[p];
		start_.push_back({ x, step.cloud.halfSize[p], volume0, volume0 * step.cloud.volumeRatio(p), water.sideOf ? water.sideOf(x) : 0 });
	}
}

template <int Dim> const WaterPressure<Dim>& WaterForce<Dim>::pressureFor(const Start& start, When when) const
{
	const auto& beside = when == When::before ? water_.besideBefore : water_.beside;
	if (start.side > 0 && beside[start.side - 1]) return *beside[start.side - 1];
	return when == When::before ? *water_.before : *water_.pressure;
}

/// Calls f(position in the basis, wet point) for all points at d. Returns the first point that has left the known
/// positions or has turned inside out; the others are done.
template <int Dim>
template <class F>
std::optional<PointFailure> WaterForce<Dim>::forWetPoints(When when, WaterDomain domain, const Eigen::VectorXd& d, F&& f) const
{
	std::atomic_int failed { std::numeric_limits<int>::max() };
	const Vec<Dim>  fall  = (when == When::before ? water_.before : water_.pressure)->fall();
	const bool      falls = !fall.isZero(0);
	forMovedPoints(basis_, d, [&](int i, const MovedPoint<Dim>& moved) {
		const Start& start   = start_[i];
		const bool   isWhole = moved.J > 0 && std::isfinite(moved.J);
		const auto   around  = isWhole ? pressureFor(start, when).around(start.position + moved.displacement, start.halfSize) : std::nullopt;
		if (around) {
			WetPoint<Dim> wet(moved, *around, domain, start.volume0, start.volume * moved.J);
			if (!falls) return f(i, wet);
			const auto gain = gainBeyond(moved, basis_, grid_, start.position, fall);
			wet.beyond      = gain.data();
			return f(i, wet);
		}
		const int p = basis_.order[i];
		for (int known = failed; p < known && !failed.compare_exchange_weak(known, p);) { }
	});
	if (failed == std::numeric_limits<int>::max()) return std::nullopt;
	return PointFailure { failed };
}

template <int Dim> void WaterForce<Dim>::mark(NodeMatrix<Dim>& K) const { markPointPattern(basis_, K); }

template <int Dim> std::optional<PointFailure> WaterForce<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	return forWetPoints(When::now, water_.domain, d, [&](int, const WetPoint<Dim>& wet) {
		if (!wet.isDry()) addTo(sum, wet, water_.factor);
	});
}

template <int Dim> void WaterForce<Dim>::addBefore(Eigen::VectorXd& force)
{
	forWetPoints(When::before, water_.domain, Eigen::VectorXd::Zero(force.size()), [&](int, const WetPoint<Dim>& wet) {
		if (!wet.isDry()) addTo<Dim>({ force }, wet, water_.factorBefore);
	});
}

template <int Dim> double WaterForce<Dim>::fromOutside(const Eigen::VectorXd& d)
{
	Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
	add(d, { force });
	ownedNodes_.complete(force);
	return force.norm();
}

template <int Dim> void WaterForce<Dim>::commit(const Eigen::VectorXd& d)
{
	const bool      wets = water_.domain != WaterDomain::outside, fillsWalls = water_.domain != WaterDomain::pores;
	Eigen::VectorXd onWalls = Eigen::VectorXd::Zero(d.size());
	if (water_.wantsWork) {
		Eigen::VectorXd twice = onWalls;
		addBefore(twice);
		add(d, { twice });
		ownedNodes_.complete(twice);
		water_.work = -twice.dot(d) / 2;
	}
	water_.porePressure.assign(start_.size(), 0);
	forWetPoints(When::now, WaterDomain::outside, d, [&](int i, const WetPoint<Dim>& wet) {
		if (wets) water_.porePressure[basis_.order[i]] = water_.factor * wet.p.value;
		if (fillsWalls && !wet.isDry()) addTo<Dim>({ onWalls }, wet, -water_.factor);
	});
	ownedNodes_.complete(onWalls);
	basis_.affineConstraints.template condense<Dim>(onWalls);
	water_.onWalls.clear();
	for (std::size_t n = 0; n < basis_.nodes.size() && fillsWalls; ++n) {
		Vec<Dim> force = Vec<Dim>::Zero();
		for (int a = 0; a < Dim; ++a)
			if (dofs_.number[Dim * n + a] < 0) force[a] = onWalls[Dim * n + a];
		if (!force.isZero(0)) water_.onWalls.emplace_back(basis_.nodes[n], force);
	}
}

template class WaterForce<2>;
template class WaterForce<3>;

} // namespace gimpm
