// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/ghost.hpp"
#include "core/grid/neighbours.hpp"
#include <algorithm>

namespace gimpm {
namespace {

bool contains(const std::vector<Key>& sorted, Key key) { return find(sorted, key) >= 0; }

/// Jump of dN/dn across a face for the nodes below, on and above it, times h.
constexpr double jump[3] = { -1, 2, -1 };

/// Integral over the face of N_s N_t for the nodes of the face: the linear mass matrix h/6 [2 1; 1 2] of each
/// tangential axis. Around an axis of symmetry each of its entries has the circumference at its own mean distance from
/// the axis.
template <int Dim> double faceMass(const GhostFace<Dim>& face, int s, int t, double h)
{
	double m = face.girth + (s + t) * face.widening;
	for (int a = 0; a < Dim - 1; ++a)
		m *= h / 6 * ((s >> a & 1) == (t >> a & 1) ? 2 : 1);
	return m;
}

/// Young's moduli of the leaves at the faces, by number: the means of their points, weighted by the volumes of the
/// overlaps.
template <int Dim>
std::vector<double> moduliAtFaces(
        const std::vector<GhostFace<Dim>>& faces, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid)
{
	std::vector<char> isAtFace(basis.populatedLeaves().size(), 0);
	for (const auto& face : faces)
		for (const int leaf : cellsAt(face, basis, grid))
			isAtFace[leaf] = 1;
	return cellModuli(isAtFace, basis, stiffnessOf, grid);
}

/// Calls f(node a, node b, code, coefficient) for the node pairs of a face; the coefficient is the same for
/// every displacement component, because [m] = [n][n]^T (eq. 5) picks the normal derivative of each.
template <int Dim, class F> void forNodePairs(const GhostFace<Dim>& face, double h, F&& f)
{
	constexpr int T = GhostFace<Dim>::tangentialNodes;
	h *= 1 << face.level();
	for (int i = 0; i < 3; ++i)
		for (int s = 0; s < T; ++s)
			for (int j = 0; j < 3; ++j)
				for (int t = 0; t < T; ++t) {
					std::array<int, Dim> offset {};
					offset[face.axis] = j - i;
					for (int a = 0, bit = 0; a < Dim; ++a)
						if (a != face.axis) offset[a] = (t >> bit & 1) - (s >> bit & 1), ++bit;
					const int code = NodeMatrix<Dim>::code(offset);
					if (code < 0) continue;
					f(face.node[i][s], face.node[j][t], code, face.stiffness * jump[i] * jump[j] / (h * h) * faceMass(face, s, t, h));
				}
}

/// True if a cell stands for the neighbour of a cell, on either side of a line that parts the body there.
template <int Dim> bool isPopulated(Key cell, Key neighbour, const std::vector<Key>& populated, const Grid<Dim>& grid)
{
	bool isThere = false;
	forSidesOf(cell, neighbour, grid, [&](Key beyond, int) { isThere |= contains(populated, beyond); });
	return isThere;
}

/// The circumference 2 pi r of a face around the axis of symmetry: over a cell from r_0 on, the mean of r weighted by
/// N_s N_t is r_0 + h (1 + s + t) / 4.
template <int Dim> void revolve(GhostFace<Dim>& face, const Grid<Dim>& grid)
{
	const double radius = grid.cellSize * (Grid<Dim>::index(face.lower)[0] - grid.axisNode());
	const double h      = grid.size(face.level());
	face.girth          = 2 * M_PI * (radius + h * (face.axis == 0 ? 1 : 0.25));
	face.widening       = face.axis == 0 ? 0 : 2 * M_PI * h / 4;
}

} // namespace

template <int Dim> std::array<int, 2> cellsAt(const GhostFace<Dim>& face, const CloudBasis<Dim>& basis, const Grid<Dim>& grid)
{
	const auto number = [&](Key cell) {
		if (grid.parting) cell = grid.parting->cellFor(cell);
		return position(basis.populatedLeaves(), grid.refinement ? grid.refinement->leafOf(cell) : cell);
	};
	return { number(face.lower), number(grid.first(face.lower + Grid<Dim>::keyStep(face.axis, face.level()))) };
}

template <int Dim> std::vector<Key> boundaryCells(const std::vector<Key>& populated, const Boundary<Dim>& boundary, const Grid<Dim>& grid)
{
	std::vector<Key> cells;
	for (const Key cell : populated) {
		const Index<Dim> i  = Grid<Dim>::index(cell);
		bool             is = false;
		for (int a = 0; a < Dim && !is; ++a)
			for (const bool isAbove : { false, true }) {
				forNeighbours(cell, a, isAbove, grid, [&](Key neighbour, int level) {
					if (is || isPopulated(cell, neighbour, populated, grid)) return;
					Index<Dim> face
					        = level < Grid<Dim>::level(cell) ? Grid<Dim>::index(neighbour) : i; // cell beside the face, on its lower corner
					face[a] = isAbove ? i[a] + (1 << Grid<Dim>::level(cell)) : i[a];
					is      = !boundary.lowerFaceIsWall(face, a, level, Grid<Dim>::layer(cell));
				});
			}
		if (is) cells.push_back(cell);
	}
	return cells;
}

template <int Dim>
std::vector<GhostFace<Dim>> ghostFaces(
        const std::vector<Key>& populated, const std::vector<Key>& boundaryCells, const Boundary<Dim>& boundary, const Grid<Dim>& grid)
{
	std::vector<GhostFace<Dim>> faces;
	for (const Key cell : populated)
		for (int a = 0; a < Dim; ++a)
			forCellsAbove(cell, a, grid, [&](Key above, Key lower) {
				if (!contains(populated, above) || (!contains(boundaryCells, cell) && !contains(boundaryCells, above))) return;
				const int  level = Grid<Dim>::level(lower);
				Index<Dim> face  = Grid<Dim>::index(lower);
				face[a] += 1 << level;
				if (!boundary.lowerFaceIsWall(grid.first(face), a, level, Grid<Dim>::layer(cell))) faces.push_back({ a, lower });
			});
	return faces;
}

template <int Dim>
void weighGhostFaces(
        std::vector<GhostFace<Dim>>& faces, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid, double factor,
        GhostScaling scaling)
{
	const auto modulus = moduliAtFaces(faces, basis, stiffnessOf, grid);
	const auto levelOf = [&](int leaf) { return Grid<Dim>::level(basis.populatedLeaves()[leaf]); };
	for (auto& face : faces) {
		const auto [lower, upper] = cellsAt(face, basis, grid);
		const double h = grid.size(std::max(levelOf(lower), levelOf(upper))), power = scaling == GhostScaling::paper ? h * h * h : h;
		face.stiffness = factor * std::min(modulus[lower], modulus[upper]) * power / 3;
		if (grid.axisymmetric) revolve(face, grid);
		for (int i = 0; i < 3; ++i)
			for (int s = 0; s < GhostFace<Dim>::tangentialNodes; ++s)
				face.node[i][s] = position(basis.nodes, grid.first(face.key(i, s)));
	}
}

template <int Dim> void markGhostPattern(const std::vector<GhostFace<Dim>>& faces, NodeMatrix<Dim>& K)
{
	for (const auto& face : faces)
		forNodePairs(face, 1, [&](int node, int, int code, double) { K.markUsed(node, code); });
}

template <int Dim> void addGhostStiffness(const std::vector<GhostFace<Dim>>& faces, double h, NodeMatrix<Dim>& K)
{
	for (const auto& face : faces)
		forNodePairs(face, h, [&](int node, int, int code, double k) {
			if (!K.keeps(node)) return;
			double* block = K.at(node, code);
			for (int i = 0; i < Dim; ++i)
				block[i * (Dim + 1)] += k;
		});
}

template <int Dim> void forGhostPairs(const std::vector<GhostFace<Dim>>& faces, double h, const std::function<void(int, int, int, double)>& f)
{
	for (const auto& face : faces)
		forNodePairs(face, h, f);
}

template <int Dim> void addGhostForce(const std::vector<GhostFace<Dim>>& faces, double smallest, const Eigen::VectorXd& d, Eigen::VectorXd& f)
{
	constexpr int T = GhostFace<Dim>::tangentialNodes;
	for (const auto& face : faces) {
		const double h = smallest * (1 << face.level());
		Vec<Dim>     gradientJump[T]; // h times the jump of the normal derivative at each node of the face
		for (int s = 0; s < T; ++s) {
			gradientJump[s].setZero();
			for (int i = 0; i < 3; ++i)
				gradientJump[s] += jump[i] * d.template segment<Dim>(Dim * face.node[i][s]);
		}
		for (int s = 0; s < T; ++s) {
			Vec<Dim> force = Vec<Dim>::Zero();
			for (int t = 0; t < T; ++t)
				force += face.stiffness / (h * h) * faceMass(face, s, t, h) * gradientJump[t];
			for (int i = 0; i < 3; ++i)
				f.template segment<Dim>(Dim * face.node[i][s]) += jump[i] * force;
		}
	}
}

template <int Dim> std::optional<PointFailure> GhostForce<Dim>::add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum)
{
	const Eigen::VectorXd before = sum.absoluteContributions ? sum.force : Eigen::VectorXd();
	if (from_.size() > 0) addGhostForce<Dim>(faces_, h_, d - from_, sum.force);
	else
		addGhostForce(faces_, h_, d, sum.force);
	if (sum.absoluteContributions) *sum.absoluteContributions += (sum.force - before).cwiseAbs();
	if (sum.K) addGhostStiffness(faces_, h_, *sum.K);
	return std::nullopt;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::vector<Key>            boundaryCells(const std::vector<Key>&, const Boundary<Dim>&, const Grid<Dim>&);                                   \
	template std::vector<GhostFace<Dim>> ghostFaces(const std::vector<Key>&, const std::vector<Key>&, const Boundary<Dim>&, const Grid<Dim>&);             \
	template std::array<int, 2>          cellsAt(const GhostFace<Dim>&, const CloudBasis<Dim>&, const Grid<Dim>&);                                         \
	template void weighGhostFaces(std::vector<GhostFace<Dim>>&, const CloudBasis<Dim>&, const PointStiffness&, const Grid<Dim>&, double, GhostScaling);    \
	template void markGhostPattern(const std::vector<GhostFace<Dim>>&, NodeMatrix<Dim>&);                                                                  \
	template void addGhostStiffness(const std::vector<GhostFace<Dim>>&, double, NodeMatrix<Dim>&);                                                         \
	template void forGhostPairs(const std::vector<GhostFace<Dim>>&, double, const std::function<void(int, int, int, double)>&);                            \
	template void addGhostForce(const std::vector<GhostFace<Dim>>&, double, const Eigen::VectorXd&, Eigen::VectorXd&);                                     \
	template class GhostForce<Dim>;
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
