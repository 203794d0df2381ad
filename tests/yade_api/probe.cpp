// SPDX-License-Identifier: GPL-2.0-or-later
// A plugin that has nothing but one attribute of each type and with each validator, and an engine that fails: for the
// tests of registration. It takes the place of the real one beside the loader.
#include "yade_api/exceptions.hpp"
#include "yade_api/logging.hpp"
#include "yade_api/registration.hpp"
#include "yade_api/verification.hpp"

#pragma GCC visibility push(default)
#include <boost/python/module.hpp>
#pragma GCC visibility pop

namespace yade {

class ProbeItem : public Exposed<ProbeItem, Serializable> {
public:
	Vector3r low   = Vector3r::Constant(-std::numeric_limits<Real>::infinity());
	Vector3r sizes = Vector3r::Ones();
	string   letters;

	YADE_API_NAME(ProbeItem)
	static const char*             doc() { return "An item of a list."; }
	template <class V> static void attributes(V&& v)
	{
		v("low", &ProbeItem::low, 0, "Lower corner.", notNaN);
		v("sizes", &ProbeItem::sizes, 0, "Sizes.", positive);
		v("letters", &ProbeItem::letters, 0, "Letters.", admitting("letters out of 'xyz'", onlyXyz));
	}
	static bool onlyXyz(const string& s) { return s.find_first_not_of("xyz") == string::npos; }
};

class ProbeState : public ExposedIndexed<ProbeState, State> {
public:
	Matrix3r matrix = Matrix3r::Identity();
	Vector3r vector = Vector3r::Zero();
	Vector3r fixed  = Vector3r::Ones();

	YADE_API_NAME(ProbeState)
	static const char*             doc() { return "A state."; }
	template <class V> static void attributes(V&& v)
	{
		v("matrix", &ProbeState::matrix, 0, "Matrix.", finite);
		v("vector", &ProbeState::vector, 0, "Vector.", finite);
		v("fixed", &ProbeState::fixed, readonly, "Vector that is only read.");
	}
};

class ProbeMat : public ExposedIndexed<ProbeMat, Material> {
public:
	Real young = 1;

	YADE_API_NAME(ProbeMat)
	static const char*             doc() { return "A material."; }
	template <class V> static void attributes(V&& v)
	{
		v("density", &ProbeMat::density, noSave, "Density.", positive); // attribute of Material
		v("young", &ProbeMat::young, 0, "Stiffness.", positive);
	}
	shared_ptr<State> newAssocState() const override { return shared_ptr<State>(new ProbeState); }
	bool              stateTypeOk(State* state) const override { return dynamic_cast<ProbeState*>(state); }
};

class ProbeDerivedMat : public ExposedIndexed<ProbeDerivedMat, ProbeMat> {
public:
	Real poisson = 0;
	Real limit   = 0;

	YADE_API_NAME(ProbeDerivedMat)
	static const char*             doc() { return "A material derived from another of the plugin."; }
	template <class V> static void attributes(V&& v)
	{
		v("poisson", &ProbeDerivedMat::poisson, 0, "Ratio.", strictlyBetween(-1, 0.5));
		v("limit", &ProbeDerivedMat::limit, 0, "Limit.", nonNegative);
	}
};

class ProbeEngine : public Exposed<ProbeEngine, PeriodicEngine> {
public:
	ProbeEngine()
	{
		iterPeriod = 1;
		initRun    = true;
		timingDeltas.reset(new TimingDeltas);
	}
	shared_ptr<ProbeItem>         item;
	vector<shared_ptr<ProbeItem>> items;
	vector<std::pair<Real, Real>> curve;
	vector<string>                names;
	vector<Vector3r>              points;
	bool                          flag    = false;
	int                           choice  = 2;
	long                          count   = 1;
	Real                          number  = 0;
	string                        scaling = "first";
	int                           runs = 0, posts = 0, secret = 0;
	long                          failAt = -1;

	YADE_API_NAME(ProbeEngine)
	static const char*             doc() { return "An engine."; }
	template <class V> static void attributes(V&& v)
	{
		v("item", &ProbeEngine::item, 0, "Item.");
		v("items", &ProbeEngine::items, 0, "Items.");
		v("curve", &ProbeEngine::curve, triggerPostLoad, "Curve.");
		v("names", &ProbeEngine::names, 0, "Names.");
		v("points", &ProbeEngine::points, 0, "Points.");
		v("flag", &ProbeEngine::flag, 0, "Flag.");
		v("choice", &ProbeEngine::choice, 0, "Choice.", oneOf(2, 3));
		v("count", &ProbeEngine::count, 0, "Count.", atLeast(1));
		v("number", &ProbeEngine::number, 0, "Number.");
		v("scaling", &ProbeEngine::scaling, 0, "Scaling.", oneOf("first", "second"));
		v("runs", &ProbeEngine::runs, readonly, "Calls of action().");
		v("posts", &ProbeEngine::posts, readonly | noSave, "Calls of postLoad().");
		v("secret", &ProbeEngine::secret, hidden, "Not for Python.");
		v("failAt", &ProbeEngine::failAt, 0, "Iteration in which to fail.");
	}
	template <class C> static void python(C& c) { c.def("doubled", &ProbeEngine::doubled, "Twice the number."); }

	void postLoad() { posts++; }
	Real doubled() const { return 2 * number; }
	void action() override
	{
		deliveringErrors(*scene, [&] {
			requireAdmissible();
			if (item) item->requireAdmissible();
			if (scene->iter == failAt) throw std::runtime_error("asked to fail");
			if (runs++ == 0) log(Severity::warning, "ProbeEngine", "first run");
			timingDeltas->add("phase", std::chrono::nanoseconds(7));
		});
	}
};

} // namespace yade

BOOST_CLASS_EXPORT(yade::ProbeItem)
BOOST_CLASS_EXPORT(yade::ProbeState)
BOOST_CLASS_EXPORT(yade::ProbeMat)
BOOST_CLASS_EXPORT(yade::ProbeDerivedMat)
BOOST_CLASS_EXPORT(yade::ProbeEngine)
static const yade::PluginClasses<yade::ProbeItem, yade::ProbeState, yade::ProbeMat, yade::ProbeDerivedMat, yade::ProbeEngine> registered(__FILE__);

BOOST_PYTHON_MODULE(mpm_engine) { boost::python::def("verify", &yade::verifyPlugin); }
