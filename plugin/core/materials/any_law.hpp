// SPDX-License-Identifier: GPL-2.0-or-later
// Interface of all laws, whatever their kind: for callers other than kernels, which need not know which laws there are.
#pragma once
#include "core/base/types.hpp"
#include "core/materials/internal_variables.hpp"
#include "core/materials/response.hpp"
#include "core/materials/weakening.hpp"
#include <memory>
#include <optional>

namespace gimpm {

class Law;
struct TensorStep;
struct TensorAnswer;
struct PrincipalLaw; ///< one of core/materials/law.hpp

/// Parameters of a point, if it has any of its own, and its internal variables.
struct PointOfLaw {
	const ParameterColumns& parameters; ///< empty: those of the law
	const InternalColumns&  internals;
	std::size_t             point;
};

/// The elastic volumetric strain of a point, which is computed only for laws that ask for it.
class VolumetricStrain {
public:
	template <class F> VolumetricStrain(const F& f) : f_(&f), call_([](const void* g) { return (*static_cast<const F*>(g))(); }) { }
	double operator()() const { return call_(f_); }

private:
	const void* f_;
	double (*call_)(const void*);
};

/// Moduli of pressure waves and shear waves [Pa].
struct WaveModuli {
	double pressure, shear;
};

/// Response of a principal law to a strain, one point at a time.
struct PrincipalAnswer : Response {
	std::vector<double> internals; ///< after the return
};

class AnyLaw {
public:
	virtual ~AnyLaw() = default;

	std::vector<int>    columns;          ///< its variables, in its own order, by their numbers among all
	std::vector<double> initialInternals; ///< their values at first

	bool isElastic     = false; ///< nothing flows, whatever the strain
	bool isLinear      = false; ///< stress is linear in the elastic strain
	bool canBeWeakened = false; ///< strength reduction is possible, by one factor of safety
	bool isTensorLaw   = false;

	/// The law itself, or of a tensor law one that kernels ask instead of it without using the answer.
	const PrincipalLaw* principal = nullptr;

	/// Properties at a point. Young's modulus is that of unloading, as it is now.
	virtual bool       isSymmetric(const ParameterColumns&, std::size_t point) const = 0;
	virtual double     young(const PointOfLaw&, const VolumetricStrain&) const       = 0;
	virtual WaveModuli waveModuli(const PointOfLaw&, const VolumetricStrain&) const  = 0;

	/// Parameters that may differ from point to point, and those reduced by a factor of safety.
	virtual std::vector<double> parameters() const                                                           = 0;
	virtual std::vector<double> weakened(const ParameterColumns&, std::size_t point, const Weakening&) const = 0;
	virtual Law                 with(const std::vector<double>& parameters) const                            = 0;

	/// Stores the variables of point `from` of some columns, which may be missing, as those of point `to` of
	/// others.
	virtual void copyInternals(const InternalColumns&, std::size_t from, InternalColumns&, std::size_t to) const = 0;

	/// A principal strain near that of these stresses, from which Newton's method finds it; none where no elastic
	/// strain can have them.
	virtual std::optional<Vec3> strainNear(const Vec3& stress) const = 0;

	/// One answer, with the internal variables as the step begins: of a principal law in principal axes, of a
	/// tensor law in those that turn with the material.
	virtual PrincipalAnswer respond(const Vec3& trialStrain, const std::vector<double>& internals) const = 0;
	virtual TensorAnswer    respond(const PointOfLaw&, const TensorStep&) const                          = 0;
};

} // namespace gimpm
