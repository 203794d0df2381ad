// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/cell_sizes.hpp"
#include "core/base/sentence.hpp"
#include "engine/analysis/MpmCondition.hpp"
#include "engine/analysis/exchange.hpp"
#include "yade_api/scene.hpp"
#include "yade_api/value_lock.hpp"
#include <set>

namespace yade {

namespace {
	// Question to a function for the size of cells, at the centres of the smallest ones that hold points or corners
	// of their domains.
	template <int Dim> class SizeQuestion : public Question {
	public:
		SizeQuestion(const shared_ptr<MpmAdaptation>& adaptation, const MpmGrid& grid, const vector<MaterialPoint>& points, const string& name)
		        : adaptation(adaptation)
		        , function(adaptation->where.size)
		        , name(name)
		        , halvings(adaptation->halvings)
		        , cellSize(grid.cellSize)
		        , origin(grid.origin)
		{
			const auto smallest = cells(halvings);
			for (const auto& [id, shape, state, material] : points)
				if (isOnGrid(state->pos, smallest)) addCells(state->pos, shape->halfSize, smallest);
			for (const gimpm::Key key : keys)
				places.push_back(centre(key, smallest));
		}

		void ask() override
		{
			sizes = evaluate(function, places, name, { "the size of cells [m] > 0", [](Real size) { return size > 0; } });
		}

		void store() const override
		{
			constexpr Real roundOff = 1e-9;
			adaptation->wanted.assign(halvings, {});
			for (int h = 0; h < halvings; ++h) {
				const auto           larger = cells(h);
				std::set<gimpm::Key> halved;
				for (size_t i = 0; i < places.size(); ++i)
					if (larger.cellSize > (1 + roundOff) * sizes[i]) halved.insert(gimpm::Grid<Dim>::key(cellAt(places[i], larger)));
				for (const gimpm::Key key : halved)
					adaptation->wanted[h].push_back(centre(key, larger));
			}
		}

	private:
		shared_ptr<MpmAdaptation> adaptation;
		PythonFunction            function;
		string                    name;
		int                       halvings;
		Real                      cellSize;
		Vector3r                  origin;
		std::set<gimpm::Key>      keys {};
		vector<Vector3r>          places {};
		vector<Real>              sizes {};

		void addCells(const Vector3r& middle, const Vector3r& half, const gimpm::Grid<Dim>& grid)
		{
			constexpr Real within = 1 - 1e-9;
			keys.insert(gimpm::Grid<Dim>::key(cellAt(middle, grid)));
			for (int corner = 0; corner < 1 << Dim; ++corner) {
				Vector3r place = middle;
				for (int a = 0; a < Dim; ++a)
					place[a] += (corner >> a & 1 ? within : -within) * half[a];
				keys.insert(gimpm::Grid<Dim>::key(cellAt(place, grid)));
			}
		}

		static gimpm::Index<Dim> cellAt(const Vector3r& place, const gimpm::Grid<Dim>& grid)
		{
			return ((place.template head<Dim>() - grid.origin) / grid.cellSize).array().floor().template cast<int>().matrix();
		}
		gimpm::Grid<Dim> cells(int halved) const { return { cellSize / (1 << halved), origin.head<Dim>() }; }
		Vector3r         centre(gimpm::Key key, const gimpm::Grid<Dim>& grid) const
		{
			Vector3r place             = Vector3r(0, 0, origin[2]);
			place.template head<Dim>() = grid.nodePosition(gimpm::Grid<Dim>::index(key)) + gimpm::Vec<Dim>::Constant(grid.cellSize / 2);
			return place;
		}
	};
}

void askSizes(const Analysis& analysis, const Scene& scene, int mask)
{
	vector<std::unique_ptr<Question>> questions;
	{
		const ValueLock lock;
		if (!analysis.grid) return;
		const MpmGrid& grid    = *analysis.grid;
		const auto&    rules   = grid.adaptation;
		const auto     mustAsk = [](const auto& rule) { return rule && rule->where == AdaptationRule::byFunction; };
		if (std::none_of(rules.begin(), rules.end(), mustAsk)) return;
		grid.requireAdmissible();
		const auto points = materialPoints(scene, mask);
		for (size_t a = 0; a < rules.size(); ++a) {
			if (!mustAsk(rules[a])) continue;
			const string name = gimpm::sentence("MpmGrid.adaptation[", a, "].where");
			if (grid.dim == 2) questions.push_back(std::make_unique<SizeQuestion<2>>(rules[a], grid, points, name));
			else
				questions.push_back(std::make_unique<SizeQuestion<3>>(rules[a], grid, points, name));
		}
	}
	for (const auto& question : questions)
		question->ask();
	const ValueLock lock;
	for (const auto& question : questions)
		question->store();
}

} // namespace yade
