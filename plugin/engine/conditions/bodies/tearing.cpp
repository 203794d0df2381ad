// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/bodies/tearing.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/parts_of_body.hpp"
#include "engine/conditions/bodies/contact_records.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include <algorithm>
#include <map>
#include <numeric>

namespace yade {

namespace {
	template <int Dim> using Boxes = vector<gimpm::DomainBox<Dim>>;

	template <int Dim> gimpm::DomainBox<Dim> boxOf(const MaterialPoint& point)
	{
		const gimpm::Vec<Dim> x = point.state->pos.template head<Dim>(), half = point.shape->halfSize.template head<Dim>();
		return { x - half, x + half };
	}

	// Numbers of parts in one that has an odd end: pieces that share vertices have one number each.
	vector<int> connected(const vector<vector<int>>& pieces, size_t vertices)
	{
		vector<int> above(vertices);
		std::iota(above.begin(), above.end(), 0);
		const auto root = [&](int v) {
			while (above[v] != v)
				v = above[v] = above[above[v]];
			return v;
		};
		for (const auto& piece : pieces)
			for (const int v : piece)
				above[root(v)] = root(piece[0]);
		vector<int> numbers;
		for (const auto& piece : pieces)
			numbers.push_back(root(piece[0]));
		return numbers;
	}

	// A body that falls into parts.
	template <int Dim> class Torn {
	public:
		Torn(MpmGrid& grid, int body, const vector<const MaterialPoint*>& points) : grid(grid), body(body), points(points)
		{
			for (const auto* point : points)
				boxes.push_back(boxOf<Dim>(*point));
		}

		// Parts as large as `least` points, the largest first, and all others with it.
		vector<vector<int>> parts(int least) const
		{
			constexpr Real    touches = 0.01; // [cells]
			const bool        isFirst = grid.bodies[body]->initialVertices.empty();
			const vector<int> number  = isFirst ? gimpm::partsByTouch<Dim>(boxes, touches * grid.cellSize, grid.cellSize)
			                                    : gimpm::partsBySharedNodes<Dim>(boxes, grid.lattice<Dim>());
			if (number.empty()) return {};
			vector<vector<int>> all(*std::max_element(number.begin(), number.end()) + 1);
			for (size_t i = 0; i < number.size(); ++i)
				all[number[i]].push_back(int(i));
			const auto largest = std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
			std::rotate(all.begin(), largest, largest + 1);
			for (size_t i = 1; i < all.size(); ++i)
				if (int(all[i].size()) < least) all[0].insert(all[0].end(), all[i].begin(), all[i].end()), all[i].clear();
			all.erase(std::remove_if(all.begin(), all.end(), [](const auto& part) { return part.empty(); }), all.end());
			return all;
		}

		// Gives the parts after the first one bodies.
		void tear(const vector<vector<int>>& parts, const vector<shared_ptr<MpmBodyContact>>& contacts)
		{
			const PointWriter writer;
			vector<int>       partOfPoint(points.size(), 0);
			for (size_t part = 0; part < parts.size(); ++part) {
				numbers.push_back(part == 0 ? body : int(grid.bodies.size()));
				for (const int i : parts[part])
					partOfPoint[i] = int(part), writer.state(*points[i]).body = numbers.back();
				if (part > 0) grid.bodies.push_back(newBody());
			}
			const vector<int> partOfPiece = partsOfPieces(partOfPoint);
			for (const auto& contact : contacts)
				divideRecords(*contact, partOfPiece);
			if (!partOfPiece.empty()) dividePieces(partOfPiece);
			else
				for (size_t part = 0; part < parts.size(); ++part)
					drawAnew(numbers[part], parts[part]);
		}

	private:
		shared_ptr<MpmBody> newBody() const
		{
			const shared_ptr<MpmBody> part(new MpmBody);
			part->partOf = grid.nameOfWhole(body);
			for (int number = 2; part->name.empty() || grid.bodyNamed(part->name) >= 0; ++number)
				part->name = part->partOf + " " + std::to_string(number);
			return part;
		}

		// The part of each piece of the surface, by the nearest point; empty if a surface goes around points of
		// two parts.
		vector<int> partsOfPieces(const vector<int>& partOfPoint) const
		{
			const MpmBody&          from = *grid.bodies[body];
			vector<gimpm::Vec<Dim>> middles;
			for (const auto& piece : from.pieces) {
				gimpm::Vec<Dim> sum = gimpm::Vec<Dim>::Zero();
				for (const int v : piece)
					sum += from.vertices[v].template head<Dim>() / Real(piece.size());
				middles.push_back(sum);
			}
			const auto         nearest = gimpm::nearestBoxes<Dim>(boxes, middles, grid.cellSize);
			const auto         surface = connected(from.pieces, from.vertices.size());
			std::map<int, int> partOfSurface;
			vector<int>        found;
			for (size_t i = 0; i < nearest.size(); ++i) {
				found.push_back(partOfPoint[nearest[i]]);
				if (partOfSurface.emplace(surface[i], found.back()).first->second != found.back()) return {};
			}
			const std::set<int> present(found.begin(), found.end());
			return present.size() == numbers.size() ? found : vector<int>();
		}

		// Stresses go with their pieces; those of surfaces that are drawn anew are lost.
		void divideRecords(MpmBodyContact& contact, const vector<int>& partOfPiece) const
		{
			vector<ContactRecord> records;
			for (const ContactRecord& record : recordsOf(contact, grid)) {
				const bool isMaster = record.master == body;
				if (record.slave != body) {
					for (size_t part = 0; part < (isMaster ? numbers.size() : 1); ++part)
						records.push_back({ record.slave, isMaster ? numbers[part] : record.master, record.pressures, record.shears });
					continue;
				}
				if (record.pressures.size() != partOfPiece.size()) continue;
				for (size_t part = 0; part < numbers.size(); ++part) {
					records.push_back({ numbers[part], isMaster ? numbers[part] : record.master });
					for (size_t i = 0; i < partOfPiece.size(); ++i)
						if (partOfPiece[i] == int(part))
							records.back().pressures.push_back(record.pressures[i]),
							        records.back().shears.push_back(record.shears[i]);
				}
			}
			keepRecords(contact, grid, records);
		}

		void dividePieces(const vector<int>& partOfPiece)
		{
			const MpmBody from = *grid.bodies[body];
			for (size_t part = 0; part < numbers.size(); ++part) {
				MpmBody&           to = *grid.bodies[numbers[part]];
				std::map<int, int> own;
				to.vertices.clear(), to.initialVertices.clear(), to.pieces.clear();
				for (size_t i = 0; i < from.pieces.size(); ++i) {
					if (partOfPiece[i] != int(part)) continue;
					to.pieces.push_back(from.pieces[i]);
					for (int& v : to.pieces.back()) {
						const auto [known, isNew] = own.emplace(v, int(to.vertices.size()));
						if (isNew) to.vertices.push_back(from.vertices[v]);
						if (isNew && !from.initialVertices.empty()) to.initialVertices.push_back(from.initialVertices[v]);
						v = known->second;
					}
				}
			}
		}

		// Makes the surface of a part from the domains of its points.
		void drawAnew(int number, const vector<int>& part)
		{
			constexpr Real spacing = Dim == 2 ? 0.25 : 0.5; // [cells]
			Boxes<Dim>     own;
			for (const int i : part)
				own.push_back(boxes[i]);
			const auto surface = gimpm::outline<Dim>(own, grid.origin.template head<Dim>(), spacing * grid.smallestCell());
			MpmBody&   to      = *grid.bodies[number];
			to.vertices.clear(), to.pieces.clear();
			for (const auto& x : surface.vertices) {
				to.vertices.emplace_back(0, 0, Dim == 2 ? grid.origin[2] : 0);
				to.vertices.back().template head<Dim>() = x;
			}
			for (const auto& piece : surface.pieces)
				to.pieces.emplace_back(piece.begin(), piece.end());
			to.initialVertices = to.vertices;
		}

		MpmGrid&                            grid;
		const int                           body;
		const vector<const MaterialPoint*>& points;
		Boxes<Dim>                          boxes;
		vector<int>                         numbers {}; // of the bodies that the parts become
	};

	vector<shared_ptr<MpmBodyContact>> contactsOf(const Analysis& analysis)
	{
		vector<shared_ptr<MpmBodyContact>> contacts;
		for (const Listed& listed : analysis.conditions())
			if (const auto contact = boost::dynamic_pointer_cast<MpmBodyContact>(listed.condition)) contacts.push_back(contact);
		return contacts;
	}

	// Parts of a body by their numbers, with their points.
	std::map<int, vector<const MaterialPoint*>> partsToTear(const string& body, const MpmGrid& grid, const vector<MaterialPoint>& points)
	{
		std::map<int, vector<const MaterialPoint*>> parts;
		for (const int part : partsOf(grid, body))
			parts[part] = {};
		for (const MaterialPoint& point : points)
			if (const auto found = parts.find(point.state->body); found != parts.end()) found->second.push_back(&point);
		return parts;
	}

	template <int Dim>
	string tearIn(const string& name, MpmGrid& grid, const vector<shared_ptr<MpmBodyContact>>& contacts, const vector<MaterialPoint>& points)
	{
		constexpr int least = 1 << Dim; // points of a part that gets a body
		string        doubt;
		for (const auto& [body, own] : partsToTear(name, grid, points)) {
			Torn<Dim> torn(grid, body, own);
			auto      parts = torn.parts(least);
			const int room  = gimpm::Grid<Dim>::mostLayer - int(grid.bodies.size());
			if (int(parts.size()) - 1 > room) {
				doubt = gimpm::sentence(
				        "body '", name, "' falls into more parts than the ", gimpm::Grid<Dim>::mostLayer,
				        " bodies that can be in contact: those beyond stick where they share cells.");
				parts.resize(std::max(0, room) + 1);
			}
			if (parts.size() > 1) torn.tear(parts, contacts);
		}
		return doubt;
	}
}

string tear(const string& body, const Analysis& analysis, const vector<MaterialPoint>& points)
{
	MpmGrid& grid = *analysis.grid;
	return grid.dim == 3 ? tearIn<3>(body, grid, contactsOf(analysis), points) : tearIn<2>(body, grid, contactsOf(analysis), points);
}

} // namespace yade
