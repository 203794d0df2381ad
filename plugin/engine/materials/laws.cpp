// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/laws.hpp"
#include "core/materials/tensor_law.hpp"
#include "core/materials/user_law.hpp"
#include "core/solvers/least_squares.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/refusals.hpp"
#include <unordered_map>

namespace yade {

namespace {
	std::unordered_map<std::type_index, LawOfClass>& laws()
	{
		static std::unordered_map<std::type_index, LawOfClass> all;
		return all;
	}

	// Null for a class without a law.
	const LawOfClass* lawOf(const MpmMaterial& material)
	{
		const auto found = laws().find(typeid(material));
		return found == laws().end() ? nullptr : &found->second;
	}
}

void registerLaw(std::type_index type, LawOfClass law) { laws().emplace(type, std::move(law)); }

gimpm::Material coreMaterial(const MpmMaterial& material)
{
	material.requireAdmissible();
	const LawOfClass* law = lawOf(material);
	if (!law) throw std::invalid_argument("Material class " + material.getClassName() + " has no constitutive law.");
	gimpm::Material core { law->make(material), material.density };
	if (material.undrained) core.waterModulus = material.waterModulus;
	return core;
}

const vector<ParameterOfClass>& parametersOf(const MpmMaterial& material)
{
	static const vector<ParameterOfClass> none;
	const LawOfClass*                     law = lawOf(material);
	return law ? law->parameters : none;
}

shared_ptr<MpmMaterial> copyOf(const MpmMaterial& material) { return laws().at(typeid(material)).copy(material); }

bool isElastic(const MpmMaterial& material)
{
	const LawOfClass* law = lawOf(material);
	return law && law->make(material)->isElastic;
}

bool canBeWeakened(const MpmMaterial& material)
{
	const LawOfClass* law = lawOf(material);
	return law && law->make(material)->canBeWeakened;
}

vector<std::pair<const gimpm::InternalVariable*, Real>> initialInternalsOf(const MpmMaterial& material)
{
	vector<std::pair<const gimpm::InternalVariable*, Real>> values;
	if (!lawOf(material)) return values;
	const gimpm::Law law = lawOf(material)->make(material);
	for (size_t k = 0; k < law->columns.size(); ++k)
		values.emplace_back(&gimpm::internalVariables[law->columns[k]], law->initialInternals[k]);
	return values;
}

namespace {
	void requireAnswer(bool failed, const string& words = "")
	{
		if (!failed) return;
		throw std::invalid_argument("the law of the material has no stress for these strains" + (words.empty() ? "." : ". It says: " + words));
	}

	// True if the law leaves the strain unchanged: also for states on the yield surface, which return mapping may
	// keep.
	bool isKept(Real difference, Real size, Real tolerance = 1e-9)
	{
		constexpr Real smallest = 1e-14;
		return difference <= tolerance * size + smallest;
	}

	gimpm::Response respond(const gimpm::Material& material, const Vector3r& strain, const vector<Real>& internals)
	{
		const gimpm::Response response = material.law->respond(strain, internals);
		requireAnswer(response.failed);
		if (isKept((response.elasticStrain - strain).norm(), strain.norm())) return response;
		std::ostringstream text;
		text << "the material yields under the principal elastic strains (" << strain.transpose()
		     << "): it can carry no more than the principal Kirchhoff stresses (" << response.stress.transpose() << ") Pa.";
		throw std::invalid_argument(text.str());
	}

	constexpr Real ofIterations = 1e-6; // to which a user's law may solve its own equations

	// One answer of a tensor law, to a point that does not turn.
	gimpm::TensorAnswer answerOf(
	        const gimpm::Law& law, const Matrix3r& strain, const vector<Real>& internals, Real duration = 0, const Matrix3r& stretch = Matrix3r::Identity())
	{
		gimpm::InternalColumns columns(gimpm::internalVariables.size());
		gimpm::provideInternals(columns, { { law, 1 } }, 1);
		gimpm::storeInternals(law, internals.data(), columns, 0);
		gimpm::wordsOfUserLaw().clear();
		const auto answer = law->respond({ {}, columns, 0 }, { strain, stretch, duration });
		requireAnswer(answer.failed, gimpm::wordsOfUserLaw());
		return answer;
	}
	gimpm::TensorAnswer respondInSpace(const gimpm::Material& material, const Matrix3r& strain, const vector<Real>& internals)
	{
		const auto answer = answerOf(material.law, strain, internals);
		if (isKept((answer.elasticStrain - strain).norm(), strain.norm(), ofIterations)) return answer;
		std::ostringstream text;
		text << "the material yields under the elastic strain (" << gimpm::SymTensor<3>::from(strain).c.transpose()
		     << ") along xx, yy, zz, xy, yz, zx: it can carry no more than the Kirchhoff stress ("
		     << gimpm::SymTensor<3>::from(answer.stress).c.transpose() << ") Pa.";
		throw std::invalid_argument(text.str());
	}

	// f(principal values) in the principal axes of a tensor; what is zero out of the plane x-y stays exactly zero.
	template <class F> Matrix3r inPrincipalAxes(const Matrix3r& tensor, F&& f)
	{
		const auto in = [&](auto dim) {
			const auto p = gimpm::principal(gimpm::SymTensor<decltype(dim)::value>::from(tensor));
			return Matrix3r(gimpm::assemble(Vector3r(f(p.value)), p.axes).full());
		};
		const bool isPlane = tensor(0, 2) == 0 && tensor(1, 2) == 0;
		return isPlane ? in(std::integral_constant<int, 2>()) : in(std::integral_constant<int, 3>());
	}
}

Matrix3r kirchhoffStressOf(const gimpm::Material& material, const Matrix3r& elasticStrain, const vector<Real>& internals)
{
	if (material.law->isTensorLaw) return respondInSpace(material, elasticStrain, internals).stress;
	return inPrincipalAxes(elasticStrain, [&](const Vector3r& strain) { return respond(material, strain, internals).stress; });
}

namespace {
	// Strain that has these principal stresses, or is near it.
	Vector3r firstStrain(const gimpm::Law& law, const Vector3r& stress)
	{
		if (const auto strain = law->strainNear(stress)) return *strain;
		std::ostringstream text;
		text << "the mean stress is " << stress.mean() << " Pa: the law of the material has none but pressures, which are negative stresses.";
		throw std::invalid_argument(text.str());
	}

	// Newton's method. Its first solve is that of a point that nothing has happened to: with what others remember
	// no strain at all may be beyond yield.
	Matrix3r strainInSpace(const gimpm::Material& material, const Matrix3r& stress, const vector<Real>& internals)
	{
		constexpr int mostSolves = 30, fewestSolves = 3; // enough where stress is linear in the strain
		const auto*   bears  = dynamic_cast<const gimpm::BearsStress*>(material.law.operator->());
		Matrix3r      strain = bears ? bears->strainOf(stress, internals) : Matrix3r(Matrix3r::Zero());
		// Isotropic laws have shear with shear stress alone; in the plane none by round-off out of the plane.
		const bool isInPlane = bears && stress(0, 2) == 0 && stress(1, 2) == 0;
		for (int solves = 0; solves < mostSolves; ++solves) {
			if (isInPlane) strain(0, 2) = strain(2, 0) = strain(1, 2) = strain(2, 1) = 0;
			const auto answer = answerOf(material.law, strain, solves == 0 && !bears ? material.law->initialInternals : internals);
			if (solves == 0 && !gimpm::wordsOfUserLaw().empty())
				throw std::invalid_argument("the law of the material cannot have a stress at first: " + gimpm::wordsOfUserLaw() + ".");
			const Matrix3r difference = stress - answer.stress;
			if (solves == 0 && bears && difference.norm() <= ofIterations * stress.norm()) {
				respondInSpace(material, strain, internals);
				return strain;
			}
			if (solves >= fewestSolves) respondInSpace(material, strain, internals); // refuses states that yield
			if (solves >= fewestSolves && difference.norm() <= 1e-9 * stress.norm()) return strain;
			strain += gimpm::fromMandel(gimpm::leastSquares(answer.tangent, gimpm::toMandel(difference)));
			if (!strain.allFinite()) break;
		}
		std::ostringstream text;
		text << "no elastic strain was found that gives the Kirchhoff stress (" << gimpm::SymTensor<3>::from(stress).c.transpose()
		     << ") Pa along xx, yy, zz, xy, yz, zx: can the law of the material carry it?";
		throw std::invalid_argument(text.str());
	}
}

// Newton's method; from the first strain one solve is enough and others only remove round-off.
Matrix3r elasticStrainOf(const gimpm::Material& material, const Matrix3r& kirchhoffStress, const vector<Real>& internals)
{
	if (material.law->isTensorLaw) return strainInSpace(material, kirchhoffStress, internals);
	return inPrincipalAxes(kirchhoffStress, [&](const Vector3r& stress) {
		Vector3r strain = firstStrain(material.law, stress);
		for (int solve = 0; solve < 2; ++solve) {
			const auto response = respond(material, strain, internals);
			strain += gimpm::leastSquares(response.tangent, stress - response.stress);
		}
		respond(material, strain, internals);
		return strain;
	});
}

vector<Real> internalsBearing(const gimpm::Law& law, const Matrix3r& kirchhoffStress, const vector<Real>& internals)
{
	const auto* bears = dynamic_cast<const gimpm::BearsStress*>(law.operator->());
	return bears ? bears->bearing(kirchhoffStress, internals) : internals;
}

namespace {
	vector<Real> internalsOf(const gimpm::Law& law, const MpmMaterial& material, const py::dict& given)
	{
		py::dict     rest { py::object(given) }; // a copy
		vector<Real> values = law->initialInternals;
		string       names;
		for (size_t k = 0; k < values.size(); ++k) {
			const gimpm::InternalVariable& variable = gimpm::internalVariables[law->columns[k]];
			names += string(names.empty() ? "" : ", ") + variable.name;
			if (!rest.has_key(variable.name)) continue;
			values[k] = py::extract<Real>(rest[variable.name]);
			if (!variable.admits(values[k])) throw std::invalid_argument(refusalOf(variable, values[k]));
			rest[variable.name].del();
		}
		if (py::len(rest) == 0) return values;
		throw std::invalid_argument(
		        material.getClassName() + " has no internal variable " + string(py::extract<string>(py::list(rest)[0]))
		        + (names.empty() ? ": its law has none." : "; there are: " + names + "."));
	}

	template <class Values> py::tuple tupleOf(const Values& v)
	{
		py::list list;
		for (Eigen::Index i = 0; i < v.size(); ++i)
			list.append(Real(v[i]));
		return py::tuple(list);
	}
	template <class Rows> py::tuple rowsOf(const Rows& m)
	{
		py::list list;
		for (Eigen::Index i = 0; i < m.rows(); ++i)
			list.append(tupleOf(m.row(i)));
		return py::tuple(list);
	}

	py::dict named(const gimpm::Law& law, const Real* internals)
	{
		py::dict by;
		for (size_t k = 0; k < law->columns.size(); ++k)
			by[gimpm::internalVariables[law->columns[k]].name] = internals[k];
		return by;
	}
}

py::dict respondForPython(const shared_ptr<MpmMaterial>& material, const Vector3r& trialStrain, const py::dict& internals)
{
	const gimpm::Law law = coreMaterial(*material).law;
	const auto       r   = law->respond(trialStrain, internalsOf(law, *material, internals));
	requireAnswer(r.failed);
	py::dict answer;
	answer["stress"]        = tupleOf(r.stress);
	answer["elasticStrain"] = tupleOf(r.elasticStrain);
	answer["tangent"]       = rowsOf(r.tangent);
	answer["shear"]         = tupleOf(r.shear);
	answer["internals"]     = named(law, r.internals.data());
	return answer;
}

bool hasTensorLaw(const shared_ptr<MpmMaterial>& material) { return coreMaterial(*material).law->isTensorLaw; }

namespace {
	Matrix3r fromRows(const vector<Real>& numbers)
	{
		if (numbers.size() != 9) throw std::invalid_argument("expected nine numbers, the rows of a tensor.");
		return Eigen::Map<const Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>>(numbers.data());
	}
}

py::dict respondInSpaceForPython(
        const shared_ptr<MpmMaterial>& material, const vector<Real>& trialStrain, const vector<Real>& increment, const py::dict& internals, Real duration)
{
	const gimpm::Law law = coreMaterial(*material).law;
	const auto       p   = gimpm::principal(gimpm::SymTensor<3>::from(fromRows(increment)));
	const Matrix3r   U   = p.axes * Vector3r(p.value.array().exp()).asDiagonal() * p.axes.transpose();
	const auto       r   = answerOf(law, fromRows(trialStrain), internalsOf(law, *material, internals), duration, U);
	py::dict         answer;
	answer["stress"]        = rowsOf(r.stress);
	answer["elasticStrain"] = rowsOf(r.elasticStrain);
	answer["tangent"]       = rowsOf(r.tangent);
	answer["internals"]     = named(law, r.state.numbers());
	return answer;
}

py::dict stepInSpaceForPython(
        const shared_ptr<MpmMaterial>& material, const vector<Real>& elasticStrain, const vector<Real>& increment, const py::dict& internals, Real duration)
{
	const gimpm::Law       law = coreMaterial(*material).law;
	gimpm::InternalColumns columns(gimpm::internalVariables.size());
	gimpm::provideInternals(columns, { { law, 1 } }, 1);
	const vector<Real> values = internalsOf(law, *material, internals);
	gimpm::storeInternals(law, values.data(), columns, 0);
	const auto b1 = gimpm::leftCauchyGreenMinusOne(gimpm::SymTensor<3>::from(fromRows(elasticStrain)));
	gimpm::wordsOfUserLaw().clear();
	const auto r = gimpm::respondInSpace(law, { {}, columns, 0 }, { b1, fromRows(increment) - Matrix3r::Identity(), duration, true });
	requireAnswer(r.failed, gimpm::wordsOfUserLaw());
	py::dict answer;
	answer["stress"]        = rowsOf(r.stress);
	answer["elasticStrain"] = rowsOf(r.elasticStrain);
	answer["rates"]         = rowsOf(r.rates);
	answer["internals"]     = named(law, r.state.numbers());
	return answer;
}

py::dict bearingForPython(const shared_ptr<MpmMaterial>& material, const Vector3r& kirchhoffStress, const py::dict& internals)
{
	const gimpm::Law   law    = coreMaterial(*material).law;
	const Matrix3r     stress = kirchhoffStress.asDiagonal();
	const vector<Real> values = internalsBearing(law, stress, internalsOf(law, *material, internals));
	py::dict           all    = named(law, values.data());
	all.update(internals);
	return all;
}

py::tuple elasticStrainForPython(const shared_ptr<MpmMaterial>& material, const Vector3r& kirchhoffStress, const py::dict& internals)
{
	const auto     core   = coreMaterial(*material);
	const auto     values = internalsOf(core.law, *material, internals);
	const Matrix3r stress = kirchhoffStress.asDiagonal();
	const Matrix3r strain = elasticStrainOf(core, stress, values);
	if (strain.isDiagonal(1e-9)) return tupleOf(strain.diagonal());
	throw std::invalid_argument("the law of the material has other axes than its stresses here: its first state would be sheared.");
}

} // namespace yade
