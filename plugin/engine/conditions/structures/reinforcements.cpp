// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/structures/reinforcements.hpp"
#include "core/structures/structure_force.hpp"
#include "engine/conditions/surface/surfaces.hpp"

namespace yade {

void requireStructuresFit(const Analysis& analysis, const string& kind, const string& name)
{
	string what;
	if (analysis.isExplicit()) what = "explicit steps, which its stiffness would limit; use an implicit scheme";
	else if (analysis.distributed)
		what = "distributed=True: the soil around it is in several processes";
	if (!what.empty()) throw std::invalid_argument(name + ": " + kind + " cannot go with " + what + ".");
}

template <int Dim> std::vector<gimpm::Vec<Dim>> fineLine(const std::vector<gimpm::Vec<Dim>>& line, const string& name, const gimpm::Grid<Dim>& grid)
{
	constexpr Real most    = 5000;
	const Real     longest = gimpm::lengthOfPieces * grid.cellSize;
	Real           pieces  = 0;
	for (size_t i = 1; i < line.size(); ++i)
		pieces += std::max<Real>(1, (line[i] - line[i - 1]).norm() / longest);
	if (!(pieces <= most))
		throw std::invalid_argument(
		        name + ".line would have " + textOf(std::round(pieces)) + " pieces of half a cell, " + textOf(longest) + " m: at most " + textOf(most)
		        + " are admitted. Are its points in metres?");
	return gimpm::divided<Dim>(line, longest);
}

namespace {
	// The free length is one piece, the rest is divided.
	template <int Dim> std::vector<gimpm::Vec<Dim>> verticesOf(const MpmReinforcement& from, const string& name, const gimpm::Grid<Dim>& grid)
	{
		auto line = inDimension<Dim>(placesOf(from.line));
		if (from.freeLength == 0) return fineLine<Dim>(line, name, grid);
		const gimpm::Vec<Dim> head = line[0];
		line[0] += from.freeLength * (line[1] - line[0]).normalized();
		auto vertices = fineLine<Dim>(line, name, grid);
		vertices.insert(vertices.begin(), head);
		return vertices;
	}
}

template <int Dim> gimpm::Reinforcement<Dim> coreBar(const MpmReinforcement& from, const string& name, const gimpm::Grid<Dim>& grid)
{
	using Head = typename gimpm::Reinforcement<Dim>::Head;
	gimpm::Reinforcement<Dim> bar;
	bar.name          = name;
	bar.section       = { from.axialStiffness, from.strength, from.tensionOnly };
	bar.head          = from.headPlate ? Head::plate : from.freeLength > 0 ? Head::pulled : Head::bonded;
	bar.hasFreeLength = from.freeLength > 0;
	bar.bondStiffness = from.bondStiffness;
	bar.bond          = from.bond;
	if (from.friction > 0) bar.friction = (std::isnan(from.perimeter) ? 2 : from.perimeter) * std::tan(from.friction);
	if (from.vertices.empty()) {
		bar.begin(verticesOf<Dim>(from, name, grid));
		return bar;
	}
	bar.positions = inDimension<Dim>(from.vertices);
	bar.length0   = from.lengths;
	bar.strain    = from.strains;
	bar.force     = from.axialForces;
	bar.bondForce = from.bondForces;
	bar.slip      = from.slips;
	return bar;
}

template <int Dim> void scatterBar(const gimpm::Reinforcement<Dim>& bar, MpmReinforcement& to)
{
	to.vertices    = inSpace<Dim>(bar.positions, placesOf(to.line).front()[2]);
	to.lengths     = bar.length0;
	to.strains     = bar.strain;
	to.axialForces = bar.force;
	to.bondForces  = bar.bondForce;
	to.slips       = bar.slip;
	to.isStressed  = to.isStressed || bar.jack.has_value();
}

template <int Dim> void loadBar(gimpm::Reinforcement<Dim>& bar, const MpmReinforcement& from, const gimpm::LoadCurve& curve, const StepTime& step)
{
	const Real before = curve.valueAt(step.from), now = curve.valueAt(step.to);
	bar.pull       = now * from.pull;
	bar.pullBefore = before * from.pull;
	bar.jack.reset();
	if (from.pretension > 0 && (now != before || !from.isStressed)) bar.jack = now * from.pretension;
}

// A study makes all moduli larger and leaves what has moved in its place.
template <int Dim> void joinStructure(gimpm::Structure<Dim>& structure, gimpm::Model<Dim>& model)
{
	using Vec = gimpm::Vec<Dim>;
	model.coupledTerms.push_back([&structure](const gimpm::StepContext<Dim>& step, const gimpm::State&) {
		return std::make_unique<gimpm::StructureForce<Dim>>(structure, step);
	});
	const auto places = std::make_shared<std::vector<std::vector<Vec>>>();
	model.inPlace.push_back({ [&structure, places](const gimpm::PointCloud<Dim>&, Real scale) {
		                         structure.stiffen(scale);
		                         *places = structure.positions();
	                         },
	                          [&structure, places](const gimpm::PointCloud<Dim>&) { structure.putBack(*places); } });
}

template <int Dim> void Reinforcements<Dim>::join(gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	for (const Listed& listed : group) {
		const auto from = boost::static_pointer_cast<MpmReinforcement>(listed.condition);
		sources.push_back({ from, around.analysis.curveOfLoad(from->curve) });
		structures.push_back({ { coreBar<Dim>(*from, listed.name(), model.grid) } });
	}
	for (auto& structure : structures)
		joinStructure<Dim>(structure, model);
}

template <int Dim> void Reinforcements<Dim>::advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>&)
{
	for (size_t i = 0; i < sources.size(); ++i)
		loadBar<Dim>(structures[i].bars[0], *sources[i].from, sources[i].curve, step);
}

template <int Dim> Work Reinforcements<Dim>::work(const StepOutcome<Dim>&) const
{
	Work sum;
	for (const auto& structure : structures)
		sum.ofLoads += structure.work;
	return sum;
}

template <int Dim> void Reinforcements<Dim>::reach(const StepOutcome<Dim>&)
{
	for (size_t i = 0; i < sources.size(); ++i)
		scatterBar<Dim>(structures[i].bars[0], *sources[i].from);
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template std::vector<gimpm::Vec<Dim>> fineLine<Dim>(const std::vector<gimpm::Vec<Dim>>&, const string&, const gimpm::Grid<Dim>&);                      \
	template gimpm::Reinforcement<Dim>    coreBar<Dim>(const MpmReinforcement&, const string&, const gimpm::Grid<Dim>&);                                   \
	template void                         scatterBar<Dim>(const gimpm::Reinforcement<Dim>&, MpmReinforcement&);                                            \
	template void                         loadBar<Dim>(gimpm::Reinforcement<Dim>&, const MpmReinforcement&, const gimpm::LoadCurve&, const StepTime&);     \
	template void                         joinStructure<Dim>(gimpm::Structure<Dim>&, gimpm::Model<Dim>&);                                                  \
	template class Reinforcements<Dim>;
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
