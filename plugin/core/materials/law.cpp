// SPDX-License-Identifier: GPL-2.0-or-later
// The handles of principal laws, and what is asked of materials.
#include "core/materials/law_of.hpp"
#include "core/materials/tensor_law.hpp"
#include <mutex>

namespace gimpm {
namespace {

/// A deque, so that the variables stay where they are.
std::deque<InternalVariable>& knownVariables()
{
	static std::deque<InternalVariable> all(principalVariables.begin(), principalVariables.end());
	return all;
}

template <class L> class HandleOf : public LawOf<L> {
public:
	explicit HandleOf(const L& law) : LawOf<L>(law), self_ { law }
	{
		this->principal        = &self_;
		this->initialInternals = this->listOf(law.initialInternals());
		for (std::size_t k = 0; k < L::variables.size(); ++k)
			this->columns.push_back(columnOf<L>(k));
	}

	double young(const PointOfLaw& p, const VolumetricStrain& volumetricStrain) const override
	{
		return withParameters(this->own_, p.parameters, p.point, [&](const auto& law) {
			return youngOf(law, internalsOf(law, p.internals, p.point), volumetricStrain, 0);
		});
	}
	WaveModuli waveModuli(const PointOfLaw& p, const VolumetricStrain& volumetricStrain) const override
	{
		return withParameters(this->own_, p.parameters, p.point, [&](const auto& law) {
			const auto r = law.template respond<double>(Vec3::Constant(volumetricStrain() / 3), internalsOf(law, p.internals, p.point));
			return WaveModuli { r.tangent(0, 0), r.shear[0] };
		});
	}
	void copyInternals(const InternalColumns& from, std::size_t p, InternalColumns& to, std::size_t i) const override
	{
		storeInternals(this->own_, internalsOf(this->own_, from, p), to, i);
	}
	std::optional<Vec3> strainNear(const Vec3& stress) const override
	{
		if constexpr (L::isLinear) return Vec3(Vec3::Zero());
		else
			return this->own_.strainNear(stress);
	}
	PrincipalAnswer respond(const Vec3& trialStrain, const std::vector<double>& internals) const override
	{
		auto values = this->own_.initialInternals();
		std::copy_n(internals.begin(), values.size(), values.begin());
		const auto r = this->own_.respond(trialStrain, values);
		return { r, this->listOf(r.internals) };
	}
	// It is asked in principal axes, and has no other answer.
	TensorAnswer respond(const PointOfLaw&, const TensorStep& step) const override
	{
		TensorAnswer none(step.state);
		none.failed = true;
		return none;
	}

private:
	const PrincipalLaw self_;
};

} // namespace

const std::deque<InternalVariable>& InternalVariables::all() { return knownVariables(); }

int InternalVariables::find(std::string_view name) const
{
	const auto& known = all();
	const auto  found = std::find_if(known.begin(), known.end(), [name](const auto& variable) { return variable.name == name; });
	return found == known.end() ? -1 : int(found - known.begin());
}

int InternalVariables::add(const InternalVariable& variable) const
{
	static std::mutex      oneAtATime;
	const std::scoped_lock lock(oneAtATime);
	if (const int column = find(variable.name); column >= 0) return column;
	knownVariables().push_back(variable);
	return int(size()) - 1;
}

std::shared_ptr<const AnyLaw> handleOf(const PrincipalLaws& law)
{
	return withLaw(law, [](const auto& l) -> std::shared_ptr<const AnyLaw> { return std::make_shared<const HandleOf<std::decay_t<decltype(l)>>>(l); });
}

Law Law::ofTrialStrain() { return Hencky(1, 0); }

bool areSymmetric(const std::vector<Material>& materials, const std::vector<int>& material, const ParameterColumns& parameters)
{
	for (const Material& m : materials)
		if (!m.varies && !m.law->isSymmetric({}, 0)) return false;
	if (parameters.empty()) return true;
	for (std::size_t p = 0; p < material.size(); ++p)
		if (const Material& m = materials[material[p]]; m.varies && !m.law->isSymmetric(parameters, p)) return false;
	return true;
}

void provideInternals(InternalColumns& columns, const std::vector<Material>& materials, std::size_t points)
{
	columns.resize(internalVariables.size());
	for (const Material& material : materials)
		for (const int column : material.law->columns)
			columns[column].resize(points);
}

} // namespace gimpm
