// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/assignment.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/points/buffers.hpp"
#include "engine/solver/exchange.hpp"
#include "engine/materials/laws.hpp"
#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <memory>
#include <unordered_map>

namespace yade {

namespace {
	using RowByRow = Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>;

	// The columns that are given, by name.
	class Columns {
	public:
		Columns(const py::dict& given, size_t rows)
		{
			const py::list names = given.keys();
			for (py::ssize_t i = 0; i < py::len(names); ++i) {
				const string name = py::extract<string>(names[i]);
				const auto   size = widths.find(name);
				if (size == widths.end()) throw std::invalid_argument("there is no column " + name);
				auto column = std::make_unique<Column<Real>>(given[names[i]], name.c_str());
				if (column->size() != rows * size->second) throw std::invalid_argument(name + " and ids differ in length");
				columns[name] = std::move(column);
			}
		}
		bool has(const string& name) const { return columns.count(name); }
		// leaves the value alone where there is no such column
		void read(const string& name, size_t row, Real& value) const
		{
			if (has(name)) value = *first(name, row);
		}
		void read(const string& name, size_t row, Vector3r& value) const
		{
			if (has(name)) value = Eigen::Map<const Vector3r>(first(name, row));
		}
		void read(const string& name, size_t row, Matrix3r& value) const
		{
			if (has(name)) value = Eigen::Map<const RowByRow>(first(name, row));
		}

	private:
		const Real* first(const string& name, size_t row) const { return columns.at(name)->data() + row * widths.at(name); }

		static const std::map<string, size_t>            widths;
		std::map<string, std::unique_ptr<Column<Real>>> columns;
	};

	const std::map<string, size_t> Columns::widths { { "pos", 3 },    { "pos0", 3 },          { "defGrad", 9 }, { "elasticStrain", 9 },
		                                             { "stress", 9 }, { "plasticStrain", 1 }, { "force", 3 },   { "color", 3 } };

	// Of a material point, what a column can change.
	struct Values {
		Vector3r pos, pos0, force, color, halfSize;
		Matrix3r defGrad, elasticStrain, stress;
		Real     plasticStrain, volume;

		explicit Values(const MaterialPoint& p)
		        : pos(p.state->pos)
		        , pos0(p.state->refPos)
		        , force(p.state->force)
		        , color(p.shape->color)
		        , halfSize(p.shape->halfSize)
		        , defGrad(p.state->defGrad)
		        , elasticStrain(p.state->elasticStrain)
		        , stress(p.state->stress)
		        , plasticStrain(p.state->plasticStrain)
		        , volume(p.state->volume)
		{
		}
		void assignTo(const MaterialPoint& p) const
		{
			p.state->pos           = pos;
			p.state->refPos        = pos0;
			p.state->force         = force;
			p.state->defGrad       = defGrad;
			p.state->elasticStrain = elasticStrain;
			p.state->stress        = stress;
			p.state->plasticStrain = plasticStrain;
			p.state->volume        = volume;
			p.shape->color         = color;
			p.shape->halfSize      = halfSize;
		}
	};

	void requireSymmetric(const char* name, const Matrix3r& tensor)
	{
		if (!MpmState::isSymmetric(tensor)) throw std::invalid_argument(string(name) + " is not a symmetric matrix of finite numbers.");
	}

	// Volume and domain are those that the deformation gradient makes of the initial ones.
	void followDeformation(Values& v, const MaterialPoint& point)
	{
		v.volume   = point.state->volume0 * v.defGrad.determinant();
		v.halfSize = stretched(point.shape->halfSize0, v.defGrad);
	}

	// Stress and elastic strain depend on each other.
	void followStress(Values& v, const Columns& columns, const gimpm::Material& material)
	{
		const Real J = v.defGrad.determinant();
		if (columns.has("stress")) {
			requireSymmetric("stress", v.stress);
			v.elasticStrain = elasticStrainOf(material, J * v.stress, { v.plasticStrain });
		} else if (columns.has("elasticStrain") || columns.has("defGrad") || columns.has("plasticStrain")) {
			requireSymmetric("elasticStrain", v.elasticStrain);
			v.stress = kirchhoffStressOf(material, v.elasticStrain, { v.plasticStrain }) / J;
		}
	}

	Values changed(const MaterialPoint& point, const Columns& columns, size_t row, const gimpm::Material& material)
	{
		Values v(point);
		columns.read("pos", row, v.pos);
		columns.read("pos0", row, v.pos0);
		columns.read("force", row, v.force);
		columns.read("color", row, v.color);
		columns.read("defGrad", row, v.defGrad);
		columns.read("elasticStrain", row, v.elasticStrain);
		columns.read("stress", row, v.stress);
		columns.read("plasticStrain", row, v.plasticStrain);
		if (!MpmState::preservesOrientation(v.defGrad)) throw std::invalid_argument("defGrad has no determinant > 0: matter cannot turn inside out.");
		if (!(v.plasticStrain >= 0)) throw std::invalid_argument("plasticStrain = " + std::to_string(v.plasticStrain) + " is not >= 0.");
		if (columns.has("defGrad")) followDeformation(v, point);
		followStress(v, columns, material);
		return v;
	}

	const MaterialPoint& pointWith(Body::id_t id, const vector<MaterialPoint>& points)
	{
		const auto found = std::lower_bound(points.begin(), points.end(), id, [](const MaterialPoint& p, Body::id_t i) { return p.id < i; });
		if (found != points.end() && found->id == id) return *found;
		throw std::invalid_argument("there is no material point with body id " + std::to_string(id) + ".");
	}
}

void assignColumns(const py::object& ids, const py::dict& given)
{
	const ValueLock lock;
	if (MpmImplicitEngine::isStepAtWork()) 
		throw std::runtime_error("assign: a load step is at work in the background and would overwrite the values; call O.pause() or O.wait() first.");
	const auto            points = materialPoints(*Singleton<Omega>::instance().getScene());
	const Column<int64_t> rows(ids, "ids");
	const Columns         columns(given, rows.size());
	vector<Values>        values;

	std::unordered_map<const MpmMaterial*, gimpm::Material> materials;
	for (size_t row = 0; row < rows.size(); ++row) {
		const MaterialPoint& point = pointWith(rows.data()[row], points);
		try {
			const auto& material = &*point.material;
			if (!materials.count(material)) materials.emplace(material, coreMaterial(*material));
			values.push_back(changed(point, columns, row, materials.at(material)));
		} catch (const std::invalid_argument& error) {
			throw std::invalid_argument("Body #" + std::to_string(point.id) + ": " + error.what());
		}
	}
	for (size_t row = 0; row < rows.size(); ++row)
		values[row].assignTo(pointWith(rows.data()[row], points));
}

} // namespace yade
