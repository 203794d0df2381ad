// SPDX-License-Identifier: GPL-2.0-or-later
// Materials, by a handle for their laws: whoever is no kernel need not know which laws there are.
#pragma once
#include "core/materials/any_law.hpp"

namespace gimpm {

/// A law, principal (core/materials/law.hpp) or of tensors (core/materials/tensor_law.hpp). Copies share it: laws do
/// not change.
class Law {
public:
	/// Makes a law from one of a class of laws: the header that knows of its kind has handleOf(law).
	template <class L, class = std::enable_if_t<!std::is_base_of_v<AnyLaw, L> && !std::is_same_v<L, Law>>>
	Law(const L& law) : Law(std::shared_ptr<const AnyLaw>(handleOf(law)))
	{
	}
	explicit Law(std::shared_ptr<const AnyLaw> law) : law_(std::move(law)), principal_(law_->principal) { }

	/// One whose elastic strain is the trial strain.
	static Law ofTrialStrain();

	const AnyLaw*       operator->() const { return law_.get(); }
	const PrincipalLaw& principal() const { return *principal_; }

private:
	std::shared_ptr<const AnyLaw> law_;
	const PrincipalLaw*           principal_;
};

struct Material {
	Law    law;
	double density;        ///< initial density [kg/m3]
	bool   varies = false; ///< points have parameters of their own
	/// Bulk modulus of water that cannot leave the pores, over the porosity [Pa]; 0: it leaves at once. The law is
	/// then that of the effective stress, and the water adds its modulus times the volumetric strain.
	double waterModulus = 0;

	/// Young's modulus [Pa] of a point with these parameters and internal variables; volumetricStrain() gives its
	/// elastic volumetric strain to the laws that ask for it.
	template <class F> double young(const ParameterColumns& parameters, const InternalColumns& columns, std::size_t point, F&& volumetricStrain) const
	{
		return law->young({ ofPoints(parameters), columns, point }, VolumetricStrain(volumetricStrain));
	}
	/// The same without elastic strain, by the parameters of the material.
	double young(const InternalColumns& columns, std::size_t point) const
	{
		return young({}, columns, point, [] { return 0.; });
	}
	/// Those columns of parameters that its points have.
	const ParameterColumns& ofPoints(const ParameterColumns& parameters) const
	{
		static const ParameterColumns none;
		return varies ? parameters : none;
	}
};

/// The parameters of the law itself.
inline std::vector<double> parametersOf(const Law& law) { return law->parameters(); }

/// True if the laws of all of these points have symmetric tangents, and so a stiffness that is symmetric.
bool areSymmetric(const std::vector<Material>&, const std::vector<int>& material, const ParameterColumns&);

/// Makes the columns that the laws of these materials have variables for, and that are not there yet, for so many
/// points, of zeros.
void provideInternals(InternalColumns&, const std::vector<Material>&, std::size_t points);

/// Stores the internal variables of a point of this law, of which `values` has at least as many as it has variables.
inline void storeInternals(const Law& law, const double* values, InternalColumns& columns, std::size_t point)
{
	for (std::size_t k = 0; k < law->columns.size(); ++k)
		columns[law->columns[k]][point] = values[k];
}

} // namespace gimpm
