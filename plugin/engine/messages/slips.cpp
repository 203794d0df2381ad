// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/slips.hpp"
#include "core/base/sentence.hpp"
#include "core/stepping/plane_slip.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/materials/MpmDruckerPragerMat.hpp"
#include "engine/materials/MpmMohrCoulombMat.hpp"

namespace yade {

namespace {
	// Strength of a material that bears no more than Mohr and Coulomb's law.
	std::optional<gimpm::Strength> strengthOf(const MpmMaterial& material, const gimpm::Material& law)
	{
		const auto* frictional = dynamic_cast<const MpmFrictionalMat*>(&material);
		const auto* cone       = dynamic_cast<const MpmDruckerPragerMat*>(&material);
		if (!frictional || law.varies || law.waterModulus > 0 || frictional->timeAttribute() || frictional->frictionAngle == 0
		    || (cone && cone->match != "plane-strain"))
			return {};
		return gimpm::Strength { frictional->cohesion, frictional->frictionAngle };
	}

	template <int Dim>
	vector<std::optional<gimpm::Strength>> strengths(
	        const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model)
	{
		vector<std::optional<gimpm::Strength>> found(model.materials.size());
		vector<char>                           isKnown(found.size());
		for (size_t p = 0; p < points.size(); ++p) {
			const int material = cloud.material[p];
			if (!std::exchange(isKnown[material], 1)) found[material] = strengthOf(*points[p].material, model.materials[material]);
		}
		return found;
	}

	template <int Dim> bool actsAlone(const Analysis& engine, const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model)
	{
		const auto& grid = model.grid;
		return !engine.isDynamic() && !engine.gravity.isZero(0) && (engine.gravity.array() != 0).count() == 1 && cloud.force.empty()
		        && cloud.layer.empty() && model.division->isWhole() && model.walls.empty() && model.fields.empty() && !grid.isPeriodic()
		        && !grid.axisymmetric && !grid.refinement && !grid.parting && engine.conditions().size() == engine.countOf("boundaries");
	}
}

template <int Dim>
string warningOfSlip(const Analysis& engine, const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model)
{
	constexpr Real much = 1.1;
	if (points.size() != cloud.size() || !actsAlone(engine, cloud, model)) return "";
	const auto strength = strengths(points, cloud, model);
	if (std::none_of(strength.begin(), strength.end(), [](const auto& one) { return bool(one); })) return "";
	const Real   pull = engine.gravity.norm() * engine.curveOfGravity().valueAt(engine.loadTime);
	vector<Real> weight(cloud.size());
	for (size_t p = 0; p < weight.size(); ++p)
		weight[p] = pull * model.materials[cloud.material[p]].density * cloud.volume0[p];
	const gimpm::Vec<Dim> down = engine.gravity.normalized().head<Dim>();
	const auto            slip = gimpm::worstPlaneSlip<Dim>(cloud, model.grid, model.boundary, strength, weight, down);
	if (!slip || !(slip->excess > much)) return "";
	std::ostringstream text;
	text << "in the step to O.time = " << engine.loadTime << " the face of " << slip->height << " m (" << slip->height / model.grid.cellSize
	     << " cells) above (" << slip->foot.transpose() << ") stands, which its strength cannot bear: on a plane of "
	     << std::lround(slip->angle * 180 / M_PI) << " degrees through its foot "
	     << (std::isfinite(slip->excess) ? "the weight does " + gimpm::sentence(slip->excess) + " times the work that its cohesion can take up"
	                                     : string("soil without cohesion slides"))
	     << " (Coulomb 1776). Too few cells or the stabilisation support it. fBar=True with ghost=MpmGhost(where='aggregates', memory=1, workTolerance=0.03), and "
	        "smaller cells, let it fail. This is said once.";
	return text.str();
}

template string warningOfSlip(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<2>&, const gimpm::Model<2>&);
template string warningOfSlip(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<3>&, const gimpm::Model<3>&);

} // namespace yade
