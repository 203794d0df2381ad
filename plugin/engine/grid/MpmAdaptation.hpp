// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"
#include "yade_api/python_function.hpp"
#pragma GCC visibility push(default)
#include <boost/serialization/nvp.hpp>
#pragma GCC visibility pop

namespace yade {

// Rule that says where cells are halved: one by name, or the size of cells as a function of the position.
struct AdaptationRule {
	string         name;
	PythonFunction size {};

	static constexpr const char* byFunction = "function";

	bool                          operator==(const char* other) const { return name == other; }
	template <class Archive> void serialize(Archive& archive, unsigned) { archive& boost::serialization::make_nvp("name", name); }
};

inline string textOf(const AdaptationRule& rule) { return rule.size ? textOf(rule.size) : textOf(rule.name); }

template <> struct Conversion<AdaptationRule> {
	static string                        expected() { return "a string, or a function of the position"; }
	static std::optional<AdaptationRule> fromPython(const py::object& value)
	{
		if (const auto name = Conversion<string>::fromPython(value)) return AdaptationRule { *name };
		const auto size = Conversion<PythonFunction>::fromPython(value);
		if (!size || !*size) return std::nullopt;
		return AdaptationRule { AdaptationRule::byFunction, *size };
	}
	static py::object toPython(const AdaptationRule& rule)
	{
		return rule.size ? Conversion<PythonFunction>::toPython(rule.size) : Conversion<string>::toPython(rule.name);
	}
};

class MpmAdaptation : public Exposed<MpmAdaptation, Serializable> {
public:
	int            halvings = 1;
	AdaptationRule where { "contact" };
	Real           maxUnknowns = std::numeric_limits<Real>::infinity();
	bool           merge       = true;

	// Centres of cells that the function wants to be halved, for each size; of the coming step.
	vector<vector<Vector3r>> wanted;

	YADE_API_NAME(MpmAdaptation)
	static const char* doc()
	{
		return "Cells of an MpmGrid that are halved by themselves, anew in each step, where a cell costs most accuracy: around edges, tips and round surfaces of "
		       "rigid bodies, or where the deformation varies most. Cells around them are halved as often as it takes for neighbours to differ by one halving at most.\n\n"
		       "Set first: *halvings* = 1 and the *cellSize* of a run without; then 2, to see what changes. Page: plugin/docs/classes/MpmAdaptation.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("halvings", &MpmAdaptation::halvings, 0, "Number of times that cells of *MpmGrid.cellSize* are halved, 1 to 5, with dim=3 to 3.",
		  oneOf(1, 2, 3, 4, 5));
		v("where", &MpmAdaptation::where, 0,
		  "'contact': edges and round surfaces of bodies; 'error': largest errors of the deformation gradient, until 5 % are left; a function of the position: "
		  "wanted size [m], asked each step.",
		  admitting("'contact', 'error', or a function of the position (files do not keep it)", [](const AdaptationRule& rule) {
			  return rule == "contact" || rule == "error" || rule.size;
		  }));
		v("maxUnknowns", &MpmAdaptation::maxUnknowns, 0,
		  "Displacement unknowns [-] > 0 that a step may have, as estimated from the cells: beyond them cells are halved less often, with a warning; inf, the default: no limit.",
		  admitting("a number > 0, or inf", [](Real most) { return most > 0; }));
		v("merge", &MpmAdaptation::merge, 0,
		  "True, the default: halves of points become one again where cells are no longer halved and the halves are alike. False: they stay.");
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmAdaptation)
