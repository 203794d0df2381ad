// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/structure.hpp"
#include <numeric>

namespace gimpm {
namespace {

void scaleAll(std::vector<double>& values, double scale)
{
	for (double& value : values)
		value *= scale;
}

void stiffenBeam(Beam& beam, double scale)
{
	beam.section.axialStiffness /= scale, beam.section.bendingStiffness /= scale;
	scaleAll(beam.elongation, scale);
	for (BeamSide& side : beam.sides)
		scaleAll(side.gap, scale);
	for (Vec<2>& bend : beam.bend)
		bend *= scale;
	for (std::size_t v = 0; v < beam.radius0.size(); ++v)
		beam.radius0[v] += (1 - scale) * (beam.positions[v][0] - beam.radius0[v]);
	for (std::size_t i = 0; i < beam.slope0.size(); ++i) {
		const Vec<2> along = beam.positions[i + 1] - beam.positions[i];
		beam.slope0[i] += (1 - scale) * (along[1] / along.norm() - beam.slope0[i]);
	}
}

} // namespace

template <int Dim> Structure<Dim> Structure<Dim>::asItBegins() const
{
	Structure begins = *this;
	for (auto& bar : begins.bars)
		bar.pull = bar.pullBefore, bar.jack.reset(); // stressed by a jack, it keeps its strain
	if (begins.beam) {
		Beam& own      = *begins.beam;
		own.weight     = own.before.weight;
		own.headForce  = own.before.headForce;
		own.headMoment = own.before.headMoment;
		own.shrinkage  = 1;
	}
	return begins;
}

template <int Dim> double Structure<Dim>::length() const
{
	double sum = beam ? std::accumulate(beam->length0.begin(), beam->length0.end(), 0.) : 0;
	for (const auto& bar : bars)
		sum = std::accumulate(bar.length0.begin(), bar.length0.end(), sum);
	return sum;
}

template <int Dim> void Structure<Dim>::stiffen(double scale)
{
	for (auto& bar : bars) {
		bar.section.stiffness /= scale, bar.bondStiffness /= scale;
		scaleAll(bar.strain, scale);
	}
	if (beam) stiffenBeam(*beam, scale);
}

template <int Dim> std::vector<std::vector<Vec<Dim>>> Structure<Dim>::positions() const
{
	std::vector<std::vector<Vec<Dim>>> all;
	for (const auto& bar : bars)
		all.push_back(bar.positions);
	if constexpr (Dim == 2)
		if (beam) all.push_back(beam->positions);
	return all;
}

template <int Dim> void Structure<Dim>::putBack(const std::vector<std::vector<Vec<Dim>>>& positions)
{
	for (std::size_t b = 0; b < bars.size(); ++b)
		bars[b].positions = positions[b];
	if constexpr (Dim == 2)
		if (beam) beam->positions = positions.back();
}

template struct Structure<2>;
template struct Structure<3>;

} // namespace gimpm
