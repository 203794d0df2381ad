// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/assignment.hpp"
#include "core/base/checksum.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/materials/own_materials.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include "engine/points/AtWork.hpp"
#include "engine/points/buffers.hpp"
#include "engine/points/columns.hpp"
#include "engine/points/stretched.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <memory>

namespace yade {

namespace {
	// The columns that are given, row by row.
	class Columns {
	public:
		Columns(const py::dict& given, size_t rows)
		{
			const py::list names = given.keys();
			for (py::ssize_t i = 0; i < py::len(names); ++i) {
				const string       name   = py::extract<string>(names[i]);
				const PointColumn* column = findColumn(name);
				if (!column || !column->set) throw std::invalid_argument("there is no column " + name + " to be given");
				auto values = std::make_unique<Column<Real>>(given[names[i]], name.c_str());
				if (values->size() != rows * column->width) throw std::invalid_argument(name + " and ids differ in length");
				columns.push_back({ column, std::move(values) });
			}
		}
		// first of the numbers of a row; null if the column is not given
		const Real* find(const string& name, size_t row) const
		{
			for (const Given& given : columns)
				if (given.column->name == name) return given.at(row);
			return nullptr;
		}
		bool has(const string& name) const { return find(name, 0); }

		void requireAdmitted(size_t row) const
		{
			for (const auto& [column, values] : columns)
				if (const auto* variable = column->variable; variable && !variable->admits(values->data()[row]))
					throw std::invalid_argument(refusalOf(*variable, values->data()[row]));
		}
		// Parameters of a point that is given these.
		OwnParameters parametersOf(const MpmState& state, size_t row) const
		{
			OwnParameters parameters = state.parameters;
			for (const Given& given : columns)
				if (given.column->isParameter) MpmState::setEntry(parameters, given.column->name, *given.at(row));
			return parameters;
		}
		bool haveParameters() const
		{
			return std::any_of(columns.begin(), columns.end(), [](const Given& given) { return given.column->isParameter; });
		}
		bool haveInternals() const
		{
			return std::any_of(columns.begin(), columns.end(), [](const Given& given) { return given.column->variable; });
		}
		void assignTo(const MaterialPoint& point, size_t row) const
		{
			for (const Given& given : columns)
				given.column->set(point, given.at(row));
		}

	private:
		struct Given {
			const PointColumn*            column;
			std::unique_ptr<Column<Real>> values;

			const Real* at(size_t row) const { return values->data() + row * column->width; }
		};
		vector<Given> columns;
	};

	Matrix3r tensorOr(const Matrix3r& otherwise, const Real* given)
	{
		return given ? Matrix3r(Eigen::Map<const Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>>(given)) : otherwise;
	}

	// Values of a material point that follow from columns.
	struct Values {
		Matrix3r                                                defGrad, elasticStrain, stress;
		Vector3r                                                halfSize;
		Real                                                    volume;
		vector<std::pair<const gimpm::InternalVariable*, Real>> internals; // internal variables that follow from a stress

		void assignTo(const MaterialPoint& p) const
		{
			const PointWriter writer;
			MpmState&         state = writer.state(p);
			for (const auto& [variable, value] : internals)
				state.setInternal(variable->name, value);
			state.elasticStrain      = elasticStrain;
			state.stress             = stress;
			state.volume             = volume;
			writer.shape(p).halfSize = halfSize;
		}
	};

	void requireSymmetric(const char* name, const Matrix3r& tensor)
	{
		if (!MpmState::isSymmetric(tensor)) throw std::invalid_argument(string(name) + " is not a symmetric matrix of finite numbers.");
	}

	// The rule of the engine that moves the point; without one the default.
	gimpm::DomainRule ruleOf(const MaterialPoint& point)
	{
		const Scene& scene = *Singleton<Omega>::instance().getScene();
		for (const auto& listed : scene.engines)
			if (const auto* analysis = dynamic_cast<const Analysis*>(listed.get());
			    analysis && maskMatches(*(*scene.bodies)[point.id], analysis->mask))
				return analysis->domainRule();
		return gimpm::DomainRule::tiling;
	}

	// Volume and domain are those that the deformation gradient makes of the initial ones.
	void followDeformation(Values& v, const MaterialPoint& point)
	{
		const Matrix3r& F       = v.defGrad;
		const bool      inPlane = F(0, 2) == 0 && F(1, 2) == 0 && F(2, 0) == 0 && F(2, 1) == 0;
		const auto      rule    = ruleOf(point);
		const Vector3r& initial = point.shape->halfSize0;
		v.volume                = point.state->volume0 * F.determinant();
		v.halfSize              = inPlane ? stretched<2>(initial, F, rule) : stretched<3>(initial, F, rule);
	}

	// In the order of the law of the point.
	vector<Real> internalsOf(const MaterialPoint& point, const Columns& columns, size_t row, const gimpm::Material& material)
	{
		vector<Real> values = point.internalsOf(material.law);
		for (size_t k = 0; k < values.size(); ++k)
			if (const Real* given = columns.find(gimpm::internalVariables[material.law->columns[k]].name, row)) values[k] = *given;
		return values;
	}

	// The variables of laws whose history follows from a stress, but for those that are given.
	void followHistory(Values& v, const Columns& columns, size_t row, vector<Real>& internals, const gimpm::Material& material)
	{
		const vector<Real> bearing = internalsBearing(material.law, v.defGrad.determinant() * v.stress, internals);
		for (size_t k = 0; k < internals.size(); ++k) {
			const auto& variable = gimpm::internalVariables[material.law->columns[k]];
			if (bearing[k] == internals[k] || columns.find(variable.name, row)) continue;
			internals[k] = bearing[k];
			v.internals.emplace_back(&variable, bearing[k]);
		}
	}

	// Stress and elastic strain depend on each other.
	void followStress(Values& v, const Columns& columns, size_t row, vector<Real> internals, const gimpm::Material& material)
	{
		const Real J = v.defGrad.determinant();
		if (columns.has("stress")) {
			requireSymmetric("stress", v.stress);
			followHistory(v, columns, row, internals, material);
			v.elasticStrain = elasticStrainOf(material, J * v.stress, internals);
		} else if (columns.has("elasticStrain") || columns.has("defGrad") || columns.haveInternals()) {
			requireSymmetric("elasticStrain", v.elasticStrain);
			v.stress = kirchhoffStressOf(material, v.elasticStrain, internals) / J;
		}
	}

	Values changed(const MaterialPoint& point, const Columns& columns, size_t row, const gimpm::Material& material)
	{
		const MpmState& state = *point.state;
		Values          v { tensorOr(state.defGrad, columns.find("defGrad", row)),
                           tensorOr(state.elasticStrain, columns.find("elasticStrain", row)),
                           tensorOr(state.stress, columns.find("stress", row)),
                           point.shape->halfSize,
                           state.volume,
                           {} };
		if (!MpmState::preservesOrientation(v.defGrad)) throw std::invalid_argument("defGrad has no determinant > 0: matter cannot turn inside out.");
		columns.requireAdmitted(row);
		if (columns.has("defGrad")) followDeformation(v, point);
		followStress(v, columns, row, internalsOf(point, columns, row, material), material);
		return v;
	}

	// Those with these ids; null where another process has the point.
	vector<const MaterialPoint*> pointsWith(const Column<int64_t>& ids, const vector<MaterialPoint>& points, const gimpm::Processes& all)
	{
		vector<const MaterialPoint*> found;
		vector<int64_t>              isMissing;
		for (size_t row = 0; row < ids.size(); ++row) {
			const int64_t id = ids.data()[row];
			const auto    at = std::lower_bound(points.begin(), points.end(), id, [](const MaterialPoint& p, int64_t i) { return p.id < i; });
			isMissing.push_back(at == points.end() || at->id != id);
			found.push_back(isMissing.back() ? nullptr : &*at);
		}
		all.smallest(isMissing.data(), int(isMissing.size()));
		const size_t first = std::find(isMissing.begin(), isMissing.end(), 1) - isMissing.begin();
		if (first < ids.size()) throw std::invalid_argument("there is no material point with body id " + std::to_string(ids.data()[first]) + ".");
		return found;
	}

	void requireSameIds(const Column<int64_t>& ids, const gimpm::Processes& all)
	{
		const auto checksum = [&] {
			gimpm::Checksum sum;
			sum.mix(vector<int64_t>(ids.data(), ids.data() + ids.size()));
			return sum.take();
		};
		if (!gimpm::haveSame(all, checksum))
			throw std::invalid_argument("the processes name different ids. All of them give the values of the same points, whichever have these.");
	}

	// The refusal of the first row that one of the processes has refused.
	void requireNone(const string& refusal, size_t row, const gimpm::Processes& all)
	{
		auto first = int64_t(row);
		all.smallest(&first, 1);
		if (const string said = gimpm::firstSaid(all, first == int64_t(row) ? refusal : ""); !said.empty()) throw std::invalid_argument(said);
	}
}

void assignColumns(const py::object& ids, const py::dict& given)
{
	const ValueLock lock;
	if (AtWork::isAny())
		throw std::runtime_error("assign: a load step is at work in the background and would overwrite the values; call O.pause() or O.wait() first.");
	const auto            all    = holdersOf(*Singleton<Omega>::instance().getScene());
	const auto            points = materialPoints(*Singleton<Omega>::instance().getScene());
	const Column<int64_t> rows(ids, "ids");
	const Columns         columns(given, rows.size());
	requireSameIds(rows, *all);
	const auto     meant = pointsWith(rows, points, *all);
	vector<Values> values;
	OwnMaterials   materials;
	string         refusal;
	size_t         row = 0;
	for (; row < rows.size() && refusal.empty(); ++row)
		if (const MaterialPoint* point = meant[row]) try {
				values.push_back(changed(*point, columns, row, materials.of(*point->material, columns.parametersOf(*point->state, row))));
			} catch (const std::invalid_argument& error) {
				refusal = "Body #" + std::to_string(point->id) + ": " + error.what();
			}
	requireNone(refusal, row, *all);
	auto value = values.begin();
	for (row = 0; row < rows.size(); ++row)
		if (const MaterialPoint* point = meant[row]) {
			columns.assignTo(*point, row);
			value++->assignTo(*point);
		}
}

} // namespace yade
