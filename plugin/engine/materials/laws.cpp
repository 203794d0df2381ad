// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/laws.hpp"
#include "core/materials/kinematics.hpp"
#include "engine/materials/MpmCamClayMat.hpp"
#include "engine/materials/MpmDruckerPragerMat.hpp"
#include "engine/materials/MpmElasticMat.hpp"
#include "engine/materials/MpmMohrCoulombMat.hpp"
#include "engine/materials/MpmTrescaMat.hpp"
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

	gimpm::DruckerPrager druckerPrager(const MpmDruckerPragerMat& m)
	{
		using Cone       = gimpm::DruckerPragerCone;
		const auto match = m.match == "compression" ? Cone::compression : m.match == "extension" ? Cone::extension : Cone::planeStrain;
		return { m.young, m.poisson, match(m.cohesion, m.frictionAngle, m.dilationAngle), m.tensileStrength };
	}

	const std::unordered_map<std::type_index, LawOfClass>& laws()
	{
		static const std::unordered_map<std::type_index, LawOfClass> all {
			entry<MpmElasticMat>([](const MpmElasticMat& m) { return gimpm::Hencky(m.young, m.poisson); }),
			entry<MpmVonMisesMat>(
			        [](const MpmVonMisesMat& m) { return gimpm::VonMises(m.young, m.poisson, m.yieldStress, m.hardening, m.residualYieldStress); }),
			entry<MpmTrescaMat>([](const MpmTrescaMat& m) { return gimpm::MohrCoulomb::tresca(m.young, m.poisson, m.undrainedStrength); }),
			entry<MpmMohrCoulombMat>([](const MpmMohrCoulombMat& m) {
			        return gimpm::MohrCoulomb(m.young, m.poisson, m.cohesion, m.frictionAngle, m.dilationAngle, m.tensileStrength);
			}),
			entry<MpmDruckerPragerMat>(druckerPrager),
			entry<MpmCamClayMat>([](const MpmCamClayMat& m) {
			        return gimpm::CamClay(
			                m.shearModulus, m.criticalStateRatio, m.compressionIndex, m.swellingIndex, m.preconsolidation, m.referencePressure);
			}),
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

} // namespace yade
