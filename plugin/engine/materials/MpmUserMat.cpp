// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmUserMat.hpp"
#include "core/materials/user_law.hpp"
#include "engine/materials/law_of_class.hpp"
#include "yade_api/registration.hpp"
#include <dlfcn.h>
#include <map>

namespace yade {

namespace {
	// One of each function, whoever calls it.
	struct Opened {
		gimpm::Umat                 call = nullptr;
		std::shared_ptr<std::mutex> oneAtATime { new std::mutex };
		string                      reason; // why there is none
	};

	Opened open(const string& library, const string& function)
	{
		Opened opened;
		void*  handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
		if (!handle) {
			opened.reason = string("the library cannot be opened (") + dlerror() + ")";
			return opened;
		}
		opened.call = reinterpret_cast<gimpm::Umat>(dlsym(handle, function.c_str()));
		if (!opened.call)
			opened.reason = "the library has no function of this name; `nm -D " + library
			        + "` lists those that it has. Fortran writes small letters and an underscore behind them";
		return opened;
	}

	// It stays open, as laws of saved steps may still be asked. What could not be opened is tried again.
	const Opened& opened(const string& library, const string& function)
	{
		static std::mutex                                  atWork;
		static std::map<std::pair<string, string>, Opened> all;
		const std::scoped_lock                             lock(atWork);
		Opened&                                            known = all[{ library, function }];
		if (!known.call) known = open(library, function);
		return known;
	}

	gimpm::Law lawOfUser(const MpmUserMat& m)
	{
		const Opened&       door = opened(m.library, m.function);
		gimpm::UserLawGiven given { door.call, gimpm::UserLawGiven::padded(m.parameters), m.stateVariables, gimpm::Hencky(m.young, m.poisson),
			                    m.reentrant ? nullptr : door.oneAtATime };
		const auto          shared = std::make_shared<const gimpm::UserLawGiven>(std::move(given));
		if (m.stateVariables.empty()) return gimpm::UserLaw<0>(shared);
		if (m.stateVariables.size() <= 6) return gimpm::UserLaw<6>(shared);
		return gimpm::UserLaw<int(MpmUserMat::mostStates)>(shared);
	}
}

void MpmUserMat::requireAdmissible() const
{
	ExposedIndexed<MpmUserMat, MpmElasticMat>::requireAdmissible();
	if (timeAttribute())
		throw std::invalid_argument(
		        "MpmUserMat.relaxationTime is not admitted: flow in time is a matter of the law itself, which is told the duration of a step.");
	const Opened& door = opened(library, function);
	if (!door.call)
		throw std::invalid_argument("MpmUserMat: library = '" + library + "', function = '" + function + "' is not admitted: " + door.reason + ".");
}

static const RegisteredLaw<MpmUserMat> lawOfMpmUserMat(lawOfUser);
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmUserMat)
static const yade::PluginClasses<yade::MpmUserMat> registeredMpmUserMat(__FILE__);
