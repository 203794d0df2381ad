// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/MpmImplicitEngine.hpp"

namespace yade {

shared_ptr<Scene> MpmImplicitEngine::ownScene() const
{
	const auto& current = Singleton<Omega>::instance().getScene();
	const auto  holds
	        = [this](const Scene& s) { return std::any_of(s.engines.begin(), s.engines.end(), [this](const auto& e) { return e.get() == this; }); };
	if (holds(*current)) home = current;
	const auto other = boost::dynamic_pointer_cast<Scene>(home.lock());
	return other && holds(*other) ? other : current;
}

} // namespace yade
