// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/logging.hpp"
#include "yade_api/types.hpp"

#pragma GCC visibility push(default)
#include <boost/log/sources/record_ostream.hpp>
#include <boost/log/sources/severity_logger.hpp>
#include <map>
#include <mutex>

class Logging : public Singleton<Logging> { // in the global namespace, as in libyade.so
public:
	enum SeverityLevel { eNOFILTER, eFATAL, eERROR, eWARN, eINFO, eDEBUG, eTRACE };
	boost::log::sources::severity_logger<SeverityLevel> createNamedLogger(std::string);
};
#pragma GCC visibility pop

namespace yade {
void log(Severity severity, const std::string& className, const std::string& message)
{
	using Logger = boost::log::sources::severity_logger<Logging::SeverityLevel>;
	static std::mutex                    guard;
	static std::map<std::string, Logger> loggers;

	const std::lock_guard<std::mutex> lock(guard);
	auto                              logger = loggers.find(className);
	if (logger == loggers.end()) logger = loggers.emplace(className, Singleton<Logging>::instance().createNamedLogger(className)).first;
	BOOST_LOG_SEV(logger->second, Logging::SeverityLevel(severity)) << ": " << message;
}
} // namespace yade
