// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmElasticMat.hpp"

namespace yade {

class MpmUserMat : public ExposedIndexed<MpmUserMat, MpmElasticMat> {
public:
	string       library;
	string       function = "umat_";
	vector<Real> parameters;
	vector<Real> stateVariables;
	vector<int>  stressTensors, strainTensors;
	bool         reentrant = false;

	static constexpr size_t mostStates = 40;

	YADE_API_NAME(MpmUserMat)
	static const char* doc()
	{
		return "A law of somebody else's, out of a library that is opened when it is needed: by MFront's generic interface, or a user material of Abaqus (UMAT), in Kirchhoff "
		       "stress and logarithmic strain, by axes that turn with the material. *young* and *poisson* are of reference, for the stabilisation.\n\n"
		       "Set first: *library*, *function*, *parameters*; then mpm.checkLaw, which compares its tangent with differences. Page: plugin/docs/classes/MpmUserMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using M = MpmUserMat;
		v("library", &M::library, 0, "Path of the shared library, as g++ -shared -fPIC or gfortran -shared -fPIC makes it; no default.",
		  admitting("the path of a shared library; there is no default", [](const string& path) { return !path.empty(); }));
		v("function", &M::function, 0,
		  "Name of its function, as the library has it: in Fortran small letters and an underscore; of MFront the name of the behaviour.",
		  admitting("the name of a function of the library, as 'umat_'", [](const string& name) { return !name.empty(); }));
		v("parameters", &M::parameters, 0, "Its material constants (PROPS, of MFront material properties), in its own units and order, finite.",
		  admitting("finite numbers", [](const vector<Real>& all) {
			  return std::all_of(all.begin(), all.end(), [](Real x) { return std::isfinite(x); });
		  }));
		v("stateVariables", &M::stateVariables, 0,
		  "Values at first of its state variables (STATEV), as many as it has, at most 40: columns state1, state2 ... of mpm.arrays. MFront's: none for zeros.",
		  admitting("at most 40 finite numbers", [](const vector<Real>& all) {
			  return all.size() <= mostStates && std::all_of(all.begin(), all.end(), [](Real x) { return std::isfinite(x); });
		  }));
		const auto numbers = admitting("numbers of state variables, from 1 on, each the first of six", [](const vector<int>& all) {
			return std::all_of(all.begin(), all.end(), [](int k) { return k >= 1 && size_t(k) + 5 <= mostStates; });
		});
		v("stressTensors", &M::stressTensors, 0,
		  "Numbers, from 1, of state variables of a UMAT with which symmetric tensors of six numbers begin, as a back stress: they turn with the material.",
		  numbers);
		v("strainTensors", &M::strainTensors, 0, "The same, of tensors with twice the shear components, as an intergranular strain.", numbers);
		v("reentrant", &M::reentrant, 0,
		  "True: several threads may call it at a time; if it keeps variables from call to call (SAVE, COMMON), they may not.");
	}
	void requireAdmissible() const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmUserMat)
