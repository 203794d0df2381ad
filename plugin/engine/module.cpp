// SPDX-License-Identifier: GPL-2.0-or-later
// The plugin is also a Python extension module, imported by yade.mpm for what can be checked only when YADE has
// started, and for work on all material points at once.
#include "core/solvers/multigrid.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/conditions/flow/poreWater.hpp"
#include "engine/conditions/water/waterAround.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"
#include "engine/engines/assignment.hpp"
#include "engine/grid/MpmGrid.hpp"
#include "engine/grid/newPoints.hpp"
#include "engine/materials/laws.hpp"
#include "engine/output/gridCells.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include "engine/points/bulkAccess.hpp"
#include "engine/points/columns.hpp"
#include "yade_api/background.hpp"
#include "yade_api/naming.hpp"
#include "yade_api/python_lock.hpp"
#include "yade_api/verification.hpp"

#pragma GCC visibility push(default)
#include <boost/python/module.hpp>
#pragma GCC visibility pop

namespace {
// Defines the single functions of Python.
void defineHelpers()
{
	using namespace yade;
	py::def("warn", &warn, "A warning of module mpm in YADE's log.");
	py::def("assignColumns", &assignColumns, "For mpm.assign: values of the material points with these body ids, from a dict of arrays; all or none.");
	py::def("respond", &respondForPython,
	        "For mpm.respond: one call of the law of a material in principal axes, from trial strains and a dict of internal variables.");
	py::def(
	        "isElastic", +[](const shared_ptr<MpmMaterial>& material) { return isElastic(*material); },
	        "For mpm.advise: whether the law of a material knows no flow.");
	py::def("hasTensorLaw", &hasTensorLaw, "For mpm.respond: whether the law of a material is asked in space.");
	py::def("respondInSpace", &respondInSpaceForPython,
	        "For mpm.respond: one call of a tensor law, from a trial strain, internal variables and a step of time.");
	py::def("stepInSpace", &stepInSpaceForPython, "For mpm.elementTest: a point of a tensor law after an increment of its deformation gradient.");
	py::def("bearing", &bearingForPython, "For mpm.elementTest: the internal variables of a point that bears principal Kirchhoff stresses.");
	py::def("elasticStrainOf", &elasticStrainForPython, "For mpm.elementTest: principal elastic strains of principal Kirchhoff stresses.");
	py::def(
	        "touchableBodies", +[](const MpmImplicitEngine& engine) { return touchableBodiesForPython(engine); },
	        "For mpm.plot: ids of the rigid bodies that the contacts of an engine mean.");
	py::def("poreWater", &poreWaterForPython,
	        "For mpm.geostatic: degrees of saturation, pressures on the grains and relative permeabilities of a material at pressures in an MpmFlow.");
	py::def(
	        "waterAround",
	        +[](const MpmImplicitEngine& engine, const py::object& positions, const py::object& halfSizes) {
		        return waterAroundForPython(engine, positions, halfSizes);
	        },
	        "For mpm.geostatic: pressure and gradient of each water of an engine, averaged over boxes, given their centres and half sizes.");
	py::def(
	        "gridCells", +[](const string& kind, const MpmImplicitEngine& engine) { return gridCellsForPython(kind, engine); },
	        "For mpm.plot: corners and first field of the cells of 'grid', 'ghostFaces', 'loads', 'walls' or 'contacts' around the material points.");
}

void defineStages()
{
	using namespace yade;
	py::def(
	        "actInPart",
	        +[](MpmMaterial& material, Real share, bool isDugOut) {
		        const ValueLock lock;
		        material.share = share, material.isDugOut = isDugOut;
	        },
	        "For mpm.stages: the share of water and point loads that acts on points of a material, whose density is as small; and whether they are being dug out.");
	py::def(
	        "lookAtPlaced",
	        +[](MpmImplicitEngine& engine, const py::list& bodies) {
		        vector<Body::id_t> ids;
		        for (py::ssize_t i = 0; i < py::len(bodies); ++i)
			        ids.push_back(py::extract<Body::id_t>(bodies[i]));
		        engine.lookAtPlaced(ids);
	        },
	        "For mpm.stages: warns of points that have been placed, by their ids, if none of them fits into the grid of the engine.");
}

void defineFilling()
{
	using namespace yade;
	py::def("newBodies", &newBodies,
	        (py::arg("grid"), py::arg("positions"), py::arg("half"), py::arg("materials"), py::arg("index"), py::arg("parameters"), py::arg("body") = -1),
	        "For mpm.fill: bodies from a grid, positions, half sizes, materials, the index of each body's material, and a dict of columns of parameters; "
	        "*body*: the number of their body of points in MpmGrid.bodies.");
	py::def("addPoints", &addPoints,
	        (py::arg("engine"), py::arg("positions"), py::arg("half"), py::arg("materials"), py::arg("index"), py::arg("parameters"), py::arg("body") = -1),
	        "For mpm.add: puts such bodies into the scene of an engine, or where processes divide them each its own; the id of the first.");
}
}

BOOST_PYTHON_MODULE(mpm_engine)
{
	using namespace yade;
	py::scope().attr("version") = MPM_VERSION;
	py::def("verify", &verifyPlugin, "ImportError if YADE does not fit the plugin, or has not registered all of its classes.");
	defineStages();
	defineFilling();
	py::def("cellSizes", &cellSizesForPython, "For mpm.fill: bytearray of the sizes of a grid's cells at positions.");
	py::def("multigridAbsence", &gimpm::Multigrid::absence, "For mpm.advise: why there is no algebraic multigrid; empty if there is.");
	py::def(
	        "bytesSent", +[] { return processes()->sent(); }, "For measurements: what this process has sent to others that mpirun has started.");
	py::def(
	        "timesBodiesWereRead", +[] { return long(timesBodiesWereRead); },
	        "For measurements: how many steps had to read the points from their bodies, as somebody else may have changed them.");
	py::def("isDivided", &isSceneDivided,
	        "Whether several processes have divided the material points of the scene among them (MpmImplicitEngine.distributed).");
	py::def("takePieces", &takePieces, "For mpm.load: the points of all pieces are in the processes that there are now.");
	py::def("betweenSteps", &betweenSteps, "For mpm.save: calls a function while no step in the background changes the state.");
	py::def(
	        "endBackgroundRun",
	        +[] {
		        const PythonUnlock python;
		        endBackgroundRun();
	        },
	        "For mpm.load: ends what O.run(n) has begun, after the step that is being made.");
	py::def("idsOfPoints", &idsOfPoints, "For mpm.assign: bytearray of the ids of the material points.");
	py::def("columnsOfPoints", &columnsOfPoints,
	        "For mpm.arrays: dict of bytearrays with the data of the material points that a mask means, in order of body id.");
	py::def("pointColumns", &pointColumnsForPython, "What there is to know of a material point: a dict with name, unit, label, width ... for each column.");
	py::def(
	        "didYouMean",
	        +[](const string& name, const py::list& known) {
		        vector<string> names;
		        for (py::ssize_t i = 0; i < py::len(known); ++i)
			        names.push_back(py::extract<string>(known[i]));
		        return didYouMean(name, names);
	        },
	        "For messages: the known names that are most like another one, as a question.");
	defineHelpers();
}
