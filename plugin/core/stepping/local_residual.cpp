// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/base/stopwatch.hpp"
#include "core/stepping/residual.hpp"

namespace gimpm {
namespace {

/// Strains this much smaller than the largest of the scene count for nothing: parts that carry no load need not be as
/// exact as those that do.
constexpr double negligible = 1e-4;

/// Codes of the offsets to the neighbours at most one cell away along each axis, the node itself left out; the others
/// are their opposites.
template <int Dim> const std::vector<int>& neighbourCodes()
{
	static const std::vector<int> codes = [] {
		std::vector<int> found;
		for (int n = (Dim == 2 ? 9 : 27) / 2 + 1; n < (Dim == 2 ? 9 : 27); ++n)
			found.push_back(NodeMatrix<Dim>::code(std::array<int, 3> { n % 3 - 1, n / 3 % 3 - 1, Dim == 2 ? 0 : n / 9 - 1 }));
		return found;
	}();
	return codes;
}

/// Calls f(node, neighbour) once for each pair of neighbours.
template <int Dim, class F> void forNeighbours(const NodeMatrix<Dim>& K, F&& f)
{
	for (int a = 0; a < K.nodes(); ++a)
		for (const int code : neighbourCodes<Dim>())
			if (const int b = K.neighbour(a, code); b >= 0) f(a, b);
}

double largestRatio(const Eigen::VectorXd& residual, const Eigen::VectorXd& forces)
{
	double ratio = 0;
	for (int n = 0; n < residual.size(); ++n)
		if (residual[n] > ratio * forces[n]) ratio = residual[n] / forces[n];
	return ratio;
}

} // namespace

/// The forces around a node are the absolute contributions of the terms and the external ones; where these are too
/// small, as after unloading, also those of the stresses at the start of the step and those that prescribed
/// displacements can cause. Round-off of d is no residual. Of several fields the least balanced one counts.
template <int Dim> double Residual<Dim>::local(const Eigen::VectorXd& d, double enough)
{
	const Stopwatch watch(report_.times.assembly);
	Eigen::VectorXd again, nodal = Eigen::VectorXd::Zero(d.size());
	if (!hasContributions_) system_.evaluate(d, again, nullptr, &contributions_);
	hasContributions_ = true;
	for (int i = 0; i < nodal.size(); ++i)
		if (system_.dofs.number[i] >= 0) nodal[i] = values[system_.dofs.number[i]];
	double largest = localOfDisplacements(nodal, d, enough);
	for (int field = 1; field < system_.map.fields(); ++field)
		largest = std::max(largest, localOf(field, nodal, system_.roundOff(d)));
	return largest;
}

/// Flows are compared with the largest one in all, as strains are, and with what prescribed growth causes.
template <int Dim> double Residual<Dim>::localOf(int field, const Eigen::VectorXd& nodal, const Eigen::VectorXd& roundOff) const
{
	const auto lengths = [&](const Eigen::VectorXd& all) {
		const int width = system_.map[field].width;
		return Eigen::VectorXd(
		        Eigen::Map<const Eigen::MatrixXd>(all.data() + system_.map.begin(field), width, system_.map.nodes()).colwise().template lpNorm<1>());
	};
	const Eigen::VectorXd forces = caused_.size() > 0 ? Eigen::VectorXd(contributions_ + caused_) : contributions_;
	const Eigen::VectorXd left = around(lengths(nodal)) / system_.map[field].scale, there = around(lengths(forces));
	return largestRatio((left - around(lengths(roundOff))).cwiseMax(0), there.array() + negligible * there.maxCoeff());
}

template <int Dim> double Residual<Dim>::localOfDisplacements(const Eigen::VectorXd& nodal, const Eigen::VectorXd& d, double enough) const
{
	// Lengths of the displacements, or forces, at the nodes.
	const auto lengths = [&](const Eigen::VectorXd& all) {
		return Eigen::VectorXd(
		        Eigen::Map<const Eigen::Matrix<double, Dim, Eigen::Dynamic>>(all.data(), Dim, system_.map.nodes()).colwise().template lpNorm<1>());
	};
	const Eigen::VectorXd left = around(lengths(nodal)), there = around(lengths(contributions_ + system_.external.cwiseAbs()));
	const double          found = largestRatio(left, there);
	if (found <= enough) return found;
	const double          strain = negligible * largestStrain(d) + elastic_.prescribedStrain(), motion = elastic_.strainOf(d);
	const Eigen::VectorXd before = elastic_.atNodes([&](int i) { return elastic_.strainAtStart(i) + strain; });
	const Eigen::VectorXd roundOff
	        = elastic_.atNodes([&](int i) { return elastic_.roundOff * (elastic_.strainAtStart(i) + motion); }) + lengths(system_.roundOff(d));
	return largestRatio((left - around(roundOff)).cwiseMax(0), there + around(before));
}

/// Sums over the nodes and their neighbours.
template <int Dim> Eigen::VectorXd Residual<Dim>::around(const Eigen::VectorXd& ofNode) const
{
	Eigen::VectorXd sum = ofNode;
	forNeighbours(K, [&](int a, int b) { sum[a] += ofNode[b], sum[b] += ofNode[a]; });
	return sum;
}

/// Largest strain before the step, and of the displacements d.
template <int Dim> double Residual<Dim>::largestStrain(const Eigen::VectorXd& d) const
{
	double before = 0, difference = 0;
	for (int i = 0; i < int(system_.points.volume0.size()); ++i)
		before = std::max(before, elastic_.strainAtStart(i));
	before = system_.model.division->largest(before);
	forNeighbours(K, [&](int a, int b) {
		const int cells = 1 << Grid<Dim>::level(K.keys()[a]);
		difference      = std::max(difference, (d.segment<Dim>(Dim * a) - d.segment<Dim>(Dim * b)).template lpNorm<Eigen::Infinity>() / cells);
	});
	return before + difference / system_.model.grid.cellSize;
}

template double Residual<2>::local(const Eigen::VectorXd&, double);
template double Residual<3>::local(const Eigen::VectorXd&, double);

} // namespace gimpm
