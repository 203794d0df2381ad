// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/user/mfront_library.hpp"
#include <dlfcn.h>

namespace yade {

namespace {
	using Variable = gimpm::MfrontGiven::Variable;

	constexpr const char* inSpace         = "Tridimensional";
	constexpr Real        roomTemperature = 293.15; // [K]

	// The symbols of one law. Those of one hypothesis hold before those of all.
	struct Symbols {
		void*  library;
		string law;

		const void* of(const string& name) const
		{
			for (const string& whole : { law + "_" + inSpace + "_" + name, law + "_" + name })
				if (const void* symbol = dlsym(library, whole.c_str())) return symbol;
			return nullptr;
		}
		template <class T> T number(const string& name, T otherwise) const
		{
			const void* symbol = of(name);
			return symbol ? *static_cast<const T*>(symbol) : otherwise;
		}
		string text(const string& name) const
		{
			const void* symbol = of(name);
			return symbol ? *static_cast<const char* const*>(symbol) : "";
		}
		int            count(const string& name) const { return number<unsigned short>("n" + name, 0); }
		vector<string> names(const string& name) const
		{
			const auto* all = static_cast<const char* const*>(of(name));
			return all ? vector<string>(all, all + count(name)) : vector<string>();
		}
		vector<int> types(const string& name) const
		{
			const auto* all = static_cast<const int*>(of(name + "Types"));
			return all ? vector<int>(all, all + count(name)) : vector<int>(count(name), 0);
		}
	};

	bool has(const vector<string>& names, const string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

	// Why the law as a whole is not admitted; empty: it is.
	string refusalOf(const Symbols& law)
	{
		constexpr int oldest = 4, smallStrain = 1;
		const string  version = law.text("tfel_version"), units = law.text("unit_system");
		const auto    kind = law.number<unsigned short>("BehaviourType", 0), symmetry = law.number<unsigned short>("SymmetryType", 0);
		if (version.empty() || std::atoi(version.c_str()) < oldest)
			return "it is of TFEL " + (version.empty() ? "before 3.1" : version)
			        + ", whose interface is another: translate it with MFront 4.0 or later";
		if (!units.empty() && units != "SI") return "its units are '" + units + "': expected SI";
		if (!has(law.names("ModellingHypotheses"), inSpace))
			return string("it has no hypothesis '") + inSpace + "', which is the one that is asked, in the plane, too: @ModellingHypothesis";
		if (kind != smallStrain || law.names("Gradients") != vector<string> { "Strain" }
		    || law.names("ThermodynamicForces") != vector<string> { "Stress" })
			return "it is not one of small strain, with 'Strain' as its gradient and 'Stress' as its force. Write it for small strain: it is told the logarithmic strain";
		if (symmetry != 0) return "it is orthotropic, and axes of the material are not known here";
		return "";
	}

	// Parameters here are those that the user gives; MFront has elastic ones before its own.
	vector<string> parametersOf(const Symbols& law)
	{
		vector<string> all;
		if (law.number<unsigned short>("requiresStiffnessTensor", 0)) all = { "YoungModulus", "PoissonRatio" };
		if (law.number<unsigned short>("requiresThermalExpansionCoefficientTensor", 0)) all.push_back("ThermalExpansion");
		for (const string& name : law.names("MaterialProperties"))
			all.push_back(name);
		return all;
	}

	string describeVariables(const Symbols& law, MfrontDescription& found)
	{
		constexpr int     scalar = 0, symmetric = 1;
		const vector<int> types = law.types("InternalStateVariables");
		found.variableNames     = law.names("InternalStateVariables");
		for (size_t k = 0; k < types.size(); ++k) {
			if (types[k] != scalar && types[k] != symmetric)
				return "its internal variable '" + found.variableNames[k] + "' is neither a scalar nor a symmetric tensor";
			found.variables.push_back(types[k] == scalar ? Variable::scalar : Variable::tensor);
		}
		constexpr int most = gimpm::UserState::mostScalars;
		if (found.numbers() > most)
			return "its internal variables have " + std::to_string(found.numbers()) + " numbers (" + std::to_string(most)
			        + " at most, six a tensor)";
		return "";
	}

	string describeExternal(const Symbols& law, MfrontDescription& found)
	{
		vector<string> names = law.names("ExternalStateVariables");
		if (law.number<unsigned short>("TemperatureRemovedFromExternalStateVariables", 1)) names.insert(names.begin(), "Temperature");
		for (const string& name : names)
			if (name != "Temperature") return "it depends on the external variable '" + name + "', which is not known here";
		found.external.assign(names.size(), roomTemperature);
		return "";
	}
}

int MfrontDescription::numbers() const
{
	int sum = 0;
	for (const auto variable : variables)
		sum += variable == Variable::scalar ? 1 : 6;
	return sum;
}

string mfrontInterface(void* library, const string& law) { return Symbols { library, law }.text("mfront_interface"); }

MfrontDescription describeMfront(void* library, const string& name)
{
	const Symbols     law { library, name };
	MfrontDescription found;
	found.reason = refusalOf(law);
	if (found.reason.empty()) found.reason = describeVariables(law, found);
	if (found.reason.empty()) found.reason = describeExternal(law, found);
	found.parameters = parametersOf(law);
	found.call       = reinterpret_cast<gimpm::Mfront>(dlsym(library, (name + "_" + inSpace).c_str()));
	if (found.reason.empty() && !found.call) found.reason = "the library says that it has it, and has no function " + name + "_" + inSpace;
	return found;
}

} // namespace yade
