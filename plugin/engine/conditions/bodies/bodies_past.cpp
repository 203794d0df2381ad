// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/bodies/bodies_past.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/cells_around.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>

namespace yade {

namespace {
	using Bodies = std::set<int>;

	struct Past {
		int one, other, between;
	};

	// Pairs in one layer that both have a contact with a third body, which may lie between them.
	vector<Past> pairsPast(const Analysis& analysis, const vector<int>& layers)
	{
		vector<Past> pairs;
		const int    count = int(analysis.grid->bodies.size());
		for (int one = 0; one < count; ++one)
			for (int other = one + 1; other < count; ++other) {
				if (layers[one + 1] != layers[other + 1]) continue;
				for (int between = 0; between < count; ++between)
					if (meet(analysis, one, between) && meet(analysis, other, between)) pairs.push_back({ one, other, between });
			}
		return pairs;
	}

	// Lower and upper ends of the domain of a point, in cells of the largest size.
	template <int Dim> struct Box {
		std::int64_t            body;
		std::array<double, Dim> from, to;
	};

	// Boxes of some bodies, now or as they were filled, of all processes, in units of cells.
	template <int Dim> vector<Box<Dim>> boxesOf(const Bodies& bodies, const vector<MaterialPoint>& points, const gimpm::Model<Dim>& model, bool isNow)
	{
		vector<Box<Dim>> own;
		for (const MaterialPoint& point : points) {
			if (!bodies.count(point.state->body)) continue;
			Box<Dim> box { point.state->body, {}, {} };
			for (int axis = 0; axis < Dim; ++axis) {
				const Real x    = (isNow ? point.state->pos : point.state->refPos)[axis] - model.grid.origin[axis];
				const Real half = (isNow ? point.shape->halfSize : point.shape->halfSize0)[axis];
				box.from[axis] = (x - half) / gimpm::largestCell(model.grid), box.to[axis] = (x + half) / gimpm::largestCell(model.grid);
			}
			own.push_back(box);
		}
		return model.division->joined(std::move(own));
	}

	// Cells that the domains of each body reach into, with the bodies in them.
	template <int Dim> std::unordered_map<gimpm::Key, Bodies> bodiesInCells(const vector<Box<Dim>>& boxes)
	{
		std::unordered_map<gimpm::Key, Bodies> cells;
		constexpr double                       slack = 1e-6; // reach that counts as none
		for (const Box<Dim>& box : boxes) {
			gimpm::Index<Dim> first, last;
			for (int axis = 0; axis < Dim; ++axis)
				first[axis] = int(std::floor(box.from[axis] + slack)), last[axis] = int(std::floor(box.to[axis] - slack));
			gimpm::Index<Dim> cell = first;
			for (int axis = 0; axis < Dim;) {
				cells[gimpm::Grid<Dim>::key(cell)].insert(int(box.body));
				for (axis = 0; axis < Dim && ++cell[axis] > last[axis]; ++axis)
					cell[axis] = first[axis];
			}
		}
		return cells;
	}

	// A cell where two bodies are neighbours, and so share nodes, with the third one there.
	template <int Dim> std::optional<gimpm::Index<Dim>> sharedAt(const std::unordered_map<gimpm::Key, Bodies>& cells, const Past& past)
	{
		for (const auto& [key, bodies] : cells) {
			if (!bodies.count(past.one)) continue;
			bool isOther = false, isBetween = false;
			for (int n = 0; n < gimpm::cellsAround<Dim>; ++n) {
				const auto near = cells.find(gimpm::Grid<Dim>::key(gimpm::Grid<Dim>::index(key) + gimpm::offsetAround<Dim>(n)));
				if (near == cells.end()) continue;
				isOther   = isOther || near->second.count(past.other);
				isBetween = isBetween || near->second.count(past.between);
			}
			if (isOther && isBetween) return gimpm::Grid<Dim>::index(key);
		}
		return {};
	}

	// Domains that touch, within a hundredth of a cell.
	template <int Dim> bool touch(const Box<Dim>& one, const Box<Dim>& other)
	{
		for (int axis = 0; axis < Dim; ++axis)
			if (one.from[axis] > other.to[axis] + 0.01 || other.from[axis] > one.to[axis] + 0.01) return false;
		return true;
	}

	// Bodies that were filled side by side.
	template <int Dim> bool wereJoined(const Past& past, const vector<MaterialPoint>& points, const gimpm::Model<Dim>& model)
	{
		const auto boxes = boxesOf<Dim>({ past.one, past.other }, points, model, false);

		std::unordered_map<gimpm::Key, vector<const Box<Dim>*>> ofOne;
		const auto                                              cellOf = [](const Box<Dim>& box) {
                        gimpm::Index<Dim> cell;
                        for (int axis = 0; axis < Dim; ++axis)
                                cell[axis] = int(std::floor((box.from[axis] + box.to[axis]) / 2));
                        return cell;
		};
		for (const auto& box : boxes)
			if (box.body == past.one) ofOne[gimpm::Grid<Dim>::key(cellOf(box))].push_back(&box);
		return std::any_of(boxes.begin(), boxes.end(), [&](const Box<Dim>& box) {
			if (box.body != past.other) return false;
			for (int n = 0; n < gimpm::cellsAround<Dim>; ++n) {
				const auto near = ofOne.find(gimpm::Grid<Dim>::key(cellOf(box) + gimpm::offsetAround<Dim>(n)));
				if (near == ofOne.end()) continue;
				for (const Box<Dim>* one : near->second)
					if (touch(*one, box)) return true;
			}
			return false;
		});
	}
}

template <int Dim>
void requireNonePast(const vector<MaterialPoint>& points, const gimpm::Model<Dim>& model, const Analysis& analysis, const vector<int>& layers)
{
	const auto pairs = pairsPast(analysis, layers);
	if (pairs.empty()) return;
	Bodies all;
	for (const Past& past : pairs)
		all.insert({ past.one, past.other, past.between });
	const auto cells = bodiesInCells<Dim>(boxesOf<Dim>(all, points, model, true));
	for (const Past& past : pairs) {
		const auto at = sharedAt<Dim>(cells, past);
		if (!at || wereJoined(past, points, model)) continue;
		const auto name = [&](int body) { return "'" + analysis.grid->bodies[body]->name + "'"; };
		throw std::invalid_argument(gimpm::sentence(
		        "contacts: bodies of points ", name(past.one), " and ", name(past.other), " share nodes at (",
		        (model.grid.origin + gimpm::largestCell(model.grid) * at->template cast<double>()).transpose(), ") past ", name(past.between),
		        ", which is thinner there than two cells, and force would go from one to the other around it. Give them an MpmBodyContact(between=(",
		        name(past.one), ", ", name(past.other), "), friction=...), or smaller cells."));
	}
}

template void requireNonePast(const vector<MaterialPoint>&, const gimpm::Model<2>&, const Analysis&, const vector<int>&);
template void requireNonePast(const vector<MaterialPoint>&, const gimpm::Model<3>&, const Analysis&, const vector<int>&);

} // namespace yade
