// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/laws.hpp"
#include "core/materials/kinematics.hpp"
#include "engine/materials/MpmElasticMat.hpp"
#include "engine/materials/MpmVonMisesMat.hpp"
#include <Eigen/LU>
#include <functional>
#include <typeindex>
#include <unordered_map>

namespace yade {

namespace {
	struct LawOfClass {
		std::function<gimpm::Law(const MpmMaterial&)> make;
		vector<gimpm::InternalVariable>               variables;
	};

	// The law that make(material of class M) returns.
	template <class M, class Make> std::pair<const std::type_index, LawOfClass> entry(Make make)
	{
		using Law = decltype(make(std::declval<const M&>()));
		return { typeid(M),
			 { [make](const MpmMaterial& m) { return make(static_cast<const M&>(m)); }, { Law::variables.begin(), Law::variables.end() } } };
	}

	const std::unordered_map<std::type_index, LawOfClass>& laws()
	{
		static const std::unordered_map<std::type_index, LawOfClass> all {
			entry<MpmElasticMat>([](const MpmElasticMat& m) { return gimpm::Hencky(m.young, m.poisson); }),
			entry<MpmVonMisesMat>(
			        [](const MpmVonMisesMat& m) { return gimpm::VonMises(m.young, m.poisson, m.yieldStress, m.hardening, m.residualYieldStress); }),
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

vector<gimpm::InternalVariable> variablesOf(const MpmMaterial& material)
{
	const auto law = laws().find(typeid(material));
	return law == laws().end() ? vector<gimpm::InternalVariable>() : law->second.variables;
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
		if (response.elasticStrain == strain) return response;
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

// Newton's method; it supposes that laws are linear inside their yield surface: one solve is enough, and the other only removes round-off.
Matrix3r elasticStrainOf(const gimpm::Material& material, const Matrix3r& kirchhoffStress, const vector<Real>& internals)
{
	return inPrincipalAxes(kirchhoffStress, [&](const Vector3r& stress) {
		Vector3r strain = Vector3r::Zero();
		for (int solve = 0; solve < 2; ++solve) {
			const auto response = respond(material, strain, internals);
			strain += response.tangent.fullPivLu().solve(stress - response.stress);
		}
		respond(material, strain, internals);
		return strain;
	});
}

} // namespace yade
