// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/MpmWater.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/water/doubtful_water.hpp"
#include "engine/conditions/water/pressure_table.hpp"
#include "engine/conditions/water/waters.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmWater::requireAdmissible() const
{
	Exposed<MpmWater, MpmCondition>::requireAdmissible();
	vector<string> given;
	if (!std::isnan(level)) given.push_back("level = " + textOf(level));
	if (!levels.empty()) given.push_back("levels");
	if (pressure || !table.empty()) given.push_back(pressure ? "pressure" : "pressure (of a saved scene)");
	if (given.size() == 1) return;
	string all;
	for (const string& one : given)
		all += (all.empty() ? "" : ", ") + one;
	throw std::invalid_argument("MpmWater: one of level, levels and pressure must be given; " + (all.empty() ? "none is" : "given are " + all) + ".");
}

std::shared_ptr<Condition<2>> MpmWater::make(InPlane, const Group& group, const Analysis&) const { return std::make_shared<Waters<2>>(group); }
std::shared_ptr<Condition<3>> MpmWater::make(InSpace, const Group& group, const Analysis&) const { return std::make_shared<Waters<3>>(group); }

Real MpmWater::end(const Analysis& analysis) const
{
	const Real ofCurve = analysis.curveOfWeight(curve).end();
	return levels.empty() ? ofCurve : std::max(ofCurve, gimpm::LoadCurve(levels).end());
}

namespace {
	template <int Dim>
	std::unique_ptr<Question> questionOf(
	        MpmWater& water, const gimpm::Grid<Dim>& grid, const vector<gimpm::Key>& cells, const string& name, const vector<WallInWater>& walls)
	{
		auto question = PressureQuestion<Dim>::of(water, grid, cells, name, When::next, walls);
		return question ? std::make_unique<PressureQuestion<Dim>>(std::move(*question)) : nullptr;
	}
}

std::unique_ptr<Question> MpmWater::question(const gimpm::Grid<2>& grid, const vector<gimpm::Key>& cells, const string& name, const vector<Listed>& all)
{
	if (!hasFunction() || !pressure) return nullptr;
	return questionOf(*this, grid, cells, name, wallsInWater(all, grid));
}

std::unique_ptr<Question> MpmWater::question(const gimpm::Grid<3>& grid, const vector<gimpm::Key>& cells, const string& name, const vector<Listed>&)
{
	if (!hasFunction() || !pressure) return nullptr;
	return questionOf(*this, grid, cells, name, {});
}

std::map<string, string> MpmWater::warnings(const Analysis& analysis, const vector<MaterialPoint>& points, const string& name) const
{
	return { { "unit of water", warningOfWeight(*this, analysis, name) },
		 { "water on both sides", warningOfSides(*this, analysis, points, name) },
		 { "function of water", warningOfLostFunction(*this, name) } };
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmWater)
static const yade::PluginClasses<yade::MpmWater> registeredMpmWater(__FILE__);
