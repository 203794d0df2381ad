// SPDX-License-Identifier: GPL-2.0-or-later
// The plugin is also a Python extension module, imported by yade.mpm for what can be checked only when YADE has started, and for
// work on all material points at once.
#include "engine/bulkAccess.hpp"
#include "yade_api/verification.hpp"

BOOST_PYTHON_MODULE(mpm_engine)
{
	using namespace yade;
	py::def("verify", &verifyPlugin, "ImportError if YADE does not fit the plugin, or has not registered all of its classes.");
	py::def("newBodies", &newBodies, "For mpm.fill: bodies from positions, half size, materials, and the index of each body's material.");
	py::def("columnsOfPoints", &columnsOfPoints, "For mpm.arrays: dict of bytearrays with the data of all material points in order of body id.");
}
