// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/inertia/motion.hpp"
#include "core/grid/masters.hpp"
#include "core/grid/point_nodes.hpp"
#include "core/terms/points/internal_force.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Part of the mass of a cell: (h/4)^2 / 3 for each axis, the extent of points that fill half of it.
constexpr double ofHalfACell = 1. / 12;

} // namespace

template <int Dim> MotionOfCopies<Dim>::MotionOfCopies(Motion<Dim>& motion, const Division& division) : motion_(motion), own_(motion.mass.size())
{
	motion.acceleration.resize(own_, Vec<Dim>::Zero());
	division.extend(motion.mass), division.extend(motion.velocity), division.extend(motion.acceleration);
}

template <int Dim> MotionOfCopies<Dim>::~MotionOfCopies() { motion_.mass.resize(own_), motion_.velocity.resize(own_), motion_.acceleration.resize(own_); }

template <int Dim> bool begins(const Motion<Dim>& motion, const Division& division)
{
	const auto&  all    = motion.acceleration;
	std::int64_t isZero = std::all_of(all.begin(), all.end(), [](const Vec<Dim>& a) { return a.isZero(0); });
	division.smallest(&isZero, 1);
	return isZero;
}

template <int Dim> std::vector<GhostFace<Dim>> massFaces(const Motion<Dim>& motion, const StepContext<Dim>& step)
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

template <int Dim> std::vector<LooseCell<Dim>> looseOf(const Motion<Dim>& motion, const StepContext<Dim>& step, int reach)
{
	if (motion.ghostMass == 0) return {};
	return looseCells(step.basis, motion.mass, step.faces, step.grid, reach, step.division);
}

template <int Dim> int countOfPoints(const std::vector<LooseCell<Dim>>& cells, const StepContext<Dim>& step)
{
	double count = 0;
	for (const auto& cell : cells)
		if (step.division.owns(step.basis.populatedLeaves()[cell.leaf])) count += cell.points;
	return int(step.division.sum(count));
}

/// At most what points have which fill half a cell; and less in short steps, in which inertia would keep the stiffness
/// of the points from telling at once what they do not see.
template <int Dim> std::vector<LooseCell<Dim>> extentOf(const std::vector<LooseCell<Dim>>& loose, const Motion<Dim>& motion, const StepContext<Dim>& step)
{
	constexpr double ofStiffness   = 1e-2;
	const auto       squareOfSpeed = [&](int p) { // squared speed of waves; none where nothing tears
                const auto [volume, modulus] = step.stiffnessOf(p);
                const bool isElastic         = !motion.isElastic.empty() && motion.isElastic[step.cloud.material[p]];
                return VolumeAndModulus { volume, isElastic ? 0 : modulus * volume / motion.mass[p] };
	};
	const auto&       leaves = step.basis.populatedLeaves();
	std::vector<char> isLoose(leaves.size(), 0);
	for (const auto& cell : loose)
		isLoose[cell.leaf] = 1;
	const auto square = cellModuli<Dim>(isLoose, step.basis, squareOfSpeed, step.grid);
	auto       extent = loose;
	for (auto& cell : extent) {
		const double way = motion.duration / step.grid.size(Grid<Dim>::level(leaves[cell.leaf]));
		cell.mass *= std::min(ofHalfACell, ofStiffness * motion.scheme.beta * way * way * square[cell.leaf]);
	}
	return extent;
}

template <int Dim>
std::vector<LooseCell<Dim>> tornOf(
        const std::vector<LooseCell<Dim>>& loose, const Eigen::VectorXd& velocity, const Motion<Dim>& motion, const StepContext<Dim>& step)
{
	const auto&                 leaves = step.basis.populatedLeaves();
	const MastersOf             masters(int(step.basis.nodes.size()), &step.basis.affineConstraints);
	std::vector<LooseCell<Dim>> torn;
	for (const auto& cell : loose) {
		const double   size = step.grid.size(Grid<Dim>::level(leaves[cell.leaf]));
		double         gap  = size / motion.duration;
		LooseCell<Dim> found;
		for (int axis = 0; axis < Dim; ++axis) {
			LooseCell<Dim> free  = cell;
			double         least = Motion<Dim>::infinite, most = -least;
			for (int& node : free.node) {
				const double v             = velocity[Dim * node + axis];
				bool         isConstrained = false;
				masters.each(node, [&](int master, double) { isConstrained = isConstrained || step.dofs.number[Dim * master + axis] < 0; });
				if (isConstrained) node = -1;
				else
					least = std::min(least, v), most = std::max(most, v);
			}
			if (most - least > gap) gap = most - least, found = free;
		}
		if (found.points > 0) torn.push_back(found);
	}
	return torn;
}

template <int Dim>
MassMatrix<Dim> massMatrix(
        const Motion<Dim>& motion, const StepContext<Dim>& step, const std::vector<LooseCell<Dim>>& loose, const std::vector<LooseCell<Dim>>& torn)
{
	MassMatrix<Dim> M(step.basis, motion.mass, massFaces(motion, step), step.grid.cellSize, loose);
	M.lump(torn, ofHalfACell);
	M.complete(step.ownedNodes, step.basis.nodes);
	return M;
}

template <int Dim>
Eigen::VectorXd weighedAtNodes(
        const CloudBasis<Dim>& basis, const std::vector<double>& mass, const std::vector<Vec<Dim>>& ofPoints, const OwnedNodes& ownedNodes)
{
	std::vector<Vec<Dim>> weighted(ofPoints.size());
	for (std::size_t p = 0; p < weighted.size(); ++p)
		weighted[p] = mass[p] * ofPoints[p];
	Eigen::VectorXd sum = Eigen::VectorXd::Zero(Dim * Eigen::Index(basis.nodes.size()));
	addPointForces(basis, weighted, sum);
	ownedNodes.complete(sum);
	basis.affineConstraints.template condense<Dim>(sum);
	return sum;
}

template <int Dim>
Eigen::VectorXd ofHeld(const Eigen::VectorXd& otherwise, OfBase<Dim> value, const std::vector<MovingBase<Dim>>& bases, const StepContext<Dim>& step)
{
	Eigen::VectorXd x = otherwise;
	for (const auto& base : bases)
		for (std::size_t n = 0; n < step.basis.nodes.size(); ++n)
			for (int a = 0; a < Dim; ++a)
				if (step.dofs.number[Dim * n + a] < 0 && base.box.constrains(step.basis.nodes[n], a)) x[Dim * n + a] = (base.*value)[a];
	return x;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::vector<LooseCell<Dim>> looseOf(const Motion<Dim>&, const StepContext<Dim>&, int);                                                        \
	template std::vector<GhostFace<Dim>> massFaces(const Motion<Dim>&, const StepContext<Dim>&);                                                           \
	template std::vector<LooseCell<Dim>> extentOf(const std::vector<LooseCell<Dim>>&, const Motion<Dim>&, const StepContext<Dim>&);                        \
	template int                         countOfPoints(const std::vector<LooseCell<Dim>>&, const StepContext<Dim>&);                                       \
	template std::vector<LooseCell<Dim>> tornOf(const std::vector<LooseCell<Dim>>&, const Eigen::VectorXd&, const Motion<Dim>&, const StepContext<Dim>&);  \
	template MassMatrix<Dim>             massMatrix(                                                                                                       \
	                    const Motion<Dim>&, const StepContext<Dim>&, const std::vector<LooseCell<Dim>>&, const std::vector<LooseCell<Dim>>&);              \
	template bool begins(const Motion<Dim>&, const Division&);                                                                                             \
	template class MotionOfCopies<Dim>;                                                                                                                    \
	template Eigen::VectorXd weighedAtNodes(const CloudBasis<Dim>&, const std::vector<double>&, const std::vector<Vec<Dim>>&, const OwnedNodes&);          \
	template Eigen::VectorXd ofHeld(const Eigen::VectorXd&, OfBase<Dim>, const std::vector<MovingBase<Dim>>&, const StepContext<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
