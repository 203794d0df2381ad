// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/merging.hpp"
#include "engine/analysis/MpmCondition.hpp"
#include "engine/materials/own_materials.hpp"
#include "engine/points/energies.hpp"
#include "engine/points/fitted_domain.hpp"
#include "engine/points/unite_halves.hpp"
#include <algorithm>

namespace yade {

namespace {
	constexpr Real mostEnergy = 1e-4; // of what is stored, in one step

	// Halves by the points that they were split off from. They become one in the reverse order.
	class Family {
	public:
		explicit Family(const vector<MaterialPoint>& points) : latest(points.size(), -1), former(points.size(), -1), parent(points.size(), -1)
		{
			for (size_t p = 0; p < points.size(); ++p) {
				const auto of = std::lower_bound(points.begin(), points.end(), points[p].state->parent, [](const MaterialPoint& point, int id) {
					return point.id < id;
				});
				if (points[p].state->parent < 0 || of == points.end() || of->id != points[p].state->parent) continue;
				parent[p] = int(of - points.begin());
				former[p] = std::exchange(latest[parent[p]], int(p));
			}
		}

		// The lower half of an upper one that itself has been split no more, and was split off last; else -1.
		int lowerOf(int upper) const { return parent[upper] >= 0 && latest[parent[upper]] == upper && latest[upper] < 0 ? parent[upper] : -1; }

		void erase(int upper) { latest[parent[upper]] = former[upper], parent[upper] = -1; }

	private:
		vector<int> latest, former, parent;
	};

	struct Pair {
		int          lower, upper;
		UnitedHalves whole;
		Real         lost; // [J]
	};

	template <int Dim> class Merging {
	public:
		Merging(const Analysis& analysis, const vector<MaterialPoint>& points)
		        : points(points)
		        , grid(analysis.grid->lattice<Dim>())
		        , domains(analysis.domainRule())
		        , family(points)
		        , left(mostEnergy * energiesOf(points).total())
		{
		}

		// Merges in rounds: a whole may be a half of another one.
		void mergeAll()
		{
			while (mergePairs(pairs())) { }
		}

		vector<Body::id_t> erased;
		Real               lost = 0; // [J]

	private:
		vector<Pair> pairs()
		{
			vector<Pair> all;
			for (int upper = 0; upper < int(points.size()); ++upper) {
				const int lower = family.lowerOf(upper);
				if (lower < 0 || !isInLargeCell(points[lower]) || points[lower].state->splits != points[upper].state->splits) continue;
				const auto& material = materials.of(*points[lower].material, points[lower].state->parameters);
				const auto  whole    = UnitedHalves::of(points[lower], points[upper], material, Dim);
				if (whole && hasRoom(*whole))
					all.push_back({ lower, upper, *whole, std::max(whole->lostEnergy(points[lower], points[upper]), 0.) });
			}
			std::stable_sort(all.begin(), all.end(), [](const Pair& a, const Pair& b) { return a.lost < b.lost; });
			return all;
		}

		// True if two like this are not too large for the cell.
		bool isInLargeCell(const MaterialPoint& half) const
		{
			const Real size = 2 * gimpm::largestHalf<Dim>(grid, half.state->pos.template head<Dim>());
			return holdsTwo<Dim>(size, 2 * initialSection<Dim>(half.shape->halfSize0));
		}

		// True if the whole is not too large for the cells that it, and half of it around, touches.
		bool hasRoom(const UnitedHalves& whole) const
		{
			const Vector3r half = stretched<Dim>(whole.halfSize0, whole.defGrad, domains);
			const Real     size = grid.size(gimpm::levelTouched<Dim>(grid, whole.centre.template head<Dim>(), 2 * half.head<Dim>()));
			return holdsTwo<Dim>(size, initialSection<Dim>(whole.halfSize0)) && half.head<Dim>().maxCoeff() <= size / 2;
		}

		bool mergePairs(const vector<Pair>& all)
		{
			const size_t before = erased.size();
			for (const auto& [lower, upper, whole, energy] : all) {
				if (energy > left) break;
				left -= energy, lost += energy;
				whole.assignTo(points[lower], points[upper]);
				fitDomain(points[lower], grid, domains);
				family.erase(upper);
				erased.push_back(points[upper].id);
			}
			return erased.size() > before;
		}

		const vector<MaterialPoint>& points;
		gimpm::Grid<Dim>             grid;
		gimpm::DomainRule            domains;
		Family                       family;
		OwnMaterials                 materials;
		Real                         left; // [J]
	};

	template <int Dim> bool remembersPoints(const Analysis& analysis)
	{
		const auto all = conditionsOf<Dim>(analysis);
		return std::any_of(all.begin(), all.end(), [](const auto& condition) { return condition->remembersPoints(); });
	}

	template <int Dim> Real merge(const Analysis& analysis, Scene& scene, vector<MaterialPoint>& points)
	{
		Merging<Dim> merging(analysis, points);
		merging.mergeAll();
		std::sort(merging.erased.begin(), merging.erased.end());
		for (const Body::id_t id : merging.erased)
			scene.bodies->erase(id, false);
		const auto isErased = [&](const MaterialPoint& point) { return std::binary_search(merging.erased.begin(), merging.erased.end(), point.id); };
		points.erase(std::remove_if(points.begin(), points.end(), isErased), points.end());
		return merging.lost;
	}
}

Real mergeHalves(const Analysis& analysis, Scene& scene, vector<MaterialPoint>& points)
{
	const auto& rules    = analysis.grid->adaptation;
	const bool  isWanted = std::any_of(rules.begin(), rules.end(), [](const auto& rule) { return rule->merge; });
	const bool  areSplit = std::any_of(points.begin(), points.end(), [](const MaterialPoint& point) { return point.state->splits > 0; });
	if (!isWanted || !areSplit) return 0;
	const bool isPlane = analysis.grid->dim == 2;
	if (isPlane ? remembersPoints<2>(analysis) : remembersPoints<3>(analysis)) return 0;
	return isPlane ? merge<2>(analysis, scene, points) : merge<3>(analysis, scene, points);
}

} // namespace yade
