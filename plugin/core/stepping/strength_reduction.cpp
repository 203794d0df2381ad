// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/strength_reduction.hpp"
#include <algorithm>
#include <limits>
#include <sstream>

namespace gimpm {
namespace {

template <int Dim> double largestStrain(const PointCloud<Dim>& cloud)
{
	double largest = 0;
	for (const auto& strain : cloud.elasticStrain)
		largest = std::max(largest, strain.c.norm());
	return largest;
}

/// Along the axes of the grid, but for periodic ones: there the body has no end.
template <int Dim> double smallestExtent(const PointCloud<Dim>& cloud, const Grid<Dim>& grid)
{
	Vec<Dim> lower = cloud.position[0], upper = lower;
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		lower = lower.cwiseMin(cloud.position[p] - cloud.halfSize[p]);
		upper = upper.cwiseMax(cloud.position[p] + cloud.halfSize[p]);
	}
	double smallest = std::numeric_limits<double>::infinity();
	for (int a = 0; a < Dim; ++a)
		if (grid.period[a] == 0) smallest = std::min(smallest, upper[a] - lower[a]);
	return smallest;
}

template <int Dim> void scaleStrains(PointCloud<Dim>& cloud, double by)
{
	for (auto& strain : cloud.elasticStrain)
		strain.c *= by;
	for (std::size_t k = 0; k < cloud.internals.size(); ++k)
		if (internalVariables[int(k)].least <= 0) // positive variables are no strains, but ratios that stay
			for (double& value : cloud.internals[k])
				value *= by;
}

template <int Dim> ParameterColumns weakParameters(const Model<Dim>& model, const PointCloud<Dim>& cloud, const Weakening& w)
{
	ParameterColumns columns;
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		const Material& material = model.materials[cloud.material[p]];
		if (!material.varies) continue;
		const auto values = material.law->weakened(cloud.parameters, p, w);
		columns.resize(std::max(columns.size(), values.size()));
		for (std::size_t k = 0; k < values.size(); ++k) {
			columns[k].resize(cloud.size());
			columns[k][p] = values[k];
		}
	}
	return columns;
}

template <int Dim> std::vector<Material> weakMaterials(const Model<Dim>& model, const Weakening& w)
{
	auto materials = model.materials;
	for (Material& material : materials)
		material.law = material.law->with(material.law->weakened({}, 0, w));
	return materials;
}

/// The points in their places, with the state that the laws have given them.
template <int Dim> void takeState(PointCloud<Dim>& to, const PointCloud<Dim>& from)
{
	to.elasticStrain = from.elasticStrain;
	to.internals     = from.internals;
}

template <int Dim> double add(std::vector<Vec<Dim>>& sum, const PointCloud<Dim>& moved, const PointCloud<Dim>& from)
{
	double largest = 0;
	for (std::size_t p = 0; p < sum.size(); ++p) {
		sum[p] += moved.position[p] - from.position[p];
		largest = std::max(largest, sum[p].norm());
	}
	return largest;
}

std::vector<double> plasticStrainOf(const InternalColumns& columns, std::size_t points)
{
	const std::size_t column = internalVariables.find(equivalentPlasticStrain.name);
	return column < columns.size() && !columns[column].empty() ? columns[column] : std::vector<double>(points);
}

std::string beyondSmall(double largest, double limit)
{
	std::ostringstream text;
	text << "it flows: displacements are " << flowsBeyond * largest / limit << " times the largest elastic strain times the smallest extent of the body";
	return text.str();
}

/// Nothing flows while the strength falls, and little of the stabilisation is left.
template <int Dim> Model<Dim> studied(const Model<Dim>& model)
{
	Model<Dim> quiet = model;
	quiet.ghost.factor *= ghostShare;
	if (model.freeze) model.freeze(quiet);
	return quiet;
}

/// Scales the result back, from the points at the end.
template <int Dim> void scaleBack(WeakBody<Dim>& body, PointCloud<Dim>& end, const PointCloud<Dim>& before, double scale)
{
	scaleStrains(end, scale);
	for (auto& d : body.displacement)
		d *= scale;
	body.plasticStrain = plasticStrainOf(end.internals, end.size());
	const auto first   = plasticStrainOf(before.internals, before.size());
	for (std::size_t p = 0; p < first.size(); ++p)
		body.plasticStrain[p] -= first[p];
}

} // namespace

template <int Dim>
WeakBody<Dim> reduceStrength(
        const PointCloud<Dim>& cloud, const Model<Dim>& model, const Load<Dim>& load, double factor, StepControl control, LinearSolver& solver)
{
	const double    strain = largestStrain(cloud), scale = std::max(1., strain / smallStrain);
	const double    limit     = flowsBeyond * strain / scale * smallestExtent(cloud, model.grid);
	Model<Dim>      weakModel = studied(model);
	PointCloud<Dim> start     = cloud;
	WeakBody<Dim>   body;
	scaleStrains(start, 1 / scale);
	for (const auto& condition : model.inPlace)
		condition.begin(start, 1 / scale);
	body.displacement.assign(cloud.size(), Vec<Dim>::Zero());
	while (!control.isDone()) {
		const double    goal = 1 / (1 + control.goal() * (1 / factor - 1));
		PointCloud<Dim> now  = start;
		weakModel.materials  = weakMaterials(model, { goal, scale });
		now.parameters       = weakParameters(model, cloud, { goal, scale });
		StepReport report    = loadStep<Dim>(now, weakModel, load, solver);
		body.iterations += report.iterations;
		++body.parts;
		body.cause = report.cause;
		if (report.converged()) {
			const double largest = add(body.displacement, now, start);
			takeState(start, now);
			for (const auto& condition : model.inPlace)
				condition.goOn(start);
			if (largest > limit) {
				body.cause = beyondSmall(largest, limit);
				break;
			}
			body.reached = goal;
		}
		if (!control.take(report)) break;
	}
	body.carries = body.cause.empty();
	scaleBack(body, start, cloud, scale);
	return body;
}

template WeakBody<2> reduceStrength(const PointCloud<2>&, const Model<2>&, const Load<2>&, double, StepControl, LinearSolver&);
template WeakBody<3> reduceStrength(const PointCloud<3>&, const Model<3>&, const Load<3>&, double, StepControl, LinearSolver&);

} // namespace gimpm
