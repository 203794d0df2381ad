// SPDX-License-Identifier: GPL-2.0-or-later
// A second field at the nodes, solved for together with displacements: pressure in pores, or temperature.
#pragma once
#include "core/grid/point_nodes.hpp"
#include "core/stepping/load_step.hpp"
#include "scenes.hpp"

namespace gimpm::seepage {

/// Field that flows through the soil, and its effect on the soil.
struct Medium {
	/// Flow by the gradient of the pressure, times the duration of the step.
	double conductivity = 1;
	double growth       = 0;    ///< growth of the conductivity, by the pressure [1/Pa]
	double push         = 0;    ///< stress by the pressure: 1 in pores, Young's modulus times expansion for a temperature
	double storage      = 0;    ///< term of the balance by the volume of the soil: 1 in pores, 0 for a temperature
	double sign         = 1;    ///< sign of the balance; -1 makes the matrix of pores symmetric
	double ghost        = 0.01; ///< penalty on jumps of the gradient, over the conductivity
};

/// Points and their nodes with values and gradients of the functions, along the axes as the step begins.
template <int Dim, class F> void forGradients(const CloudBasis<Dim>& basis, F&& f)
{
	forPointNodes(basis, 0, int(basis.patches.size()), [&](int p, const Patch<Dim>& patch, const double* value, int count) {
		Vec<Dim> gradient[windowNodes<Dim>];
		for (int n = 0; n < count; ++n)
			for (int i = 0; i < Dim; ++i) {
				gradient[n][i] = 1;
				for (int a = 0, rest = n; a < Dim; rest /= patch.nodesAlong(a), ++a) {
					const auto& axis = basis.axes[p][a];
					gradient[n][i] *= (a == i ? axis.gradient : axis.value)[rest % patch.nodesAlong(a)];
				}
			}
		f(basis.order[p], patch, value, gradient, count);
	});
}

/// Balance of what flows, its work on the soil, and a ghost penalty. The flow is that through the soil as the
/// step begins.
template <int Dim> class Flow : public CoupledTerm<Dim> {
public:
	static constexpr int field = 1;

	Flow(const Medium& medium, const StepContext<Dim>& step) : medium_(medium), basis_(step.basis), h_(step.grid.cellSize), faces_(step.faces)
	{
		for (std::size_t p = 0; p < step.cloud.size(); ++p)
			volume_.push_back(step.cloud.volume0[p] * step.cloud.volumeRatio(p));
		for (auto& face : faces_)
			face.stiffness = medium.sign * medium.ghost * medium.conductivity * h_ / 3;
	}
	bool isSymmetric() const override { return medium_.growth == 0 && medium_.push == -medium_.sign * medium_.storage; }

	void mark(NodeMatrix<Dim>& K) const override
	{
		for (const auto& patch : basis_.patches)
			forPairs(patch, [&](int a, int, int, int, int code) {
				if (code >= 0) K.markUsed(patch.node[a], code);
			});
	}
	void markCouplings(Couplings& K) const override
	{
		for (const auto& patch : basis_.patches)
			forPairs(patch, [&](int, int, int a, int b, int) {
				K.mark({ field, a }, { field, b });
				K.mark({ 0, a }, { field, b });
			});
		forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int, double) { K.mark({ field, a }, { field, b }); });
	}
	std::optional<PointFailure> addCoupled(const State& state, const FieldSum<Dim>& sum) const override
	{
		const Eigen::VectorXd& d = state.displacements();
		const Eigen::VectorXd  P = state.value(field);
		forGradients(basis_, [&](int point, const Patch<Dim>& patch, const double* S, const Vec<Dim>* G, int count) {
			PointState s(volume_[point]);
			for (int n = 0; n < count; ++n) {
				const int a = patch.node[n];
				if (a < 0) continue;
				s.F += d.template segment<Dim>(Dim * a) * G[n].transpose();
				s.pressure += S[n] * P[a], s.pressureGradient += P[a] * G[n];
			}
			s.finish();
			addForces(s, patch, S, G, count, sum);
			if (sum.K) addStiffness(s, patch, S, G, sum);
		});
		addGhost(P, sum);
		return std::nullopt;
	}
	void addCoupledRoundOff(const State& state, std::vector<Eigen::VectorXd>& absoluteContributions) const override
	{
		constexpr double      roundOff = 10 * precision;
		const Eigen::VectorXd P        = state.value(field);
		forGradients(basis_, [&](int point, const Patch<Dim>& patch, const double*, const Vec<Dim>* G, int count) {
			double slope = 0;
			for (int n = 0; n < count; ++n)
				if (patch.node[n] >= 0) slope += G[n].norm() * std::abs(P[patch.node[n]]);
			for (int n = 0; n < count; ++n)
				if (patch.node[n] >= 0)
					absoluteContributions[field][patch.node[n]] += roundOff * medium_.conductivity * volume_[point] * slope * G[n].norm();
		});
	}

private:
	struct PointState {
		double   volume, pressure = 0, J = 1;
		Vec<Dim> pressureGradient = Vec<Dim>::Zero();
		Mat<Dim> F                = Mat<Dim>::Identity(), inverse; // deformation in the step
		explicit PointState(double volume) : volume(volume) { }
		void     finish() { J = F.determinant(), inverse = F.inverse(); }
		Vec<Dim> now(const Vec<Dim>& gradient) const { return inverse.transpose() * gradient; }
	};

	void addForces(const PointState& s, const Patch<Dim>& patch, const double* S, const Vec<Dim>* G, int count, const FieldSum<Dim>& sum) const
	{
		const double conductivity = medium_.conductivity * (1 + medium_.growth * s.pressure);
		for (int n = 0; n < count; ++n) {
			const int a = patch.node[n];
			if (a < 0) continue;
			const Vec<Dim> push   = -medium_.push * s.pressure * s.volume * s.J * s.now(G[n]);
			const double   flow   = medium_.sign * conductivity * s.volume * s.pressureGradient.dot(G[n]);
			const double   stored = medium_.sign * medium_.storage * s.volume * (s.J - 1) * S[n];
			sum.force[0].template segment<Dim>(Dim * a) += push;
			sum.absoluteContributions[0].template segment<Dim>(Dim * a) += push.cwiseAbs();
			sum.force[field][a] += flow + stored;
			sum.absoluteContributions[field][a] += std::abs(flow) + std::abs(stored);
		}
	}
	void addStiffness(const PointState& s, const Patch<Dim>& patch, const double* S, const Vec<Dim>* G, const FieldSum<Dim>& sum) const
	{
		const double conductivity = medium_.conductivity * (1 + medium_.growth * s.pressure), growth = medium_.conductivity * medium_.growth;
		forPairs(patch, [&](int m, int n, int a, int b, int code) {
			const Vec<Dim> ga = s.now(G[m]), gb = s.now(G[n]);
			const Mat<Dim> work = -medium_.push * s.pressure * s.volume * s.J * (ga * gb.transpose() - gb * ga.transpose());
			sum.K->add(a, b, code, work);
			const Vec<Dim> push   = -medium_.push * s.volume * s.J * S[n] * ga;
			const Vec<Dim> stored = medium_.sign * medium_.storage * s.volume * s.J * S[m] * gb;
			sum.couplings->add({ 0, a }, { field, b }, push);
			sum.couplings->add({ field, a }, { 0, b }, stored.transpose());
			sum.couplings->add(
			        { field, a }, { field, b }, medium_.sign * s.volume * (conductivity * G[n] + growth * S[n] * s.pressureGradient).dot(G[m]));
		});
	}
	void addGhost(const Eigen::VectorXd& P, const FieldSum<Dim>& sum) const
	{
		forGhostPairs<Dim>(faces_, h_, [&](int a, int b, int, double k) {
			for (const auto& [row, column] : { std::pair(a, b), std::pair(b, a) }) {
				sum.force[field][row] += k * P[column];
				if (sum.couplings) sum.couplings->add({ field, row }, { field, column }, k);
				if (a == b) break;
			}
		});
	}
	/// Calls f(local node, local node, node, node, code of the offset between them).
	template <class F> static void forPairs(const Patch<Dim>& patch, F&& f)
	{
		int count = 1;
		for (int a = 0; a < Dim; ++a)
			count *= patch.nodesAlong(a);
		for (int m = 0; m < count; ++m)
			for (int n = 0; n < count; ++n) {
				Index<Dim> offset;
				for (int a = 0, i = m, j = n; a < Dim; i /= patch.nodesAlong(a), j /= patch.nodesAlong(a), ++a)
					offset[a] = j % patch.nodesAlong(a) - i % patch.nodesAlong(a);
				if (patch.node[m] >= 0 && patch.node[n] >= 0) f(m, n, patch.node[m], patch.node[n], NodeMatrix<Dim>::code(offset));
			}
	}

	const Medium&               medium_;
	const CloudBasis<Dim>&      basis_;
	double                      h_;
	std::vector<GhostFace<Dim>> faces_;
	std::vector<double>         volume_;
};

/// A body of four cells by two on rollers, with a layer on top that fills so much of its cells. The pressure is
/// given at both ends.
template <int Dim> struct Body {
	static constexpr double h = 0.5, length = 4 * h, young = 1e6;
	Model<Dim>              model;
	PointCloud<Dim>         cloud;
	LinearSolver            solver;
	Medium                  medium;
	double                  before = 0, ends[2] = { 3e3, 7e3 };
	std::vector<Vec<Dim>>   nodes; // nodes of the last step that was accepted
	Eigen::VectorXd         value, flow;

	explicit Body(double cut, const std::vector<ConstrainedBox<Dim>>& more = {})
	{
		model.grid.cellSize    = h;
		model.grid.origin      = Vec<Dim>::Constant(0.2);
		model.materials        = { { Hencky(young, 0), 1 } };
		model.newton.tolerance = 1e-10;
		std::vector<ConstrainedBox<Dim>> walls;
		for (int a = 0; a < Dim; ++a)
			walls.push_back(wallBelow<Dim>(model.grid, a, model.grid.origin[a]));
		walls.insert(walls.end(), more.begin(), more.end());
		model.boundary = Boundary<Dim>(walls);
		cloud          = block<Dim>(model.grid, cellsOf<Dim>(4, 2, 2), 2);
		addLayer(cut);
		model.fields       = { { { "pressure", "Pa", 1, young / h },
			                 [this](const PointCloud<Dim>&, const CloudBasis<Dim>& basis, const Grid<Dim>& grid) { return start(basis, grid); },
			           [this](const CloudBasis<Dim>& basis, const Eigen::VectorXd& v, const Eigen::VectorXd& f) {
			                   nodes= nodePositions(basis, model.grid), value = v, flow = f;
			           } } };
		model.coupledTerms = { [this](const StepContext<Dim>& step, const State&) { return std::make_unique<Flow<Dim>>(medium, step); } };
	}
	static ConstrainedBox<Dim> farEnd(const Model<Dim>& model, double displacement)
	{
		Vec<Dim> min = Vec<Dim>::Constant(-infinity);
		min[0]       = model.grid.origin[0] + length;
		return held<Dim>(model.grid, min, Vec<Dim>::Constant(infinity), "x", displacement * Vec<Dim>::Unit(0));
	}
	StepReport step() { return loadStep<Dim>(cloud, model, { Vec<Dim>::Zero(), { 1, 1 } }, solver); }

	/// Between those at both ends.
	double linear(const Vec<Dim>& x) const { return ends[0] + (ends[1] - ends[0]) * (x - model.grid.origin)[0] / length; }

private:
	void addLayer(double cut)
	{
		const double spacing = h / 2;
		forIndices<Dim>(cellsOf<Dim>(0, 0, 0), cellsOf<Dim>(8, 1, 4), [&](const Index<Dim>& i) {
			Vec<Dim> x    = model.grid.origin + spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5)),
			         half = Vec<Dim>::Constant(spacing / 2);
			x[1]          = model.grid.origin[1] + 2 * h + cut * h / 2;
			half[1]       = cut * h / 2;
			addPoint<Dim>(cloud, x, half);
		});
	}
	FieldStart start(const CloudBasis<Dim>& basis, const Grid<Dim>& grid) const
	{
		const auto x = nodePositions(basis, grid);
		FieldStart start { Eigen::VectorXd::Constant(Eigen::Index(x.size()), before), {} };
		for (std::size_t n = 0; n < x.size(); ++n)
			for (const int end : { 0, 1 })
				if (std::abs(x[n][0] - grid.origin[0] - end * length) < 1e-9) start.prescribed[int(n)] = ends[end];
		return start;
	}
};

} // namespace gimpm::seepage
