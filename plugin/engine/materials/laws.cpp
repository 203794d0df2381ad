// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/laws.hpp"
#include "core/materials/kinematics.hpp"
#include "engine/materials/MpmElasticMat.hpp"
#include "engine/materials/MpmVonMisesMat.hpp"
#include <Eigen/LU>
#include <typeindex>
#include <unordered_map>

namespace yade {

namespace {
	using ToLaw = gimpm::Law (*)(const MpmMaterial&);

	const std::unordered_map<std::type_index, ToLaw> laws {
		{ typeid(MpmElasticMat),
		  [](const MpmMaterial& material) -> gimpm::Law {
		          const auto& m = static_cast<const MpmElasticMat&>(material);
		          return gimpm::Hencky(m.young, m.poisson);
		  } },
		{ typeid(MpmVonMisesMat),
		  [](const MpmMaterial& material) -> gimpm::Law {
		          const auto& m = static_cast<const MpmVonMisesMat&>(material);
		          return gimpm::VonMises(m.young, m.poisson, m.yieldStress);
		  } },
	};
}

gimpm::Material coreMaterial(const MpmMaterial& material)
{
	material.requireAdmissible();
	const auto law = laws.find(typeid(material));
	if (law == laws.end()) throw std::invalid_argument("Material class " + material.getClassName() + " has no constitutive law.");
	return { law->second(material), material.density };
}

namespace {
	gimpm::Response respond(const gimpm::Material& material, const Vector3r& strain, Real plasticStrain)
	{
		const auto response = std::visit([&](const auto& law) { return law.respond(strain, plasticStrain); }, material.law);
		if (response.plasticStrain == plasticStrain) return response;
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

Matrix3r kirchhoffStressOf(const gimpm::Material& material, const Matrix3r& elasticStrain, Real plasticStrain)
{
	return inPrincipalAxes(elasticStrain, [&](const Vector3r& strain) { return respond(material, strain, plasticStrain).stress; });
}

// Newton's method; the laws are linear inside their yield surface, so that one solve is enough and others only remove round-off.
Matrix3r elasticStrainOf(const gimpm::Material& material, const Matrix3r& kirchhoffStress, Real plasticStrain)
{
	return inPrincipalAxes(kirchhoffStress, [&](const Vector3r& stress) {
		Vector3r strain = Vector3r::Zero();
		for (int solve = 0; solve < 2; ++solve) {
			const auto response = respond(material, strain, plasticStrain);
			strain += response.tangent.fullPivLu().solve(stress - response.stress);
		}
		respond(material, strain, plasticStrain);
		return strain;
	});
}

} // namespace yade
