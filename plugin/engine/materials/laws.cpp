// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/laws.hpp"
#include "core/materials/kinematics.hpp"
#include "engine/materials/MpmCamClayMat.hpp"
#include "engine/materials/MpmDruckerPragerMat.hpp"
#include "engine/materials/MpmElasticMat.hpp"
#include "engine/materials/MpmMohrCoulombMat.hpp"
#include "engine/materials/MpmTrescaMat.hpp"
#include "engine/materials/MpmVonMisesMat.hpp"
#include "engine/materials/refusals.hpp"
#include <Eigen/LU>
#include <functional>
#include <typeindex>
#include <unordered_map>

namespace yade {

namespace {
	struct LawOfClass {
		std::function<gimpm::Law(const MpmMaterial&)> make;
		vector<gimpm::InternalVariable>               variables;

		std::function<shared_ptr<MpmMaterial>(const MpmMaterial&)> copy;
		vector<ParameterOfClass>                                   parameters;
	};

	// The law that make(material of class M) returns, and the members that are its parameters, in its order; others that it has stay the same.
	template <class M, class Make, class... Members>
	std::pair<const std::type_index, LawOfClass> entry(Make make, const std::pair<const char*, Members>&... parameters)
	{
		using Law = decltype(make(std::declval<const M&>()));
		static_assert(sizeof...(Members) <= gimpm::countOfParameters<Law>(0));
		const auto of = [](const auto& parameter) {
			return ParameterOfClass { parameter.first,
				                  [member = parameter.second](MpmMaterial& m) -> Real& { return static_cast<M&>(m).*member; } };
		};
		return { typeid(M),
			 { [make](const MpmMaterial& m) { return make(static_cast<const M&>(m)); },
			   { Law::variables.begin(), Law::variables.end() },
			   [](const MpmMaterial& m) -> shared_ptr<MpmMaterial> { return shared_ptr<MpmMaterial>(new M(static_cast<const M&>(m))); },
			   { of(parameters)... } } };
	}

	template <class M, class Make> auto frictional(Make make)
	{
		return entry<M>(
		        make, std::pair("young", &MpmElasticMat::young), std::pair("cohesion", &MpmFrictionalMat::cohesion),
		        std::pair("frictionAngle", &MpmFrictionalMat::frictionAngle), std::pair("dilationAngle", &MpmFrictionalMat::dilationAngle),
		        std::pair("tensileStrength", &MpmFrictionalMat::tensileStrength));
	}

	gimpm::DruckerPrager druckerPrager(const MpmDruckerPragerMat& m)
	{
		using Cone       = gimpm::DruckerPragerCone;
		const auto match = m.match == "compression" ? Cone::compression : m.match == "extension" ? Cone::extension : Cone::planeStrain;
		return { m.young, m.poisson, match(m.cohesion, m.frictionAngle, m.dilationAngle), m.tensileStrength };
	}

	const std::unordered_map<std::type_index, LawOfClass>& laws()
	{
		static const std::unordered_map<std::type_index, LawOfClass> all {
			entry<MpmElasticMat>(
			        [](const MpmElasticMat& m) { return gimpm::Hencky(m.young, m.poisson); }, std::pair("young", &MpmElasticMat::young)),
			entry<MpmVonMisesMat>(
			        [](const MpmVonMisesMat& m) { return gimpm::VonMises(m.young, m.poisson, m.yieldStress, m.hardening, m.residualYieldStress); },
			        std::pair("young", &MpmElasticMat::young), std::pair("yieldStress", &MpmVonMisesMat::yieldStress),
			        std::pair("hardening", &MpmVonMisesMat::hardening), std::pair("residualYieldStress", &MpmVonMisesMat::residualYieldStress)),
			entry<MpmTrescaMat>(
			        [](const MpmTrescaMat& m) { return gimpm::MohrCoulomb::tresca(m.young, m.poisson, m.undrainedStrength); },
			        std::pair("young", &MpmElasticMat::young), std::pair("undrainedStrength", &MpmTrescaMat::undrainedStrength)),
			frictional<MpmMohrCoulombMat>([](const MpmMohrCoulombMat& m) {
			        return gimpm::MohrCoulomb(m.young, m.poisson, m.cohesion, m.frictionAngle, m.dilationAngle, m.tensileStrength);
			}),
			frictional<MpmDruckerPragerMat>(druckerPrager),
			entry<MpmCamClayMat>(
			        [](const MpmCamClayMat& m) {
			                return gimpm::CamClay(
			                        m.shearModulus, m.criticalStateRatio, m.compressionIndex, m.swellingIndex, m.preconsolidation,
			                        m.referencePressure);
			        },
			        std::pair("shearModulus", &MpmCamClayMat::shearModulus), std::pair("criticalStateRatio", &MpmCamClayMat::criticalStateRatio)),
		};
		return all;
	}
}

gimpm::Material coreMaterial(const MpmMaterial& material)
{
	material.requireAdmissible();
	const auto law = laws().find(typeid(material));
	if (law == laws().end()) throw std::invalid_argument("Material class " + material.getClassName() + " has no constitutive law.");
	return { law->second.make(material), material.density };
}

const vector<ParameterOfClass>& parametersOf(const MpmMaterial& material)
{
	static const vector<ParameterOfClass> none;
	const auto                            law = laws().find(typeid(material));
	return law == laws().end() ? none : law->second.parameters;
}

shared_ptr<MpmMaterial> copyOf(const MpmMaterial& material) { return laws().at(typeid(material)).copy(material); }

vector<gimpm::InternalVariable> variablesOf(const MpmMaterial& material)
{
	const auto law = laws().find(typeid(material));
	return law == laws().end() ? vector<gimpm::InternalVariable>() : law->second.variables;
}

vector<Real> initialInternalsOf(const MpmMaterial& material)
{
	const auto law = laws().find(typeid(material));
	if (law == laws().end()) return {};
	return withLaw(law->second.make(material), [](const auto& l) {
		const auto values = l.initialInternals();
		return vector<Real>(values.begin(), values.end());
	});
}

namespace {
	gimpm::Response respond(const gimpm::Material& material, const Vector3r& strain, const vector<Real>& internals)
	{
		const auto response = withLaw(material.law, [&](const auto& law) -> gimpm::Response {
			auto values = law.initialInternals();
			std::copy_n(internals.begin(), values.size(), values.begin());
			return law.respond(strain, values);
		});
		if (response.failed) throw std::invalid_argument("the law of the material has no stress for these strains.");
		constexpr Real roundOff = 1e-9, smallest = 1e-14; // also of states on the yield surface, which a law may return to it
		if ((response.elasticStrain - strain).norm() <= roundOff * strain.norm() + smallest) return response;
		std::ostringstream text;
		text << "the material yields under the principal elastic strains (" << strain.transpose()
		     << "): it can carry no more than the principal Kirchhoff stresses (" << response.stress.transpose() << ") Pa.";
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
	return inPrincipalAxes(elasticStrain, [&](const Vector3r& strain) { return respond(material, strain, internals).stress; });
}

namespace {
	// Of these principal stresses, or near it: zero where the law is linear inside its yield surface.
	Vector3r firstStrain(const gimpm::Law& law, const Vector3r& stress)
	{
		const auto* clay = std::get_if<gimpm::CamClay>(&law);
		if (!clay) return Vector3r::Zero();
		if (stress.sum() < 0) return clay->strainOf(stress);
		std::ostringstream text;
		text << "the mean stress is " << stress.mean() << " Pa: Cam clay has none but pressures, which are negative stresses.";
		throw std::invalid_argument(text.str());
	}
}

// Newton's method; from the first strain one solve is enough and others only remove round-off.
Matrix3r elasticStrainOf(const gimpm::Material& material, const Matrix3r& kirchhoffStress, const vector<Real>& internals)
{
	return inPrincipalAxes(kirchhoffStress, [&](const Vector3r& stress) {
		Vector3r strain = firstStrain(material.law, stress);
		for (int solve = 0; solve < 2; ++solve) {
			const auto response = respond(material, strain, internals);
			strain += response.tangent.fullPivLu().solve(stress - response.stress);
		}
		respond(material, strain, internals);
		return strain;
	});
}

namespace {
	template <class Law> vector<Real> internalsOf(const Law& law, const MpmMaterial& material, const py::dict& given)
	{
		py::dict     rest { py::object(given) }; // a copy
		const auto   first = law.initialInternals();
		vector<Real> values(first.begin(), first.end());
		for (size_t k = 0; k < values.size(); ++k) {
			const gimpm::InternalVariable& variable = law.variables[k];
			if (!rest.has_key(variable.name)) continue;
			values[k] = py::extract<Real>(rest[variable.name]);
			if (!variable.admits(values[k])) throw std::invalid_argument(refusalOf(variable, values[k]));
			rest[variable.name].del();
		}
		if (py::len(rest) == 0) return values;
		string names;
		for (const auto& variable : law.variables)
			names += string(names.empty() ? "" : ", ") + variable.name;
		throw std::invalid_argument(
		        material.getClassName() + " has no internal variable " + string(py::extract<string>(py::list(rest)[0]))
		        + (names.empty() ? ": its law has none." : "; there are: " + names + "."));
	}

	py::tuple tupleOf(const Vector3r& v) { return py::make_tuple(v[0], v[1], v[2]); }

	template <class Law> py::dict respondInPrincipalAxes(const Law& law, const Vector3r& strain, const vector<Real>& internals)
	{
		auto values = law.initialInternals();
		std::copy_n(internals.begin(), values.size(), values.begin());
		const auto r = law.respond(strain, values);
		if (r.failed) throw std::invalid_argument("the law of the material has no stress for these strains.");
		const Matrix3r rows = r.tangent.transpose();
		py::dict       answer, after;
		answer["stress"]        = tupleOf(r.stress);
		answer["elasticStrain"] = tupleOf(r.elasticStrain);
		answer["tangent"]       = py::make_tuple(tupleOf(rows.col(0)), tupleOf(rows.col(1)), tupleOf(rows.col(2)));
		answer["shear"]         = tupleOf(r.shear);
		for (size_t k = 0; k < values.size(); ++k)
			after[law.variables[k].name] = r.internals[k];
		answer["internals"] = after;
		return answer;
	}
}

py::dict respondForPython(const shared_ptr<MpmMaterial>& material, const Vector3r& trialStrain, const py::dict& internals)
{
	const auto core = coreMaterial(*material);
	return withLaw(core.law, [&](const auto& law) { return respondInPrincipalAxes(law, trialStrain, internalsOf(law, *material, internals)); });
}

py::tuple elasticStrainForPython(const shared_ptr<MpmMaterial>& material, const Vector3r& kirchhoffStress, const py::dict& internals)
{
	const auto     core   = coreMaterial(*material);
	const auto     values = withLaw(core.law, [&](const auto& law) { return internalsOf(law, *material, internals); });
	const Matrix3r stress = kirchhoffStress.asDiagonal();
	return tupleOf(elasticStrainOf(core, stress, values).diagonal());
}

} // namespace yade
