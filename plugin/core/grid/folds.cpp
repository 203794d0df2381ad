// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/folds.hpp"
#include "core/grid/by_cell.hpp"
#include "core/grid/disjoint_sets.hpp"
#include "core/grid/layer_of_nearest.hpp"
#include "core/grid/parting.hpp"
#include "core/grid/parts_of_body.hpp"
#include "core/grid/refinement.hpp"
#include <map>
#include <set>

namespace gimpm {
namespace {

/// Distance of pieces that face each other up to which their soil may share nodes [cells, the larger one of both].
constexpr double reachOfFolds = 2.5;
/// Depth of a piece behind another one that it faces, at most, if one of them is pressed or not [smallest cells]: the
/// two faces of a film do not face each other.
constexpr double deepestPressed = 0.35, deepestFree = 0.05;
/// Soil thinner than this does not fold, but flows as a film [cells].
constexpr double thinnest = 0.9;
/// Cosine of the angle between their normals, at most.
constexpr double leastFacing = -0.3;
/// Gap between domains that are neighbours, at most [cells].
constexpr double gapOfNeighbours = 0.75;

/// Size of the largest leaf of which a node may have functions in a cell [smallest cells].
template <int Dim> int largestNear(const Index<Dim>& cell, const Grid<Dim>& grid)
{
	if (!grid.refinement) return 1;
	for (int level = grid.refinement->largest(); level > 0; --level)
		for (int n = 0; n < cellsAround<Dim>; ++n)
			if (Grid<Dim>::level(grid.refinement->leafOf(Grid<Dim>::key(cell + (1 << level) * offsetAround<Dim>(n)))) == level) return 1 << level;
	return 1;
}

/// Keys of smallest cells, and of those around them as far as one of the largest leaves there reaches.
template <int Dim> std::set<Key> widened(const std::set<Key>& cells, const Grid<Dim>& grid)
{
	std::set<Key> all;
	for (const Key key : cells) {
		const Index<Dim> cell = Grid<Dim>::index(key);
		const int        most = largestNear<Dim>(cell, grid);
		forIndicesUpTo<Dim>(cell.array() - most, cell.array() + most, [&](const Index<Dim>& near) { all.insert(Grid<Dim>::key(near)); });
	}
	return all;
}

/// The search for folds of one body.
template <int Dim> class FoldSearch {
public:
	FoldSearch(FoldingBody<Dim>& body, int firstBit, const Grid<Dim>& grid)
	        : body_(body), firstBit_(firstBit), grid_(grid), pieces_(grid.origin, grid.cellSize)
	{
		for (const auto& piece : body.surface->pieces) {
			Vec<Dim> centre = Vec<Dim>::Zero();
			for (const int v : piece)
				centre += body.surface->vertices[v] / Dim;
			centre_.push_back(centre), normal_.push_back(body.surface->normal(piece, body.surface->vertices).normalized());
			size_.push_back(cellSizeAt(grid, centre));
		}
	}

	/// Sets layers of points and pieces, and adds keys of nodes that are there twice.
	void part(PointCloud<Dim>& cloud, std::vector<Key>& own)
	{
		body_.layerOfPiece.clear();
		const std::set<Key> near = cellsOfFacingPieces();
		if (near.empty()) return;
		const std::set<Key> around = widened<Dim>(near, grid_), reached = widened<Dim>(around, grid_);
		takePieces(reached);
		takePoints(cloud, reached);
		connect();
		divideNodes(around);
		if (split_.empty()) {
			for (const Vec<Dim>& centre : centre_)
				body_.layerOfPiece.push_back(near.count(Grid<Dim>::key(pieces_.cell(centre))) ? body_.layer : -1);
			return;
		}
		findSides();
		joinParts();
		numberSides();
		for (const Split& node : split_)
			for (const auto& part : node.parts)
				if (const int layer = layer_[side_[part[0]]]; !node.isWhole && layer > 0)
					own.push_back(Parting<Dim>::in(body_.layer | layer, node.key));
		for (std::size_t i = 0; i < points_.size(); ++i)
			if (side_[i] >= 0) cloud.layer[points_[i]] = body_.layer | layer_[side_[i]];
		for (std::size_t i = 0; i < centre_.size(); ++i)
			body_.layerOfPiece.push_back(sideOfPiece_[i] < 0 ? -1 : body_.layer | layer_[sideOfPiece_[i]]);
	}

private:
	/// A node at which the points that have its functions are in parts.
	struct Split {
		Key                           key;
		std::vector<std::vector<int>> parts;
		bool                          isWhole = false; ///< its parts cannot have nodes of their own
	};

	bool isPressed(int piece) const { return piece < int(body_.pressure.size()) && body_.pressure[piece] > 0; }

	/// Size of the larger one of the cells of two pieces [m].
	double sizeOf(int i, int j) const { return std::max(size_[i], size_[j]); }

	/// True if two pieces are the two faces of a film.
	bool areOfFilm(int i, int j) const
	{
		const Vec<Dim> way = centre_[j] - centre_[i];
		const double   h = sizeOf(i, j), back = -way.dot(normal_[i]);
		return normal_[i].dot(normal_[j]) < leastFacing && !isPressed(i) && !isPressed(j) && back > deepestFree * grid_.cellSize && back < thinnest * h
		        && (way + back * normal_[i]).norm() < thinnest * h / 2;
	}

	bool face(int i, int j) const
	{
		const Vec<Dim> way = centre_[j] - centre_[i];
		const double   h = sizeOf(i, j), deepest = -(isPressed(i) || isPressed(j) ? deepestPressed : deepestFree) * grid_.cellSize;
		return normal_[i].dot(normal_[j]) < leastFacing && way.squaredNorm() < reachOfFolds * reachOfFolds * h * h && way.dot(normal_[i]) > deepest
		        && -way.dot(normal_[j]) > deepest;
	}

	/// Bits of the axes along which a normal leads, two for each; normals that face each other have opposite ones.
	static int signsOf(const Vec<Dim>& normal)
	{
		constexpr double least = -leastFacing / Dim;
		int              signs = 0;
		for (int a = 0; a < Dim; ++a)
			signs |= (normal[a] > least) << a | (normal[a] < -least) << (Dim + a);
		return signs;
	}
	static bool areOpposite(int signs, int others)
	{
		constexpr int up = (1 << Dim) - 1;
		return (signs & up & others >> Dim) || (others & up & signs >> Dim);
	}

	std::set<Key> cellsOfFacingPieces() const
	{
		ByCell<Dim>                  pieces(grid_.origin, reachOfFolds * largestCell(grid_));
		std::unordered_map<Key, int> signs;
		for (std::size_t i = 0; i < centre_.size(); ++i) {
			const Index<Dim> cell = pieces.cell(centre_[i]);
			pieces.add(cell, int(i)), signs[Grid<Dim>::key(cell)] |= signsOf(normal_[i]);
		}
		std::unordered_map<Key, int> around;
		for (const auto& [cell, own] : signs)
			for (int n = 0; n < cellsAround<Dim>; ++n)
				around[Grid<Dim>::key(Grid<Dim>::index(cell) + offsetAround<Dim>(n))] |= own;
		std::vector<char> faces(centre_.size(), 0), isOfFilm(centre_.size(), 0);
		const auto        forOpposite = [&](auto&& f) {
                        for (int i = 0; i < int(centre_.size()); ++i)
                                if (areOpposite(signsOf(normal_[i]), around[Grid<Dim>::key(pieces.cell(centre_[i]))]))
                                        pieces.forNear(centre_[i], [&](int j) { f(i, j); });
		};
		forOpposite([&](int i, int j) { isOfFilm[i] |= !isOfFilm[i] && areOfFilm(i, j); });
		forOpposite([&](int i, int j) {
			if (j > i && !isOfFilm[i] && !isOfFilm[j] && !(faces[i] && faces[j]) && face(i, j)) faces[i] = faces[j] = 1;
		});
		std::set<Key> cells;
		for (std::size_t i = 0; i < faces.size(); ++i)
			if (faces[i]) cells.insert(Grid<Dim>::key(pieces_.cell(centre_[i])));
		return cells;
	}

	/// Pieces by all cells that they may go through.
	void takePieces(const std::set<Key>& cells)
	{
		behind_.assign(centre_.size(), -1);
		for (std::size_t i = 0; i < centre_.size(); ++i) {
			if (!cells.count(Grid<Dim>::key(pieces_.cell(centre_[i])))) continue;
			Vec<Dim> low = centre_[i], high = low;
			for (const int v : body_.surface->pieces[i])
				low = low.cwiseMin(body_.surface->vertices[v]), high = high.cwiseMax(body_.surface->vertices[v]);
			forIndicesUpTo<Dim>(pieces_.cell(low), pieces_.cell(high), [&](const Index<Dim>& cell) { pieces_.add(cell, int(i)); });
			near_.push_back(int(i));
		}
	}

	void takePoints(const PointCloud<Dim>& cloud, const std::set<Key>& cells)
	{
		for (int p = 0; p < int(cloud.size()); ++p)
			if (cloud.layer[p] == body_.layer && cells.count(Grid<Dim>::key(pieces_.cell(cloud.position[p]))))
				points_.push_back(p), boxes_.push_back(domainBox<Dim>(cloud.position[p], cloud.halfSize[p])),
				        sizeOfPoint_.push_back(cellSizeAt(grid_, cloud.position[p]));
	}

	Vec<Dim> centreOf(int i) const { return (boxes_[i].low + boxes_[i].high) / 2; }

	bool isThroughSurface(const Vec<Dim>& a, const Vec<Dim>& b) const
	{
		bool is = false;
		forIndicesUpTo<Dim>(pieces_.cell(a.cwiseMin(b)), pieces_.cell(a.cwiseMax(b)), [&](const Index<Dim>& cell) {
			pieces_.forAll(cell, [&](int i) {
				if (is) return;
				const double one = normal_[i].dot(a - centre_[i]), other = normal_[i].dot(b - centre_[i]);
				is = one * other <= 0 && body_.surface->cuts(body_.surface->pieces[i], a, b);
			});
		});
		return is;
	}

	/// Finds the neighbours of points that no piece parts from them, and the nearest point behind each piece. Few
	/// points that are connected to no others have got out of the surface: they go with the nearest point.
	void connect()
	{
		ByCell<Dim> byCell(grid_.origin, largestCell(grid_));
		for (std::size_t i = 0; i < boxes_.size(); ++i)
			byCell.add(byCell.cell(centreOf(int(i))), int(i));
		neighbours_.resize(boxes_.size());
		DisjointSets                    connected(int(boxes_.size()));
		std::vector<std::array<int, 2>> parted;
		for (int i = 0; i < int(boxes_.size()); ++i)
			byCell.forNear(centreOf(i), [&](int j) {
				const double gap = (boxes_[i].low - boxes_[j].high).cwiseMax(boxes_[j].low - boxes_[i].high).maxCoeff();
				if (j <= i || gap > gapOfNeighbours * std::max(sizeOfPoint_[i], sizeOfPoint_[j])) return;
				if (isThroughSurface(centreOf(i), centreOf(j))) return parted.push_back({ i, j });
				neighbours_[i].push_back(j), neighbours_[j].push_back(i), connected.join(i, j);
			});
		connectStrays(connected, parted);
		for (const int piece : near_)
			behind_[piece] = pointBehind(piece, byCell);
	}

	/// The nearest point behind a piece, if there is one without a way through the surface to it.
	int pointBehind(int piece, const ByCell<Dim>& byCell) const
	{
		constexpr double inside = 0.02; // [cells]
		const Vec<Dim>   from   = centre_[piece] - inside * grid_.cellSize * normal_[piece];
		int              nearest[2] { -1, -1 }; // through the surface or not
		double           least[2] { std::numeric_limits<double>::infinity(), least[0] };
		byCell.forNear(centre_[piece], [&](int i) {
			const Vec<Dim> way  = centreOf(i) - from;
			const double   away = way.squaredNorm();
			if (way.dot(normal_[piece]) >= 0 || away >= least[1]) return;
			const bool isFree = !isThroughSurface(from, centreOf(i));
			if (away < least[isFree]) least[isFree] = away, nearest[isFree] = i;
		});
		return nearest[1] >= 0 ? nearest[1] : nearest[0];
	}

	void connectStrays(DisjointSets& connected, const std::vector<std::array<int, 2>>& parted)
	{
		constexpr int    few = 1 << Dim;
		std::vector<int> size(boxes_.size(), 0);
		for (int i = 0; i < int(boxes_.size()); ++i)
			++size[connected.root(i)];
		std::map<int, std::pair<double, int>> nearest;
		for (const auto& [i, j] : parted)
			for (const auto& [stray, other] : { std::pair(i, j), std::pair(j, i) }) {
				if (size[connected.root(stray)] >= few || size[connected.root(other)] < few) continue;
				const auto found    = nearest.emplace(stray, std::pair((centreOf(i) - centreOf(j)).squaredNorm(), other));
				found.first->second = std::min(found.first->second, std::pair((centreOf(i) - centreOf(j)).squaredNorm(), other));
			}
		for (const auto& [stray, by] : nearest)
			neighbours_[stray].push_back(by.second), neighbours_[by.second].push_back(stray);
	}

	/// Finds nodes at which points are in parts. Points half a cell farther away connect them, too.
	void divideNodes(const std::set<Key>& cells)
	{
		ByCell<Dim> points(grid_.origin, grid_.cellSize);
		for (int i = 0; i < int(boxes_.size()); ++i)
			points.add(points.cell(centreOf(i)), i);
		std::set<Key> nodes;
		for (const Key cell : cells)
			for (int corner = 0; corner < 1 << Dim; ++corner)
				nodes.insert(cell + Grid<Dim>::keyOffset(corner));
		std::vector<int> numberOf(boxes_.size(), -1);
		for (const Key node : nodes) {
			const Index<Dim> index = Grid<Dim>::index(node);
			const int        level = grid_.refinement ? grid_.refinement->largestAt(index) : 0;
			if (index == index.unaryExpr([level](int i) { return floorTo(i, level); })) divideNode(index, level, points, numberOf); // does not hang
		}
	}

	/// Distance of a domain from a position along the worst axis [m].
	double awayFrom(const Vec<Dim>& x, int i) const { return (boxes_[i].low - x).cwiseMax(x - boxes_[i].high).maxCoeff(); }

	/// Points within the reach of the functions of a node, and half a cell farther, whose numbers it gives.
	std::vector<int> pointsAround(const Index<Dim>& node, double size, const ByCell<Dim>& points, std::vector<int>& numberOf) const
	{
		constexpr double farther = 0.5; // [cells]
		const Vec<Dim>   x       = grid_.nodePosition(node);
		const int        most    = 3 * int(std::lround(size / grid_.cellSize));
		std::vector<int> around;
		forIndicesUpTo<Dim>(node.array() - most, node.array() + most - 1, [&](const Index<Dim>& cell) {
			points.forAll(cell, [&](int i) {
				if (awayFrom(x, i) / size < 1 + farther) numberOf[i] = int(around.size()), around.push_back(i);
			});
		});
		return around;
	}

	void divideNode(const Index<Dim>& node, int level, const ByCell<Dim>& points, std::vector<int>& numberOf)
	{
		const double           size   = grid_.size(level);
		const Vec<Dim>         x      = grid_.nodePosition(node);
		const std::vector<int> around = pointsAround(node, size, points, numberOf);
		DisjointSets           connected(int(around.size()));
		for (const int i : around)
			for (const int j : neighbours_[i])
				if (numberOf[j] >= 0) connected.join(numberOf[i], numberOf[j]);
		std::map<int, std::vector<int>> parts;
		for (const int i : around)
			if (awayFrom(x, i) / size < 1 - 1e-6) parts[connected.root(numberOf[i])].push_back(i);
		for (const int i : around)
			numberOf[i] = -1;
		if (parts.size() < 2) return;
		split_.push_back({ Grid<Dim>::key(node, level), {} });
		for (auto& [root, part] : parts)
			split_.back().parts.push_back(std::move(part));
	}

	/// Joins parts that share points to sides, and numbers these: first those without pressed pieces, and as their
	/// first points are numbered.
	void findSides()
	{
		DisjointSets connected(int(boxes_.size()));
		side_.assign(boxes_.size(), -1);
		for (const Split& node : split_)
			for (const auto& part : node.parts)
				for (const int i : part)
					connected.join(part[0], i), side_[i] = 0;
		for (int i = 0; i < int(boxes_.size()); ++i)
			if (side_[i] == 0) side_[i] = connected.root(i);
		findSidesOfPieces();
		std::set<int> pressed;
		for (const int piece : near_)
			if (isPressed(piece)) pressed.insert(sideOfPiece_[piece]);
		std::map<std::pair<bool, int>, int> number;
		for (const int side : side_)
			if (side >= 0) number[{ pressed.count(side) > 0, side }];
		int next = 0;
		for (auto& [side, own] : number)
			own = next++;
		for (auto* sides : { &side_, &sideOfPiece_ })
			for (int& side : *sides)
				if (side >= 0) side = number[{ pressed.count(side) > 0, side }];
		layer_.assign(next, 0);
	}

	/// Sides of the points behind pieces: that which most of the surface around a piece has. A corner that has got
	/// a little into the other side has points of both behind it.
	void findSidesOfPieces()
	{
		constexpr double                around = 0.75; // [cells]
		std::map<int, std::vector<int>> at;            // pieces by vertex
		for (const int i : near_)
			for (const int v : body_.surface->pieces[i])
				at[v].push_back(i);
		sideOfPiece_.assign(centre_.size(), -1);
		std::vector<int> foundFor(centre_.size(), -1);
		for (const int i : near_) {
			if (behind_[i] < 0 || side_[behind_[i]] < 0) continue;
			std::vector<int> found { i };
			foundFor[i] = i;
			std::map<int, double> area;
			for (std::size_t n = 0; n < found.size(); ++n) {
				const auto& piece = body_.surface->pieces[found[n]];
				if (const int by = behind_[found[n]]; by >= 0 && side_[by] >= 0)
					area[side_[by]] += body_.surface->normal(piece, body_.surface->vertices).norm();
				for (const int v : piece)
					for (const int next : at[v])
						if (foundFor[next] != i && (centre_[next] - centre_[i]).norm() < around * size_[i])
							foundFor[next] = i, found.push_back(next);
			}
			sideOfPiece_[i] = std::max_element(area.begin(), area.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
		}
	}

	/// Joins parts of one side at a node: they are connected elsewhere.
	void joinParts()
	{
		for (Split& node : split_) {
			std::map<int, std::vector<int>> bySide;
			for (const auto& part : node.parts)
				bySide[side_[part[0]]].insert(bySide[side_[part[0]]].end(), part.begin(), part.end());
			node.parts.clear();
			for (auto& [side, part] : bySide)
				node.parts.push_back(std::move(part));
			node.isWhole = node.parts.size() == 1;
		}
	}

	/// Gives sides that meet at a node different bits.
	void numberSides()
	{
		std::vector<std::set<int>> meet(layer_.size());
		for (Split& node : split_)
			for (const auto& part : node.parts)
				for (const auto& other : node.parts)
					if (&part != &other) meet[side_[part[0]]].insert(side_[other[0]]);
		std::vector<char> hasNone(layer_.size(), 0);
		for (std::size_t side = 0; side < layer_.size(); ++side) {
			std::set<int> taken;
			for (const int other : meet[side])
				if (other < int(side)) taken.insert(layer_[other]);
			int layer = 0;
			while (taken.count(layer))
				layer = layer == 0 ? firstBit_ : layer << 1;
			hasNone[side] = layer > Grid<Dim>::mostLayer;
			layer_[side]  = hasNone[side] ? 0 : layer;
		}
		for (Split& node : split_)
			for (const auto& part : node.parts)
				node.isWhole |= hasNone[side_[part[0]]];
	}

	FoldingBody<Dim>&             body_;
	const int                     firstBit_;
	const Grid<Dim>&              grid_;
	std::vector<Vec<Dim>>         centre_, normal_; // of all pieces
	std::vector<double>           size_;            // of their cells [m]
	ByCell<Dim>                   pieces_;
	std::vector<int>              near_, behind_; // pieces near folds; the point behind each piece, -1: none
	std::vector<int>              points_;        // points near folds, in the cloud
	std::vector<DomainBox<Dim>>   boxes_;         // their domains
	std::vector<double>           sizeOfPoint_;   // of their cells [m]
	std::vector<std::vector<int>> neighbours_;
	std::vector<Split>            split_;
	std::vector<int>              side_, sideOfPiece_, layer_; // by point and by piece, -1: of none; by side
};

} // namespace

template <int Dim> void partFolds(std::vector<FoldingBody<Dim>>& bodies, int bitsOfBodies, PointCloud<Dim>& cloud, Grid<Dim>& grid)
{
	std::vector<Key> own;
	grid.parting.reset();
	for (int& layer : cloud.layer)
		layer &= bitsOfBodies;
	for (FoldingBody<Dim>& body : bodies)
		FoldSearch<Dim>(body, bitsOfBodies + 1, grid).part(cloud, own);
	if (own.empty()) {
		for (int& layer : cloud.layer)
			layer &= bitsOfBodies;
		for (FoldingBody<Dim>& body : bodies)
			for (int& layer : body.layerOfPiece)
				layer = std::min(layer, body.layer);
		return;
	}
	grid.parting = std::make_shared<Parting<Dim>>(
	        std::move(own), LayerOfNearest<Dim>(cloud, bitsOfBodies, grid), grid.refinement, std::vector<LeakyCut<Dim>>(), bitsOfBodies);
}

template void partFolds(std::vector<FoldingBody<2>>&, int, PointCloud<2>&, Grid<2>&);
template void partFolds(std::vector<FoldingBody<3>>&, int, PointCloud<3>&, Grid<3>&);

} // namespace gimpm
