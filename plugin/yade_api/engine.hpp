// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Engines: what a scene runs once per iteration, and the times it spends in them.
#include "yade_api/serializable.hpp"
#include <algorithm>
#include <chrono>

#pragma GCC visibility push(default)
namespace yade {
class Scene;

struct TimingInfo {
	using delta       = unsigned long long;
	long        nExec = 0;
	delta       nsec  = 0;
	static bool enabled; // O.timingEnabled
};

// Phases of an engine, as printed by yade.timing.stats(). YADE's own checkpoints are inline functions of its headers;
// this adds durations that were measured elsewhere.
class TimingDeltas {
	TimingInfo::delta last    = 0;
	size_t            current = 0;

public:
	vector<TimingInfo> data;
	vector<string>     labels;

	void add(const string& label, std::chrono::nanoseconds duration)
	{
		if (!TimingInfo::enabled) return;
		const size_t phase = std::find(labels.begin(), labels.end(), label) - labels.begin();
		if (phase == labels.size()) {
			labels.push_back(label);
			data.emplace_back();
		}
		data[phase].nExec += 1;
		data[phase].nsec += TimingInfo::delta(duration.count());
	}
};

class Engine : public Serializable {
public:
	Scene*                   scene;
	TimingInfo               timingInfo;
	shared_ptr<TimingDeltas> timingDeltas;
	~Engine() override;
	virtual bool isActivated();
	virtual void action();
	bool         dead;
	int          ompThreads;
	string       label;
	Engine();
	YADE_API_OVERRIDES(Engine)
};

class GlobalEngine : public Engine {
public:
	GlobalEngine() { }
	~GlobalEngine() override;
	YADE_API_OVERRIDES(GlobalEngine)
};

class PeriodicEngine : public GlobalEngine {
	static Real wallClock() { return std::chrono::duration<Real>(std::chrono::system_clock::now().time_since_epoch()).count(); }

public:
	PeriodicEngine() : realLast(wallClock()) { }
	~PeriodicEngine() override;
	bool isActivated() override;
	Real virtPeriod = 0, realPeriod = 0;
	long iterPeriod = 0, nDo = -1;
	bool initRun      = false;
	long firstIterRun = 0;
	Real virtLast     = 0, realLast;
	long iterLast = 0, nDone = 0;
	YADE_API_OVERRIDES(PeriodicEngine)
};

static_assert(sizeof(TimingInfo) == 16 && sizeof(TimingDeltas) == 64, "layout of YADE");
static_assert(sizeof(Engine) == 104 && sizeof(GlobalEngine) == 104 && sizeof(PeriodicEngine) == 184, "layout of YADE");
} // namespace yade
#pragma GCC visibility pop
