// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The scene, and the singletons that own scenes, run them and create objects by class name.
#include "yade_api/body.hpp"
#include "yade_api/engine.hpp"
#include <atomic>
#include <map>
#include <mutex>
#include <set>

#pragma GCC visibility push(default)
namespace yade {
class Cell;
class DisplayParameters;
class EnergyTracker;
class InteractionContainer;
class OpenGLRenderer;

// Generalised forces on bodies, summed over threads by sync().
class ForceContainer {
	using Vectors = vector<Vector3r>;
	vector<Vectors> forceData, torqueData; // per thread (OPENMP)
	vector<int>     maxId;
	vector<size_t>  sizeOfThreads;
	Vectors         force, torque, permForce, permTorque;
	size_t          size;
	bool            syncedSizes;
	int             nThreads;
	bool            permForceUsed, permForceSynced;
	std::mutex      globalMutex;
	Vector3r        zero;

public:
	bool          synced;
	unsigned long syncCount;
	long          lastReset;
	ForceContainer();
	const Vector3r& getForce(int);
	void            addForce(int, const Vector3r&);
	const Vector3r& getTorque(int);
	void            addTorque(int, const Vector3r&);
	void            sync();
};

class Scene : public Serializable {
	const unsigned hostNameMax = 255;

public:
	ForceContainer             forces;
	Eigen::Matrix<Real, 10, 1> SpeedElements;
#ifdef YADE_API_LIQMIGRATION
	struct PerThread {
		vector<vector<void*>> values;
		size_t                size;
	} addIntrs, delIntrs;
#endif
#ifdef YADE_API_QT5
	shared_ptr<OpenGLRenderer> renderer;
#endif
	long prevTime; // boost::posix_time::ptime
	Real dt;
	long iter;
	bool subStepping;
	int  subStep;
	Real time, speed;
	long stopAtIter;
	Real stopAtTime;
	bool isPeriodic, trackEnergy, doSort, runInternalConsistencyChecks;
	int  selectedBody;
#ifdef YADE_API_MPI
	int               subdomain;
	shared_ptr<Shape> subD;
#endif
	vector<string>                        tags;
	vector<shared_ptr<Engine>>            engines, _nextEngines;
	shared_ptr<BodyContainer>             bodies;
	shared_ptr<InteractionContainer>      interactions;
	shared_ptr<EnergyTracker>             energy;
	vector<shared_ptr<Material>>          materials;
	shared_ptr<Bound>                     bound;
	shared_ptr<Cell>                      cell;
	vector<shared_ptr<Serializable>>      miscParams;
	vector<shared_ptr<DisplayParameters>> dispParams;
	Scene();
	~Scene() override;
	// True if a TimeStepper among the engines sets dt; std::runtime_error if there are several.
	bool timeStepperActive();
	YADE_API_OVERRIDES(Scene)
};

struct DynlibDescriptor {
	std::set<string> baseClasses;
	bool             isSerializable;
};

// Runs the simulation loop in its own thread; created and owned by libyade.so.
struct ThreadRunner {
	void*              worker;
	std::atomic_bool   looping;
	std::mutex         callMutex, runMutex;
	std::runtime_error workerException;
	std::atomic_bool   workerThrew;
};

class Omega : public Singleton<Omega> {
	Omega();

public:
	shared_ptr<ThreadRunner>                  simulationLoop; // first member; the others are left out
	bool                                      isRunning();    // in the background, by O.run()
	const std::map<string, DynlibDescriptor>& getDynlibsDescriptor() const;
	const shared_ptr<Scene>&                  getScene() const;
};

class ClassFactory : public Singleton<ClassFactory> {
	ClassFactory();

public:
	virtual ~ClassFactory();
	bool                   registerFactorable(string, Factorable* (*)(), shared_ptr<Factorable> (*)(), void* (*)());
	void                   registerPluginClasses(const char**); // file name, class names, nullptr
	shared_ptr<Factorable> createShared(string);
};

static_assert(sizeof(ForceContainer) == 304, "layout of YADE");
} // namespace yade
#pragma GCC visibility pop
