// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/pressure_filter.hpp"
#include "core/materials/law.hpp"
#include <algorithm>

namespace gimpm {
namespace {

using Values = Eigen::VectorXd;

/// Bulk modulus of a point whose law answers to a shear with one deviator whatever the mean stress is, and to a change
/// of volume with that modulus alone; 0 of others.
double pressureFreeBulk(const Material& material, const ParameterColumns& parameters, std::size_t point)
{
	if (!material.law->isLinear || material.law->isTensorLaw) return 0;
	return withLawOf(material, parameters, point, [](const auto& law) {
		constexpr double large  = 0.5; // far beyond all strengths
		const auto       at     = [&](double mean) { return Vec3(law.respond(Vec3(mean + large, mean, mean - large), law.initialInternals()).stress); };
		const auto       still  = law.respond(Vec3(0, 0, 0), law.initialInternals());
		const double     bulk   = (still.tangent(0, 0) + 2 * still.tangent(0, 1)) / 3;
		const Vec3       change = (at(large) - at(-large)) / (6 * large);
		return (change.array() - bulk).abs().maxCoeff() < 1e-9 * bulk ? bulk : 0.;
	});
}

/// Those of the domains of some points that lie in cells.
template <int Dim> class PartsInCells {
public:
	PartsInCells(const CloudBasis<Dim>& basis, const Division& division) : basis_(basis), division_(division) { }

	/// Position in the order of the basis, and initial volume.
	void add(const Patch<Dim>& patch, int i, double volume)
	{
		double upper[Dim];
		for (int a = 0; a < Dim; ++a) {
			const auto& gradient = basis_.axes[i][a].gradient; // gradients of the outer functions, in proportion to the lengths
			upper[a]             = patch.span >> a & 1 ? gradient[2] / (gradient[2] - gradient[0]) : 0;
		}
		Part part { patch.reached, {}, volume };
		for (int c = 0; c < windowCells<Dim>; ++c) {
			double share = 1;
			for (int a = 0; a < Dim; ++a)
				share *= c >> a & 1 ? upper[a] : 1 - upper[a];
			part.share[c] = part.cell[c] < 0 ? 0 : share;
		}
		parts_.push_back(part);
	}
	std::size_t size() const { return parts_.size(); }

	/// The nearest combination of one number a cell. By conjugate gradients, and at last a step by the sums of the
	/// rows, which makes the sum over all cells exact.
	Values projected(const Values& ofPoints) const
	{
		constexpr double tolerance = 1e-10; // tolerance of the sums of cells
		constexpr int    most      = 50;
		const Values     inverse   = sums(Values::Ones(ofPoints.size())).unaryExpr([](double sum) { return sum > 0 ? 1 / sum : 0; });
		Values           r = sums(ofPoints), x = inverse.cwiseProduct(r);
		const double     size = r.dot(x);
		r -= sums(combined(x));
		Values along = inverse.cwiseProduct(r);
		double rest  = r.dot(along);
		for (int k = 0; k < most && rest > tolerance * tolerance * size; ++k) {
			const Values moved = sums(combined(along));
			const double part = rest / along.dot(moved), before = rest;
			x += part * along, r -= part * moved;
			const Values next = inverse.cwiseProduct(r);
			rest              = r.dot(next);
			along             = next + rest / before * along;
		}
		return combined(x + inverse.cwiseProduct(r));
	}

private:
	struct Part {
		std::array<int, windowCells<Dim>>    cell; ///< -1: none
		std::array<double, windowCells<Dim>> share;
		double                               volume;
	};

	Values sums(const Values& ofPoints) const
	{
		std::vector<double> sum(basis_.cells.size(), 0);
		for (std::size_t k = 0; k < parts_.size(); ++k)
			for (int c = 0; c < windowCells<Dim>; ++c)
				if (parts_[k].cell[c] >= 0) sum[parts_[k].cell[c]] += parts_[k].share[c] * parts_[k].volume * ofPoints[k];
		division_.complete(basis_.cells, sum);
		return Eigen::Map<Values>(sum.data(), sum.size());
	}
	Values combined(const Values& ofCells) const
	{
		Values result = Values::Zero(parts_.size());
		for (std::size_t k = 0; k < parts_.size(); ++k)
			for (int c = 0; c < windowCells<Dim>; ++c)
				if (parts_[k].cell[c] >= 0) result[k] += parts_[k].share[c] * ofCells[parts_[k].cell[c]];
		return result;
	}

	const CloudBasis<Dim>& basis_;
	const Division&        division_;
	std::vector<Part>      parts_;
};

/// The points of a material that take part, and how much of what does not act each of them loses.
template <int Dim> struct Relaxation {
	PartsInCells<Dim>   parts;
	std::vector<int>    points; ///< in the cloud
	std::vector<double> loses;

	/// `takesPart(point in the cloud)`.
	template <class F>
	Relaxation(
	        const PointCloud<Dim>& after, const PointCloud<Dim>& before, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, const Division& division,
	        F&& takesPart)
	        : parts(basis, division)
	{
		for (const auto& patch : basis.patches)
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				const int p = basis.order[i];
				if (!takesPart(p)) continue;
				parts.add(patch, i, after.volume0[p]);
				points.push_back(p);
				loses.push_back(std::min(1., 4 * (after.position[p] - before.position[p]).norm() / grid.size(Grid<Dim>::level(patch.cell))));
			}
	}

	/// Changes of the values of points.
	Values changes(const Values& ofPoints) const
	{
		const Values loss = Eigen::Map<const Values>(loses.data(), loses.size()).cwiseProduct(ofPoints - parts.projected(ofPoints));
		return parts.projected(loss) - loss;
	}
};

} // namespace

template <int Dim>
void relaxPressures(
        PointCloud<Dim>& cloud, const PointCloud<Dim>& before, const std::vector<Material>& materials, const CloudBasis<Dim>& basis, const Grid<Dim>& grid,
        const Division& division)
{
	const auto forPoints = [&](auto&& takesPart, auto&& valueOf, auto&& change) {
		const Relaxation<Dim> of(cloud, before, basis, grid, division, takesPart);
		const double          most = of.loses.empty() ? 0 : *std::max_element(of.loses.begin(), of.loses.end());
		if (division.largest(most) == 0) return;
		Values values(of.points.size());
		for (std::size_t k = 0; k < of.points.size(); ++k)
			values[k] = valueOf(of.points[k]);
		values = of.changes(values);
		for (std::size_t k = 0; k < of.points.size(); ++k)
			change(of.points[k], values[k]);
	};
	for (int m = 0; m < int(materials.size()); ++m) {
		const Material&     material = materials[m];
		const double        same     = material.varies ? 0 : pressureFreeBulk(material, {}, 0);
		std::vector<double> bulk(cloud.size(), 0);
		for (std::size_t p = 0; p < cloud.size(); ++p)
			if (cloud.material[p] == m) bulk[p] = material.varies ? pressureFreeBulk(material, cloud.parameters, p) : same;
		forPoints(
		        [&](int p) { return bulk[p] > 0; }, [&](int p) { return bulk[p] * cloud.elasticStrain[p].full().trace(); },
		        [&](int p, double change) {
			        for (const int normal : { 0, 1, Dim == 2 ? 3 : 2 }) {
				        cloud.elasticStrain[p].c[normal] += change / (3 * bulk[p]);
				        cloud.stress[p].c[normal] += change / cloud.volumeRatio(p);
			        }
		        });
		if (material.waterModulus == 0 || cloud.excessPressure.empty()) continue;
		forPoints(
		        [&](int p) { return cloud.material[p] == m; }, [&](int p) { return cloud.excessPressure[p] * cloud.volumeRatio(p); },
		        [&](int p, double change) { cloud.excessPressure[p] += change / cloud.volumeRatio(p); });
	}
}

template void relaxPressures(PointCloud<2>&, const PointCloud<2>&, const std::vector<Material>&, const CloudBasis<2>&, const Grid<2>&, const Division&);
template void relaxPressures(PointCloud<3>&, const PointCloud<3>&, const std::vector<Material>&, const CloudBasis<3>&, const Grid<3>&, const Division&);

} // namespace gimpm
