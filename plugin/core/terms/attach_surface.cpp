// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/attach_surface.hpp"
#include "core/grid/nearness.hpp"
#include <algorithm>
#include <sstream>

namespace gimpm {
namespace {

/// Tolerance from the nearest domain, where attachmentTolerance is that from the nearest cell [cells]: more than half
/// of a domain with two points a cell, by which a fill may fall short of its region, and less than a whole one.
constexpr double domainTolerance = 0.375;

template <int Dim> std::string emptyAt(const Vec<Dim>& vertex, const std::string& name, double tolerance)
{
	std::ostringstream text;
	text << name << " has a vertex at (" << vertex.transpose() << "), where there is no material within " << tolerance
	     << " cells; where soil has been dug out or has gone from below it, end its surface where the ground ends, or take the load away";
	return text.str();
}

template <int Dim>
AttachedPositions<Dim> attachTo(
        int layer, const std::vector<Vec<Dim>>& positions, const StepContext<Dim>& step, const std::string& name, const std::vector<Vec<Dim>>& beside = {})
{
	AttachedPositions<Dim> found;
	std::vector<double>    reach;
	found.layer = layer;
	for (std::size_t i = 0; i < positions.size(); ++i) {
		const Vec<Dim>& position = positions[i];
		const bool      isBeside = step.grid.parting && layer == layerOfPosition && !beside.empty();
		const auto      attached = attach(position, step.basis, step.grid, isBeside ? step.grid.parting->layerAt(beside[i]) : layer);
		reach.push_back(domainTolerance * step.grid.size(attached ? attached->level : 0));
		found.positions.push_back(attached.value_or(Attachment<Dim>()));
		if (attached) continue;
		found.obstacle = emptyAt(position, name, attachmentTolerance);
		return found;
	}
	auto isFar = areFarFromMaterial<Dim>(positions, reach, step.cloud, step.grid, layer);
	step.division.smallest(isFar.data(), isFar.size());
	const auto far = std::find(isFar.begin(), isFar.end(), 1);
	if (far != isFar.end()) found.obstacle = emptyAt(positions[far - isFar.begin()], name, domainTolerance);
	return found;
}

/// For each vertex the mean of the middles of its pieces.
template <int Dim> std::vector<Vec<Dim>> besideVertices(const Surface<Dim>& surface)
{
	std::vector<Vec<Dim>> beside(surface.vertices.size(), Vec<Dim>::Zero());
	std::vector<int>      pieces(beside.size(), 0);
	for (const auto& piece : surface.pieces)
		for (const int v : piece) {
			for (const int other : piece)
				beside[v] += surface.vertices[other] / Dim;
			++pieces[v];
		}
	for (std::size_t v = 0; v < beside.size(); ++v)
		beside[v] = pieces[v] > 0 ? Vec<Dim>(beside[v] / pieces[v]) : surface.vertices[v];
	return beside;
}

} // namespace

template <int Dim>
AttachedPositions<Dim> attachPositions(
        const std::vector<Vec<Dim>>& positions, const StepContext<Dim>& step, const std::string& name, int layer, const std::vector<Vec<Dim>>& beside)
{
	if (step.grid.parting || layer != layerOfPosition) return attachTo(layer, positions, step, name, beside);
	const auto& layers = step.cloud.layer;
	// The same passes in all processes.
	const int              last  = int(step.division.largest(layers.empty() ? 0 : *std::max_element(layers.begin(), layers.end())));
	AttachedPositions<Dim> found = attachTo(0, positions, step, name);
	for (int next = 1; next <= last; ++next) {
		auto other = attachTo(next, positions, step, name);
		if (!other.obstacle.empty()) continue;
		if (found.obstacle.empty()) {
			found.obstacle = name + " is on two bodies of points that meet: name the one that is meant (body)";
			return found;
		}
		found = std::move(other);
	}
	return found;
}

template <int Dim> AttachedPositions<Dim> attachVertices(const Surface<Dim>& surface, const StepContext<Dim>& step, const std::string& name, int layer)
{
	return attachPositions(surface.vertices, step, name, layer, step.grid.parting ? besideVertices(surface) : std::vector<Vec<Dim>>());
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template AttachedPositions<Dim> attachPositions(                                                                                                       \
	        const std::vector<Vec<Dim>>&, const StepContext<Dim>&, const std::string&, int, const std::vector<Vec<Dim>>&);                                 \
	template AttachedPositions<Dim> attachVertices(const Surface<Dim>&, const StepContext<Dim>&, const std::string&, int);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
