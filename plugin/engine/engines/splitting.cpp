// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/splitting.hpp"
#include "core/grid/basis.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"
#include "engine/parallel/pieces.hpp"
#include "engine/points/fitted_domain.hpp"
#include "engine/points/split_point.hpp"
#include "yade_api/bodies.hpp"

namespace yade {

namespace {
	struct Splits {
		int        left      = 0;  // points whose domain is kept at half a cell
		Body::id_t exhausted = -1; // the first of them that has been split as often as is admitted
	};

	// True if cells that are halved are to have as many points as before. Beside edges of bodies larger domains
	// give a resistance that is nearer to the exact one.
	bool arePointsOfCells(const MpmGrid& grid)
	{
		return std::any_of(grid.adaptation.begin(), grid.adaptation.end(), [](const auto& rule) { return !(rule->where == "contact"); });
	}

	template <int Dim> class Outgrown {
	public:
		Outgrown(vector<MaterialPoint>& points, Job<Dim>& job, Scene& scene, int most, bool followsCells)
		        : points(points), job(job), scene(scene), most(most), followsCells(followsCells)
		{
		}

		Splits splitAll()
		{
			size_t p = 0;
			do { // again for the new points, which have their ids then
				for (const size_t end = points.size(); p < end; ++p)
					while (splitOnce(p)) { }
			} while (insertHalves());
			if (points.size() > job.cloud.size()) updateCloud();
			countAll(*job.model.division);
			return result;
		}

	private:
		bool splitOnce(size_t p)
		{
			const MaterialPoint& point = points[p];
			const Real           limit = limitOf(point);
			if (isTooFew(point, limit)) {
				const int axis = longestEdge(point);
				if (axis >= 0) return split(p, axis);
			}
			if (point.shape->halfSize.template head<Dim>().maxCoeff() < limit * (1 - gimpm::overlapTolerance)) return false;
			const Vector3r size = grownDomain(point, job.model.grid, job.model.domains);
			if (size.template head<Dim>().maxCoeff() <= margin * limit) return false;
			const int axis = point.state->splits < mostOf(point) ? axisOf(point, size) : -1;
			if (axis >= 0) return split(p, axis);
			++result.left;
			if (most > 0 && point.state->splits >= mostOf(point) && result.exhausted < 0) result.exhausted = point.id;
			return false;
		}

		// The initial edge that goes farthest along the axis on which the domain is longest, of those across
		// which the point can be split; none: -1.
		int axisOf(const MaterialPoint& point, const Vector3r& size) const
		{
			int longest = 0, best = -1;
			size.template head<Dim>().maxCoeff(&longest);
			Real most = 0;
			for (int a = 0; a < Dim; ++a) {
				const Real along = std::abs(point.state->defGrad(longest, a)) * point.shape->halfSize0[a];
				if (along > most && isFree(point, a)) best = a, most = along;
			}
			return best;
		}

		// True if its cell has been halved so often that less than two points along each axis are left.
		// `limit`: half of the smallest cell that the domain touches.
		bool isTooFew(const MaterialPoint& point, Real limit) const
		{
			if (!followsCells) return false;
			const Real section = initialSection<Dim>(point.shape->halfSize0);
			const auto cell    = [&] { return 2 * gimpm::largestHalf<Dim>(job.model.grid, point.state->pos.template head<Dim>()); };
			return !holdsTwo<Dim>(2 * limit, section) && !holdsTwo<Dim>(cell(), section);
		}

		// The longest edge across which the point can be split; none: -1.
		int longestEdge(const MaterialPoint& point) const
		{
			int  best = -1;
			Real most = 0;
			for (int a = 0; a < Dim; ++a)
				if (const Real length = 2 * toUpperHalf(point, a).norm(); length > most && isFree(point, a)) best = a, most = length;
			return best;
		}

		bool isFree(const MaterialPoint& point, int axis) const
		{
			const gimpm::Vec<Dim> middle = point.state->pos.template head<Dim>(), offset = toUpperHalf(point, axis).head<Dim>();
			// Strongly stretched domains, which a body has kept from being split until it has passed, stay
			// whole. Their gradient is not that of the soil more than a cell away, and halves there would
			// be soil that has jumped.
			if (offset.norm() > 2 * limitOf(point) && isSlender(point, offset.norm())) return false;
			const auto& layers = job.model.layers;
			const int   layer  = layers.empty() ? 0 : layers[point.state->body + 1];
			return isFree(middle, middle + offset, layer) && isFree(middle, middle - offset, layer);
		}

		// True if four times the offset, the length of an edge, is more than twice the size of the domain.
		bool isSlender(const MaterialPoint& point, Real offset) const
		{
			const Real grown = point.state->defGrad.template topLeftCorner<Dim, Dim>().determinant();
			return 2 * offset > std::pow(grown * initialSection<Dim>(point.shape->halfSize0), 1. / Dim);
		}

		// No wall on the grid's lines, axis of symmetry or condition comes between the middles of the whole and
		// of a half.
		bool isFree(const gimpm::Vec<Dim>& from, const gimpm::Vec<Dim>& to, int layer) const
		{
			using namespace gimpm;
			const auto& grid   = job.model.grid;
			const auto  cellAt = [&](const Vec<Dim>& x, int a) { return centreCell(x[a] - grid.origin[a], grid.cellSize); };
			Index<Dim>  cell;
			for (int a = 0; a < Dim; ++a)
				cell[a] = cellAt(from, a);
			for (int a = 0; a < Dim; ++a) {
				const auto [first, last] = std::minmax({ cell[a], cellAt(to, a) });
				Index<Dim> face          = cell;
				for (face[a] = first + 1; face[a] <= last; ++face[a])
					if (job.model.boundary.lowerFaceIsWall(face, a, 0, layer)) return false;
			}
			return std::all_of(job.conditions.begin(), job.conditions.end(), [&](const auto& one) { return one->areBeside(from, to); });
		}

		bool split(size_t p, int axis)
		{
			const MaterialPoint whole   = points[p];
			const auto          numbers = [](const Vector3r& v) { return std::array<Real, 3> { v[0], v[1], v[2] }; };
			const auto          middle = numbers(whole.state->pos), halfSize = numbers(whole.shape->halfSize);
			const auto          upper = halfOf(whole, axis);
			if (!upper) return false;
			const Body::id_t none  = -1; // yet
			const auto       shape = boost::static_pointer_cast<MpmPoint>(upper->shape);
			const auto       state = boost::static_pointer_cast<MpmState>(upper->state);
			points.push_back({ none, shape, state, whole.material });
			halves.push_back({ upper, { whole.id, none, axis, Dim, middle, halfSize } });
			for (const MaterialPoint& half : { whole, points.back() })
				settle(half);
			return true;
		}

		// Null: a script has erased it meanwhile.
		shared_ptr<Body> halfOf(const MaterialPoint& whole, int axis) const
		{
			const BodiesLock lock(scene);
			return scene.bodies->exists(whole.id) ? halve(*(*scene.bodies)[whole.id], whole, axis, isRing()) : nullptr;
		}

		// The upper halves, behind the other bodies, in the order of their wholes, whichever process has them.
		// False: there are none.
		bool insertHalves()
		{
			auto&          division = *job.model.division;
			const auto     wholes   = wholesOfAll();
			const size_t   end      = scene.bodies->size() + wholes.size();
			size_t         place    = 0;
			MaterialPoint* point    = points.data() + points.size() - halves.size();
			for (size_t i = 0; i < halves.size(); ++i, ++point) {
				auto& [body, domain] = halves[i];
				place                = i > 0 && domain.lower == halves[i - 1].second.lower ? place + 1 : firstOf(wholes, domain.lower);
				domain.upper         = scene.bodies->insertAtId(body, Body::id_t(end - wholes.size() + place));
				point->id            = domain.upper;
				division.append(domain.upper);
			}
			shareMemory();
			halves.clear();
			provideGaps(scene, end);
			return !wholes.empty();
		}

		// Shares the memory of conditions about the points of all processes, which each of them knows.
		void shareMemory() const
		{
			const auto remembers = [](const auto& condition) { return condition->remembersPoints(); };
			if (std::none_of(job.conditions.begin(), job.conditions.end(), remembers)) return;
			vector<HalvedDomain> domains;
			for (const auto& [body, domain] : halves)
				domains.push_back(domain);
			domains = job.model.division->joined(std::move(domains));
			std::sort(domains.begin(), domains.end(), [](const auto& a, const auto& b) { return a.upper < b.upper; });
			for (const HalvedDomain& domain : domains)
				for (const auto& condition : job.conditions)
					condition->share(domain);
		}

		// One for each upper half, rising.
		vector<int64_t> wholesOfAll() const
		{
			vector<int64_t> wholes;
			for (const auto& [body, domain] : halves)
				wholes.push_back(domain.lower);
			wholes = job.model.division->joined(std::move(wholes));
			std::sort(wholes.begin(), wholes.end());
			return wholes;
		}

		static size_t firstOf(const vector<int64_t>& wholes, int64_t whole)
		{
			return std::lower_bound(wholes.begin(), wholes.end(), whole) - wholes.begin();
		}

		// Counts for the points of all processes.
		void countAll(const gimpm::Division& division)
		{
			constexpr int64_t none  = std::numeric_limits<int64_t>::max();
			int64_t           first = result.exhausted < 0 ? none : result.exhausted;
			division.smallest(&first, 1);
			result.exhausted = first == none ? -1 : Body::id_t(first);
			result.left      = int(division.sum(result.left));
		}

		// On the grid: in its period, and with the domain that a step would give it.
		void settle(const MaterialPoint& half) const
		{
			const PointWriter writer;
			MpmState&         state = writer.state(half);
			for (int a = 0; a < Dim; ++a)
				state.refPos[a] -= reenter(state.pos[a], a, job.model.grid);
			fitDomain(half, job.model.grid, job.model.domains);
			writer.shape(half).radius *= std::pow(0.5, 1. / Dim);
		}

		void updateCloud()
		{
			job.cloud.resize(points.size());
			for (size_t p = 0; p < points.size(); ++p) {
				job.cloud.position[p] = points[p].state->pos.template head<Dim>();
				job.cloud.halfSize[p] = points[p].shape->halfSize.template head<Dim>();
			}
		}

		int levelOf(const MaterialPoint& point) const
		{
			return gimpm::levelTouched<Dim>(job.model.grid, point.state->pos.template head<Dim>(), point.shape->halfSize.template head<Dim>());
		}

		// Half of the smallest cell that the domain touches.
		Real limitOf(const MaterialPoint& point) const { return 0.5 * job.model.grid.size(levelOf(point)); }

		// For each halving of the cells it may be split once more along each axis.
		int mostOf(const MaterialPoint& point) const
		{
			return job.model.grid.refinement ? most + Dim * (job.model.grid.refinement->largest() - levelOf(point)) : most;
		}

		bool isRing() const { return job.model.grid.axisymmetric; }

		// One point a cell has a domain of the limit from the beginning, which lateral strains, or round-off,
		// would split.
		static constexpr Real margin = 1.01;

		vector<MaterialPoint>& points;
		Job<Dim>&              job;
		Scene&                 scene;
		int                    most;
		bool                   followsCells;
		Splits                 result;

		vector<std::pair<shared_ptr<Body>, HalvedDomain>> halves; // the upper ones, which have no ids yet
	};
}

template <int Dim> string Splitting::split(MpmImplicitEngine& engine, vector<MaterialPoint>& points, Job<Dim>& job)
{
	const Splits splits   = Outgrown<Dim>(points, job, *engine.scene, engine.maxSplits, arePointsOfCells(*engine.grid)).splitAll();
	engine.clampedDomains = splits.left;
	Pieces::note(*engine.scene, *job.model.division->processes);
	if (splits.exhausted < 0 || isSaid) return "";
	isSaid = true;
	return "Body #" + std::to_string(splits.exhausted) + ": the domain of the material point has outgrown half a cell again, after maxSplits = "
	        + std::to_string(engine.maxSplits) + " halvings; it is kept at half a cell. This is said once; clampedDomains counts such points.";
}

template string Splitting::split(MpmImplicitEngine&, vector<MaterialPoint>&, Job<2>&);
template string Splitting::split(MpmImplicitEngine&, vector<MaterialPoint>&, Job<3>&);

} // namespace yade
