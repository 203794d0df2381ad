// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/materials/internal_variable.hpp"
#include "engine/materials/parameters.hpp"
#include "yade_api/exposed.hpp"
#include <string_view>

namespace yade {

class MpmState : public ExposedIndexed<MpmState, State> {
public:
	Matrix3r                        stress           = Matrix3r::Zero();
	Matrix3r                        defGrad          = Matrix3r::Identity();
	Matrix3r                        elasticStrain    = Matrix3r::Zero();
	Vector3r                        force            = Vector3r::Zero();
	Real                            volume           = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Real                            volume0          = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Real                            porePressure     = std::numeric_limits<Real>::quiet_NaN(); // there is no water
	Real                            pressureOnGrains = std::numeric_limits<Real>::quiet_NaN(); // that of the pores
	Real                            excessPressure   = 0;
	Real                            saturation       = std::numeric_limits<Real>::quiet_NaN();                     // not known
	Vector3r                        waterFlux        = Vector3r::Constant(std::numeric_limits<Real>::quiet_NaN()); // no water flows
	Real                            plasticStrain    = 0;
	vector<std::pair<string, Real>> internals; // variables of the law that are no attribute here
	OwnParameters                   parameters;
	Vector3r                        acceleration = Vector3r::Zero();
	int                             splits       = 0;
	int                             parent       = -1; // the body is none of another one
	int                             body         = -1; // the body of points has no name

	YADE_API_NAME(MpmState)
	static const char* doc()
	{
		return "State of a material point. *pos* and *refPos* (inherited) are its current and initial position [m], *mass* [kg] is constant, *vel* [m/s] "
		       "belongs to MpmDynamicEngine. Tensors are 3x3 in plane strain too, with the normal component out of the plane; in axisymmetry zz is the "
		       "hoop component.\n\n"
		       "Set by mpm.assign, read by mpm.arrays. Page: plugin/docs/classes/MpmState.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		const auto symmetric = admitting("a symmetric matrix of finite numbers", isSymmetric);
		const auto volumes   = admitting("a finite number > 0 [m³]; there is no default", positive);
		v("stress", &MpmState::stress, readonly,
		  "Cauchy stress [Pa], where there is water the effective one, symmetric, positive in tension: a result. To start from a stress: mpm.assign(stress=...), mpm.geostatic(K0=...), or "
		  "the elastic strain that causes it.");
		v("defGrad", &MpmState::defGrad, 0,
		  "Deformation gradient [-] from the initial configuration, determinant > 0. To be set by mpm.assign, where volume, stress and domain follow; set "
		  "here, they do not yet.",
		  admitting("a matrix of finite numbers with a determinant > 0: matter cannot turn inside out", preservesOrientation));
		v("elasticStrain", &MpmState::elasticStrain, 0,
		  "Elastic logarithmic strain [-], symmetric, positive in extension: half the logarithm of the elastic left Cauchy-Green tensor. The "
		  "next step starts from it (Coombs 2023, section 2).",
		  symmetric);
		v("force", &MpmState::force, 0, "Point load [N] at load factor 1; per metre of thickness in plane strain, of a whole ring in axisymmetry.",
		  finite);
		v("volume", &MpmState::volume, 0, "Current volume [m³] > 0; that of 1 m of thickness in plane strain, of the whole ring in axisymmetry.",
		  volumes);
		v("volume0", &MpmState::volume0, 0, "Initial volume [m³] > 0; that of 1 m of thickness in plane strain, of the whole ring in axisymmetry.",
		  volumes);
		v("plasticStrain", &MpmState::plasticStrain, 0,
		  "Equivalent plastic strain [-] >= 0: sqrt(2/3) times the accumulated length of the increments of plastic logarithmic strain.", nonNegative);
		v("internals", &MpmState::internals, 0,
		  "Internal variables of the law but for *plasticStrain*: pairs of name and value; without a pair, the initial value. mpm.arrays and mpm.assign have a column for each.",
		  admitting("pairs of the name of an internal variable, each once, and a value that it admits", areInternals));
		v("parameters", &MpmState::parameters, 0,
		  "Strengths and moduli of the point instead of its material's: pairs of name and value. mpm.assign and mpm.fill check them; set here, the next step does.",
		  admitting("pairs of the name of a strength or modulus, each once, and a number", areParameters));
		v("acceleration", &MpmState::acceleration, readonly, "Acceleration [m/s²] at the end of the last step of a MpmDynamicEngine: a result.",
		  finite);
		v("porePressure", &MpmState::porePressure, readonly,
		  "Pressure of water in the pores [Pa] at the end of the last step (MpmWater, and *excessPressure*): a result; NaN without water. Total stress in full pores: *stress* less it.");
		v("pressureOnGrains", &MpmState::pressureOnGrains, readonly,
		  "Part of *porePressure* [Pa] that acts on the grains (Bishop), with *MpmFlow.total*: a result, less which *stress* is total stress; NaN without: all of it.");
		v("excessPressure", &MpmState::excessPressure, 0,
		  "Pressure [Pa] in the pores over that of still water (MpmWater): of water that cannot leave (*MpmMaterial.undrained*), or that flows (*MpmImplicitEngine.flow*); *porePressure* has it, too.",
		  finite);
		v("saturation", &MpmState::saturation, readonly,
		  "Degree of saturation [-] at the end of the last step with *MpmFlow.total*: a result; NaN without, and after mpm.assign(excessPressure=...).");
		v("waterFlux", &MpmState::waterFlux, readonly,
		  "Volume of water that flows through the soil, by area and time [m/s], at the end of the last step with *MpmImplicitEngine.flow*: a result; NaN without.");
		v("splits", &MpmState::splits, readonly,
		  "Number of times that the initial point has been split in two to give this one: a result (MpmImplicitEngine.maxSplits).", atLeast(0));
		v("parent", &MpmState::parent, readonly,
		  "Id of the body that this one was split off from, which keeps the other half; -1 of points that were there at first.", atLeast(-1));
		v("body", &MpmState::body, readonly,
		  "Place in *MpmGrid.bodies* of the body of points that it belongs to, given by mpm.fill(..., body=...); -1, the default: one without a name.",
		  atLeast(-1));
	}

	// Calls v(member) for what there is once only, of which each half of a point has its part; the rest both have.
	// The mass belongs to YADE's State.
	template <class V> static void amounts(V&& v) { v(&MpmState::volume), v(&MpmState::volume0), v(&MpmState::mass), v(&MpmState::force); }

	// Position and initial position belong to YADE's State, which admits every number.
	void requireAdmissible() const override;

	// Internal variable of the point's law; null while it has its initial value.
	const Real* internal(std::string_view name) const { return name == ownAttribute ? &plasticStrain : find(internals, name); }
	void        setInternal(std::string_view name, Real value)
	{
		if (name == ownAttribute) plasticStrain = value;
		else
			setEntry(internals, name, value);
	}

	// A parameter of its own; null: that of the material.
	const Real* parameter(std::string_view name) const;
	void        setParameter(std::string_view name, Real value) { setEntry(parameters, name, value); }

	using Entries = vector<std::pair<string, Real>>;
	static void setEntry(Entries&, std::string_view name, Real value);

	static bool areParameters(const OwnParameters&);
	static bool areInternals(const vector<std::pair<string, Real>>&);
	static bool isSymmetric(const Matrix3r&); // to round-off
	static bool preservesOrientation(const Matrix3r&);

private:
	static constexpr std::string_view ownAttribute = gimpm::equivalentPlasticStrain.name;

	static const Real* find(const Entries&, std::string_view name);
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmState)
