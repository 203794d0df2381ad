// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/user/MpmUserMat.hpp"
#include "core/materials/umat.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/user/mfront_library.hpp"
#include "yade_api/registration.hpp"
#include <algorithm>
#include <dlfcn.h>
#include <fstream>
#include <map>
#include <optional>

namespace yade {

namespace {
	// One of each function, whoever calls it.
	struct Opened {
		gimpm::Umat                      umat = nullptr;
		std::optional<MfrontDescription> mfront;
		std::shared_ptr<std::mutex>      oneAtATime { new std::mutex };
		bool                             isOfMfront = false;
		string                           reason; // why there is none

		bool isThere() const { return umat || mfront; }
	};

	// MFront's own names of interfaces.
	constexpr const char *generic = "Generic", *asUmat = "Abaqus";

	// Why a library that is open does not have the function as a UMAT.
	string reasonOfNone(void* library, const string& path, const string& function)
	{
		const string behaviour = function.substr(0, function.rfind('_')); // MFront's functions end with the hypothesis
		if (mfrontInterface(library, behaviour) == generic) return "of a law of MFront the name is asked, function = '" + behaviour + "'";
		if (dlsym(library, function.c_str())) return "";
		return "the library has no function of this name; `nm -D " + path
		        + "` lists those that it has. Fortran writes small letters and an underscore behind them; a law of MFront, with its generic interface, "
		          "has the name of its @Behaviour";
	}

	Opened open(const string& library, const string& function)
	{
		Opened opened;
		void*  handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
		if (!handle) {
			opened.reason = string("the library cannot be opened (") + dlerror() + ")";
			return opened;
		}
		const string interface = mfrontInterface(handle, function);
		opened.isOfMfront      = !interface.empty();
		if (interface == generic) opened.mfront = describeMfront(handle, function);
		else if (!interface.empty() && interface != asUmat)
			opened.reason = "MFront has written it for the interface '"
			        + interface + "': expected 'Generic' or 'Abaqus', as of mfront --interface=generic";
		else {
			opened.reason = reasonOfNone(handle, library, function);
			if (opened.reason.empty()) opened.umat = reinterpret_cast<gimpm::Umat>(dlsym(handle, function.c_str()));
		}
		if (opened.mfront) opened.reason = opened.mfront->reason;
		return opened;
	}

	// It stays open, as laws of saved steps may still be asked. What could not be opened is tried again.
	const Opened& opened(const string& library, const string& function)
	{
		static std::mutex                                  atWork;
		static std::map<std::pair<string, string>, Opened> all;
		const std::scoped_lock                             lock(atWork);
		Opened&                                            known = all[{ library, function }];
		if (!known.isThere()) known = open(library, function);
		return known;
	}

	gimpm::UmatTensors tensorsOf(const MpmUserMat& m)
	{
		gimpm::UmatTensors tensors { m.stressTensors, m.strainTensors };
		for (auto* numbers : { &tensors.likeStress, &tensors.likeStrain })
			for (int& number : *numbers)
				--number; // from 0 on
		return tensors;
	}

	// Each is there, and none begins within another.
	void requireTensors(const MpmUserMat& m)
	{
		const string expected = "expected numbers of the first of six state variables of each tensor, from 1 on, at least six apart.";
		vector<int>  begins   = m.stressTensors;
		begins.insert(begins.end(), m.strainTensors.begin(), m.strainTensors.end());
		std::sort(begins.begin(), begins.end());
		for (size_t k = 0; k < begins.size(); ++k) {
			const string number = std::to_string(begins[k]), first = "MpmUserMat.stressTensors and strainTensors have " + number;
			if (begins[k] + 5 > int(m.stateVariables.size()))
				throw std::invalid_argument(
				        first + ", and stateVariables " + std::to_string(m.stateVariables.size()) + " numbers: " + expected);
			if (k > 0 && begins[k] < begins[k - 1] + 6)
				throw std::invalid_argument(first + " and " + std::to_string(begins[k - 1]) + ": " + expected);
		}
	}

	std::shared_ptr<const gimpm::UserDoor> doorTo(const MpmUserMat& m)
	{
		const Opened& library    = opened(m.library, m.function);
		const auto    oneAtATime = m.reentrant ? nullptr : library.oneAtATime;
		if (!library.mfront || !library.reason.empty())
			return std::make_shared<const gimpm::UmatDoor>(
			        library.umat, m.parameters, m.stateVariables, oneAtATime, m.label, m.function, tensorsOf(m));
		const MfrontDescription& law = *library.mfront;
		gimpm::MfrontGiven       given { law.call, m.parameters, law.variables, m.stateVariables, -1, law.external, m.density, oneAtATime, m.function };
		given.first.resize(law.numbers(), 0);
		for (size_t k = 0; k < law.variables.size(); ++k)
			if (law.variableNames[k] == "ElasticStrain" && law.variables[k] == gimpm::MfrontGiven::Variable::tensor) given.elasticStrain = int(k);
		return std::make_shared<const gimpm::MfrontDoor>(std::move(given));
	}

	gimpm::Law lawOfUser(const MpmUserMat& m)
	{
		const auto door   = std::const_pointer_cast<gimpm::UserDoor>(doorTo(m));
		door->elastic     = gimpm::Hencky(m.young, m.poisson);
		const int scalars = door->scalars(), fewest = 6, some = 20;
		switch (door->tensors()) { // room for as many numbers as a law may remember
			case 0:
				return scalars == 0         ? gimpm::Law(gimpm::UserLaw<0, 0>(door))
				        : scalars <= fewest ? gimpm::Law(gimpm::UserLaw<0, 6>(door))
				        : scalars <= some   ? gimpm::Law(gimpm::UserLaw<0, 20>(door))
				                            : gimpm::Law(gimpm::UserLaw<0, 40>(door));
			case 1:
				return scalars <= fewest      ? gimpm::Law(gimpm::UserLaw<1, 6>(door))
				        : scalars <= some - 6 ? gimpm::Law(gimpm::UserLaw<1, 14>(door))
				                              : gimpm::Law(gimpm::UserLaw<1, 34>(door));
			case 2: return scalars <= some - 12 ? gimpm::Law(gimpm::UserLaw<2, 8>(door)) : gimpm::Law(gimpm::UserLaw<2, 28>(door));
			case 3: return scalars <= some - 18 ? gimpm::Law(gimpm::UserLaw<3, 2>(door)) : gimpm::Law(gimpm::UserLaw<3, 22>(door));
			case 4: return gimpm::UserLaw<4, 16>(door);
			case 5: return gimpm::UserLaw<5, 10>(door);
			default: return gimpm::UserLaw<6, 4>(door);
		}
	}

	// A law of MFront looks for a file of its name in the working folder when it is first called, and takes what it
	// calls parameters from there.
	void requireNoParameterFile(const string& function)
	{
		string law = function;
		law.erase(std::remove(law.begin(), law.end(), '_'), law.end()); // @Material and @Behaviour together
		for (const string& name : { function, law })
			for (const char* hypothesis : { "", "Tridimensional" }) {
				const string file = name + hypothesis + "-parameters.txt";
				if (std::ifstream(file))
					throw std::invalid_argument(
					        "MpmUserMat.function = '" + function + "': the law of MFront would take its parameters from the file '" + file
					        + "' of the working folder, without a word. Move the file away, or make them material properties of the law and give "
					          "them by MpmUserMat.parameters.");
			}
	}

	string listOf(const vector<string>& names)
	{
		string list;
		for (const string& name : names)
			list += (list.empty() ? "" : ", ") + name;
		return list;
	}

	void requireNumbers(const MpmUserMat& m, const MfrontDescription& law)
	{
		const string of = "of the law '" + m.function + "'";
		if (m.parameters.size() != law.parameters.size())
			throw std::invalid_argument(
			        "MpmUserMat.parameters has " + std::to_string(m.parameters.size()) + " numbers: expected "
			        + std::to_string(law.parameters.size()) + ", " + of + (law.parameters.empty() ? "." : ": " + listOf(law.parameters) + "."));
		if (m.stateVariables.empty() || int(m.stateVariables.size()) == law.numbers()) return;
		vector<string> names = law.variableNames;
		for (size_t k = 0; k < names.size(); ++k)
			if (law.variables[k] == gimpm::MfrontGiven::Variable::tensor) names[k] += " (xx, yy, zz, sqrt2 xy, sqrt2 xz, sqrt2 yz)";
		throw std::invalid_argument(
		        "MpmUserMat.stateVariables has " + std::to_string(m.stateVariables.size()) + " numbers: expected none, for zeros, or "
		        + std::to_string(law.numbers()) + ", " + of + (names.empty() ? "." : ": " + listOf(names) + "."));
	}
}

void MpmUserMat::requireAdmissible() const
{
	ExposedIndexed<MpmUserMat, MpmElasticMat>::requireAdmissible();
	if (timeAttribute())
		throw std::invalid_argument(
		        "MpmUserMat.relaxationTime is not admitted: flow in time is a matter of the law itself, which is told the duration of a step.");
	const Opened& door = opened(library, function);
	if (!door.reason.empty())
		throw std::invalid_argument("MpmUserMat: library = '" + library + "', function = '" + function + "' is not admitted: " + door.reason + ".");
	if (door.isOfMfront) requireNoParameterFile(function);
	if (door.mfront) requireNumbers(*this, *door.mfront);
	if (door.mfront && !(stressTensors.empty() && strainTensors.empty()))
		throw std::invalid_argument(
		        "MpmUserMat.stressTensors and strainTensors are not admitted for the law '" + function
		        + "' of MFront, which names its tensors itself: leave them out.");
	if (!door.mfront) requireTensors(*this);
}

static const RegisteredLaw<MpmUserMat> lawOfMpmUserMat(lawOfUser);
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmUserMat)
static const yade::PluginClasses<yade::MpmUserMat> registeredMpmUserMat(__FILE__);
