// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Settings, conditions and results of an analysis: an engine, as everything below the engines
// knows it.
#include "core/stepping/load_curve.hpp"
#include "core/stepping/model.hpp"
#include "engine/analysis/MpmCondition.hpp"
#include "engine/analysis/MpmGhost.hpp"
#include "engine/analysis/MpmNewton.hpp"
#include "engine/analysis/RunResults.hpp"
#include "engine/grid/MpmGrid.hpp"
#include "yade_api/scene.hpp"

namespace yade {
struct MaterialPoint;
class KeptColumns;

class Analysis : public RunResults {
public:
	shared_ptr<MpmGrid>     grid;
	string                  basis              = "gimp";
	string                  domains            = "tiling";
	bool                    fBar               = false;
	bool                    pressureRelaxation = false;
	Vector3r                gravity            = Vector3r::Zero();
	gimpm::LoadCurve::Knees loadCurve { { 0, 0 }, { 1, 1 } };
	gimpm::LoadCurve::Knees gravityCurve; // empty: loadCurve
	shared_ptr<MpmGhost>    ghost { new MpmGhost };
	shared_ptr<MpmNewton>   newton { new MpmNewton };
	int                     mask           = -1;
	Real                    loadTime       = 0;
	int                     maxSplits      = 0;
	bool                    distributed    = false;
	Real                    nonlocalLength = 0; // none

	virtual ~Analysis() = default;

	// Conditions on the material points, in the order of their terms.
	virtual vector<Listed> conditions() const = 0;

	virtual bool          isDynamic() const { return false; }
	virtual bool          isExplicit() const { return false; }
	virtual void          tellMotion(py::dict&) const { }
	virtual std::uint64_t checksumInTime() const { return 0; } // settings of time steps

	// The engine.
	virtual string            className() const         = 0;
	virtual void              requireAttributes() const = 0; // std::invalid_argument names one that is not admitted
	virtual shared_ptr<Scene> ownScene() const          = 0; // scene that has the engine
	virtual Scene&            sceneOfRun() const        = 0; // scene in which it was called
	virtual long              period() const            = 0; // iterations from run to run
	virtual long              runs() const              = 0; // so far

	// Material points of the last run, in this process.
	virtual const vector<MaterialPoint>& pointsOfLastRun() const = 0;
	virtual const KeptColumns&           keptColumns() const     = 0;

	gimpm::DomainRule domainRule() const { return domains == "stretch" ? gimpm::DomainRule::stretch : gimpm::DomainRule::tiling; }

	gimpm::LoadCurve curveOfLoads() const { return gimpm::LoadCurve(loadCurve); }
	gimpm::LoadCurve curveOfGravity() const { return gimpm::LoadCurve(gravityCurve.empty() ? loadCurve : gravityCurve); }

	// An own curve, or where it is empty that of the loads, or of gravity.
	gimpm::LoadCurve curveOfLoad(const gimpm::LoadCurve::Knees& own) const { return own.empty() ? curveOfLoads() : gimpm::LoadCurve(own); }
	gimpm::LoadCurve curveOfWeight(const gimpm::LoadCurve::Knees& own) const { return own.empty() ? curveOfGravity() : gimpm::LoadCurve(own); }

	// When the last of the histories has come to rest.
	Real loadsEnd() const;

	// std::invalid_argument names one of a condition; who makes conditions asks before, as they do not ask.
	void requireConditions() const;

	// True if there is contact between bodies of points: a condition gives them nodes of their own.
	bool bodiesMeet() const;

	// Number of conditions in an attribute.
	size_t countOf(const string& list) const;

	template <int Dim> gimpm::Load<Dim> loadBetween(Real begin, Real end) const
	{
		gimpm::Load<Dim> load { gravity.head<Dim>(), curveOfLoads().between(begin, end) };
		load.duration = end - begin;
		if (!gravityCurve.empty()) load.ofGravity = curveOfGravity().between(begin, end);
		return load;
	}
};

} // namespace yade
