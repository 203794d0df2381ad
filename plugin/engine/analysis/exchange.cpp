// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/exchange.hpp"
#include "core/materials/kinematics.hpp"
#include "engine/grid/fit.hpp"
#include "engine/materials/laws.hpp"
#include "engine/points/parallel.hpp"
#include <atomic>
#include <tuple>
#include <unordered_map>

namespace yade {

namespace {
	// Domain of the basis 'gimp', limited to half a cell as at the end of a step.
	template <int Dim> gimpm::Vec<Dim> domainIn(const gimpm::Model<Dim>& model, const gimpm::Vec<Dim>& position, const gimpm::Vec<Dim>& half)
	{
		return model.basis == gimpm::Basis::gimp ? gimpm::Vec<Dim>(half.cwiseMin(gimpm::largestHalf<Dim>(model.grid, position))) : half;
	}

	// Position in the model's list of materials, which grows by each material on its first point.
	class MaterialIndex {
	public:
		// `known`: those that the list begins with.
		MaterialIndex(std::vector<gimpm::Material>& list, std::vector<double>& shares, const MaterialList& known) : list(list), shares(shares)
		{
			for (const MpmMaterial* material : known) {
				index.emplace(material, int(list.size()));
				add(*material);
			}
		}
		int of(const MaterialPoint& point)
		{
			if (point.material.get() == last) return lastIndex;
			last             = point.material.get();
			return lastIndex = find(point);
		}

	private:
		void add(const MpmMaterial& material)
		{
			list.push_back(coreMaterial(material));
			shares.push_back(material.share);
		}
		int find(const MaterialPoint& point)
		{
			const auto [found, isNew] = index.try_emplace(point.material.get(), int(list.size()));
			if (isNew) try {
					add(*point.material);
				} catch (const std::invalid_argument& error) {
					throw std::invalid_argument("Body #" + std::to_string(point.id) + ": " + error.what());
				}
			return found->second;
		}

		// Points of one material follow each other.
		const MpmMaterial*                          last      = nullptr;
		int                                         lastIndex = 0;
		std::vector<gimpm::Material>&               list;
		std::vector<double>&                        shares;
		std::unordered_map<const MpmMaterial*, int> index;
	};

	// Makes the columns of parameters that points have of their own, in whatever process they are, and marks their
	// materials.
	template <int Dim> void provideParameters(const vector<MaterialPoint>& points, gimpm::Model<Dim>& model, gimpm::PointCloud<Dim>& cloud)
	{
		std::atomic_bool haveAny { false };
		inRanges(points.size(), [&](size_t begin, size_t end) {
			for (size_t p = begin; p < end && !haveAny; ++p)
				if (!points[p].state->parameters.empty()) haveAny = true;
		});
		// Flags by the number of a material, and of a parameter of a class.
		vector<int64_t> isAlike(model.materials.size(), 1), isUnused(allParameters().size(), 1);
		for (size_t p = 0; haveAny && p < points.size(); ++p) {
			if (points[p].state->parameters.empty()) continue;
			const auto& known = parametersOf(*points[p].material);
			for (size_t k = 0; k < known.size(); ++k)
				if (points[p].state->parameter(known[k].name)) isUnused[k] = isAlike[cloud.material[p]] = 0;
		}
		for (auto* flags : { &isAlike, &isUnused })
			model.division->smallest(flags->data(), flags->size());
		for (size_t m = 0; m < isAlike.size(); ++m)
			if (!isAlike[m]) model.materials[m].varies = true;
		for (size_t k = 0; k < isUnused.size(); ++k)
			if (!isUnused[k]) {
				cloud.parameters.resize(std::max(cloud.parameters.size(), k + 1));
				cloud.parameters[k].assign(points.size(), 0);
			}
	}

	// Takes the parameters of point p, the columns of which are there.
	template <int Dim>
	void gatherParameters(const MaterialPoint& point, const gimpm::Law& law, OwnMaterial& ownMaterial, gimpm::PointCloud<Dim>& cloud, size_t p)
	{
		try {
			const MpmMaterial& material = ownMaterial.of(*point.material, point.state->parameters);
			auto               values   = gimpm::parametersOf(law);
			for (const ParameterOfClass& known : parametersOf(material))
				values[&known - parametersOf(material).data()] = known.valueIn(material);
			for (size_t k = 0; k < std::min(values.size(), cloud.parameters.size()); ++k)
				if (!cloud.parameters[k].empty()) cloud.parameters[k][p] = values[k];
		} catch (const std::invalid_argument& error) {
			throw std::invalid_argument("Body #" + std::to_string(point.id) + ": " + error.what());
		}
	}

	// Names and columns of the variables that points of this material have.
	template <int Dim> vector<std::pair<std::string_view, const Real*>> internalsFor(const MpmMaterial& material, const gimpm::PointCloud<Dim>& cloud)
	{
		vector<std::pair<std::string_view, const Real*>> found;
		for (const auto& [variable, first] : initialInternalsOf(material))
			found.emplace_back(variable->name, cloud.internals[gimpm::internalVariables.find(variable->name)].data());
		return found;
	}

	// Along the circle around the axis of symmetry: half of its length is the half size.
	void scatterAround(MpmState& state, MpmPoint& shape, Real stretch)
	{
		state.defGrad(2, 2) = stretch;
		shape.halfSize[2]   = shape.halfSize0[2] * stretch;
	}

	// Takes the internal variables of point p; its column is there.
	template <int Dim> void gatherInternals(const MaterialPoint& point, const gimpm::Law& law, gimpm::PointCloud<Dim>& cloud, size_t p)
	{
		point.requireInternals(law);
		for (size_t k = 0; k < law->columns.size(); ++k)
			cloud.internals[law->columns[k]][p] = point.internalOf(law, k);
	}

	// Component by component: a matrix that is made first and copied then takes far longer.
	template <int Dim> void setFull(Matrix3r& m, const gimpm::SymTensor<Dim>& tensor)
	{
		const auto& c = tensor.c;
		m(0, 0) = c[0], m(1, 1) = c[1];
		if constexpr (Dim == 2) {
			m(0, 1) = m(1, 0) = c[2], m(2, 2) = c[3];
			m(0, 2) = m(2, 0) = m(1, 2) = m(2, 1) = 0;
		} else {
			m(2, 2) = c[2];
			m(0, 1) = m(1, 0) = c[3], m(1, 2) = m(2, 1) = c[4], m(2, 0) = m(0, 2) = c[5];
		}
	}

	template <int Dim> gimpm::Vec<Dim> domainIn(const gimpm::Model<Dim>& model, const MaterialPoint& point)
	{
		return domainIn<Dim>(model, point.state->pos.template head<Dim>(), point.shape->halfSize.template head<Dim>());
	}

	// Value of a column of the core for a point in YADE: take(point, model) is its value, give(state, shape, value)
	// puts what a step has made of it back.
	template <class Cloud, class Values, class Take, class Give> struct Exchanged {
		Values Cloud::*of;
		Take           take;
		Give           give;
	};
	template <class Cloud, class Values, class Take, class Give> constexpr auto exchanged(Values Cloud::*of, Take take, Give give)
	{
		return Exchanged<Cloud, Values, Take, Give> { of, take, give };
	}

	struct Elsewhere { };
	constexpr auto stays = [](MpmState&, MpmPoint&, const auto&) {}; // the value in YADE stays

	// Columns that depend on materials and laws, which are gone through one after the other.
	template <class Cloud, class Values> constexpr auto byMaterial(Values Cloud::*of) { return exchanged(of, Elsewhere(), Elsewhere()); }

	template <int Dim> constexpr auto pointLoad()
	{
		const auto take = [](const MaterialPoint& p, const gimpm::Model<Dim>&) {
			return gimpm::Vec<Dim>(p.material->share * p.state->force.template head<Dim>());
		};
		return exchanged(&gimpm::PointCloud<Dim>::force, take, stays);
	}

	// All columns of the core: a new one does not compile until it is here. Plane strain leaves the components out
	// of the plane alone, but for the zz component of strain and stress; axisymmetry has that of the deformation
	// too.
	template <int Dim> constexpr auto exchange()
	{
		using C      = gimpm::PointCloud<Dim>;
		using Point  = const MaterialPoint&;
		using Model  = const gimpm::Model<Dim>&;
		using Vector = gimpm::Vec<Dim>;
		using Tensor = gimpm::SymTensor<Dim>;
		return std::make_tuple(
		        exchanged(
		                &C::position, [](Point p, Model) { return p.state->pos.template head<Dim>(); },
		                [](MpmState& s, MpmPoint&, const Vector& x) { s.pos.template head<Dim>() = x; }),
		        exchanged(
		                &C::position0, [](Point p, Model) { return p.state->refPos.template head<Dim>(); }, stays),
		        exchanged(
		                &C::halfSize, [](Point p, Model model) { return domainIn(model, p); },
		                [](MpmState&, MpmPoint& p, const Vector& x) { p.halfSize.template head<Dim>() = x; }),
		        exchanged(
		                &C::halfSize0, [](Point p, Model) { return p.shape->halfSize0.template head<Dim>(); }, stays),
		        exchanged(
		                &C::volume0, [](Point p, Model) { return p.state->volume0; }, stays),
		        exchanged(
		                &C::defGrad, [](Point p, Model) { return p.state->defGrad.template topLeftCorner<Dim, Dim>(); },
		                [](MpmState& s, MpmPoint&, const gimpm::Mat<Dim>& F) { s.defGrad.template topLeftCorner<Dim, Dim>() = F; }),
		        exchanged(
		                &C::hoopStretch, [](Point p, Model) { return p.state->defGrad(2, 2); }, &scatterAround),
		        exchanged(
		                &C::elasticStrain, [](Point p, Model) { return Tensor::from(p.state->elasticStrain); },
		                [](MpmState& s, MpmPoint&, const Tensor& e) { setFull(s.elasticStrain, e); }),
		        exchanged(
		                &C::stress, [](Point p, Model) { return Tensor::from(p.state->stress); },
		                [](MpmState& s, MpmPoint&, const Tensor& stress) { setFull(s.stress, stress); }),
		        exchanged(
		                &C::excessPressure, [](Point p, Model) { return p.state->excessPressure; },
		                [](MpmState& s, MpmPoint&, Real pressure) { s.excessPressure = pressure; }),
		        pointLoad<Dim>(),
		        exchanged(
		                &C::layer, [](Point p, Model model) { return model.layers[p.state->body + 1]; }, stays),
		        byMaterial(&C::material), byMaterial(&C::internals), byMaterial(&C::parameters));
	}

	template <class... Cloud, class... Values, class... Take, class... Give>
	constexpr size_t sizeOf(const std::tuple<Exchanged<Cloud, Values, Take, Give>...>*)
	{
		return (sizeof(Values) + ...);
	}
	template <int Dim> constexpr bool areAllExchanged = sizeOf(static_cast<decltype(exchange<Dim>())*>(nullptr)) == sizeof(gimpm::PointCloud<Dim>);
	static_assert(areAllExchanged<2> && areAllExchanged<3>, "exchange() has to name each column of PointCloud, once");

	// Calls f(column of the cloud, its row of the table) for the columns that there are.
	template <int Dim, class F> void forExchanged(gimpm::PointCloud<Dim>& cloud, F&& f)
	{
		static constexpr auto rows  = exchange<Dim>(); // made by the compiler, not for each point
		const auto            visit = [&](const auto& row) {
                        if constexpr (!std::is_same_v<decltype(row.take), Elsewhere>)
                                if (!(cloud.*row.of).empty()) f(cloud.*row.of, row);
		};
		std::apply([&](const auto&... row) { (visit(row), ...); }, rows);
	}

	template <int Dim> bool hasMovingBox(const gimpm::Boundary<Dim>& boundary)
	{
		const auto& boxes = boundary.boxes();
		return std::any_of(boxes.begin(), boxes.end(), [](const auto& box) { return !box.displacement.isZero(0); });
	}

	template <int Dim>
	void reenterAll(gimpm::PointCloud<Dim>& cloud, const gimpm::Grid<Dim>& grid, const vector<MaterialPoint>& points, const PointWriter& writer)
	{
		for (int a = 0; a < Dim; ++a)
			for (size_t p = 0; grid.period[a] > 0 && p < points.size(); ++p) {
				const Real shift = reenter(cloud.position[p][a], a, grid);
				writer.state(points[p]).refPos[a] -= shift;
				if (!cloud.position0.empty()) cloud.position0[p][a] -= shift;
			}
	}
}

template <int Dim> Real reenter(Real& x, int axis, const gimpm::Grid<Dim>& grid)
{
	const Real length = grid.period[axis] * grid.cellSize, low = grid.origin[axis], high = low + length;
	if (length == 0 || (x >= low && x < high)) return 0;
	const Real shift = length * std::floor((x - low) / length);
	x                = std::clamp(x - shift, low, high); // round-off
	return shift;
}

void requireBody(int body, int count, const string& where)
{
	if (body < count) return;
	throw std::invalid_argument(
	        where + ": MpmState.body = " + std::to_string(body) + ", and MpmGrid.bodies has " + std::to_string(count)
	        + " bodies of points: the engine needs the grid that mpm.fill was given.");
}

template <int Dim> gimpm::PointCloud<Dim> centresOnGrid(const vector<MaterialPoint>& points, const gimpm::Grid<Dim>& grid)
{
	gimpm::PointCloud<Dim> centres;
	for (const MaterialPoint& point : points)
		if (isOnGrid(point.state->pos, grid)) centres.position.push_back(point.state->pos.head<Dim>());
	return centres;
}

template <int Dim> vector<gimpm::Key> cellsOf(const gimpm::PointCloud<Dim>& cloud, const gimpm::Grid<Dim>& grid, const gimpm::Division& division)
{
	vector<gimpm::Key> cells;
	for (const auto& x : cloud.position) {
		const gimpm::Index<Dim> cell = ((x - grid.origin) / grid.cellSize).array().floor().template cast<int>();
		const gimpm::Key        key  = gimpm::Grid<Dim>::key(cell);
		if (cells.empty() || cells.back() != key) cells.push_back(key);
	}
	std::sort(cells.begin(), cells.end());
	cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
	return gimpm::united(*division.processes, std::move(cells));
}

namespace {
	// Makes the columns that only some models need.
	template <int Dim> void provideColumns(const vector<MaterialPoint>& points, gimpm::Model<Dim>& model, gimpm::PointCloud<Dim>& cloud)
	{
		cloud.resize(points.size());
		if (model.grid.axisymmetric) cloud.hoopStretch.resize(points.size());
		if (hasMovingBox(model.boundary)) cloud.position0.resize(points.size());
		if (!model.layers.empty()) {
			for (const MaterialPoint& point : points)
				requireBody(point.state->body, int(model.layers.size()) - 1, "Body #" + std::to_string(point.id));
			cloud.layer.resize(points.size());
		}
	}

	bool areUndrained(const std::vector<gimpm::Material>& materials)
	{
		return std::any_of(materials.begin(), materials.end(), [](const auto& m) { return m.waterModulus > 0; });
	}

	// True if the columns are those that a model needs, and the bodies are where they were left: YADE and its other
	// engines do not count what they change.
	template <int Dim> bool serves(const LeftColumns<Dim>& left, const vector<MaterialPoint>& points, const gimpm::Model<Dim>& model)
	{
		const gimpm::PointCloud<Dim>& cloud = left.cloud;
		if (cloud.size() != points.size() || cloud.hoopStretch.empty() == model.grid.axisymmetric || !cloud.force.empty() || !cloud.parameters.empty()
		    || !cloud.layer.empty() || !model.layers.empty() || cloud.position0.empty() == hasMovingBox(model.boundary))
			return false;
		std::atomic_bool are { true };
		inRanges(points.size(), [&](size_t begin, size_t end) {
			for (size_t p = begin; p < end && are; ++p) {
				const MpmState&       state  = *points[p].state;
				const gimpm::Vec<Dim> before = state.refPos.template head<Dim>();
				are = are && state.pos.template head<Dim>() == cloud.position[p] && state.pos.allFinite() && state.refPos.allFinite()
				        && (cloud.position0.empty() || before == cloud.position0[p]);
			}
		});
		return are;
	}

	// True if there are values for all laws of a model.
	template <int Dim> bool haveSameColumns(const LeftColumns<Dim>& left, const gimpm::Model<Dim>& model)
	{
		const auto isSame = [](const vector<int>& columns, const gimpm::Material& material) { return columns == material.law->columns; };
		return std::equal(left.ofLaws.begin(), left.ofLaws.end(), model.materials.begin(), model.materials.end(), isSame)
		        && left.cloud.excessPressure.empty() != areUndrained(model.materials);
	}

	// Settings may have changed since the step that left the columns.
	template <int Dim> void fit(gimpm::PointCloud<Dim>& cloud, const vector<MaterialPoint>& points, const gimpm::Model<Dim>& model)
	{
		inRanges(points.size(), [&](size_t begin, size_t end) {
			for (size_t p = begin; p < end; ++p) {
				points[p].requireStart(cloud.stress[p].full());
				if (!fitsPlainly<Dim>(cloud.position[p], cloud.halfSize[p], model.grid))
					requireFit<Dim>(points[p], model.grid, model.basis, model.domains);
				cloud.halfSize[p] = domainIn<Dim>(model, cloud.position[p], cloud.halfSize[p]);
			}
		});
	}
}
template <int Dim>
gimpm::PointCloud<Dim> gather(const vector<MaterialPoint>& points, gimpm::Model<Dim>& model, const MaterialList& known, LeftColumns<Dim>&& left)
{
	const bool             mayServe = serves(left, points, model);
	gimpm::PointCloud<Dim> cloud;
	cloud.material.resize(points.size());
	MaterialIndex materials(model.materials, model.shares, known);
	for (size_t p = 0; p < points.size(); ++p)
		cloud.material[p] = materials.of(points[p]);
	if (mayServe && haveSameColumns(left, model)) {
		left.cloud.material = std::move(cloud.material);
		fit(left.cloud, points, model);
		return std::move(left.cloud);
	}
	++timesBodiesWereRead;
	provideColumns(points, model, cloud);
	gimpm::provideInternals(cloud.internals, model.materials, points.size());
	provideParameters(points, model, cloud);
	if (areUndrained(model.materials)) cloud.excessPressure.resize(points.size());
	std::atomic_bool hasForce { false };
	inRanges(points.size(), [&](size_t begin, size_t end) {
		OwnMaterial ownMaterial;
		for (size_t p = begin; p < end; ++p) {
			const MaterialPoint& point = points[p];
			point.requireAdmissible(Dim, model.grid.axisymmetric);
			point.requireStart(point.state->stress);
			requireFit<Dim>(point, model.grid, model.basis, model.domains);
			forExchanged(cloud, [&](auto& column, const auto& row) { column[p] = row.take(point, model); });
			gatherInternals(point, model.materials[cloud.material[p]].law, cloud, p);
			if (model.materials[cloud.material[p]].varies) gatherParameters(point, model.materials[cloud.material[p]].law, ownMaterial, cloud, p);
			if (!point.state->force.isZero(0)) hasForce = true;
		}
	});
	if (hasForce)
		for (const MaterialPoint& point : points)
			cloud.force.push_back(pointLoad<Dim>().take(point, model));
	return cloud;
}

template <int Dim> void scatter(gimpm::PointCloud<Dim>& cloud, const gimpm::Grid<Dim>& grid, const vector<MaterialPoint>& points)
{
	const PointWriter writer;
	reenterAll(cloud, grid, points, writer);
	inRanges(points.size(), [&](size_t begin, size_t end) {
		vector<std::pair<std::string_view, const Real*>> internals;
		for (size_t p = begin; p < end; ++p) {
			MpmState& state = writer.state(points[p]);
			MpmPoint& shape = writer.shape(points[p]);
			forExchanged(cloud, [&](const auto& column, const auto& row) { row.give(state, shape, column[p]); });
			state.volume = cloud.volume0[p] * cloud.volumeRatio(p);
			if (cloud.excessPressure.empty()) state.excessPressure = 0; // it has drained
			state.porePressure
			        = points[p].material->undrained ? state.excessPressure : std::numeric_limits<Real>::quiet_NaN(); // conditions add theirs
			state.waterFlux.setConstant(std::numeric_limits<Real>::quiet_NaN());
			if (p == begin || points[p].material.get() != points[p - 1].material.get()) internals = internalsFor(*points[p].material, cloud);
			for (const auto& [name, column] : internals)
				state.setInternal(name, column[p]);
		}
	});
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template gimpm::PointCloud<Dim> centresOnGrid(const vector<MaterialPoint>&, const gimpm::Grid<Dim>&);                                                  \
	template vector<gimpm::Key>     cellsOf(const gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&, const gimpm::Division&);                               \
	template gimpm::PointCloud<Dim> gather(const vector<MaterialPoint>&, gimpm::Model<Dim>&, const MaterialList&, LeftColumns<Dim>&&);                     \
	template void                   scatter(gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&, const vector<MaterialPoint>&);                               \
	template Real                   reenter(Real&, int, const gimpm::Grid<Dim>&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
