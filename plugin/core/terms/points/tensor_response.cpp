// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/tensor_response.hpp"
#include "core/materials/tensor_law.hpp"

namespace gimpm {
namespace {

using Rates = TensorPoint::Rates;

/// Flux of a Kirchhoff stress t, t F^-T, and its derivatives by F; F of the step, around an axis with the stretch
/// there.
struct FluxOfPoint {
	Mat3 stress, inverse;

	Mat3 flux() const { return stress * inverse.transpose(); }

	/// Derivative of component (i, j) by F_kl.
	double derivative(const Rates& rates, int i, int j, int k, int l) const
	{
		double sum = 0;
		for (int m = 0; m < 3; ++m)
			for (int n = 0; n < 3; ++n)
				sum += rates(3 * i + m, 3 * k + n) * inverse(l, n) * inverse(j, m);
		for (int m = 0; m < 3; ++m)
			sum -= stress(i, m) * inverse(l, m) * inverse(j, k);
		return sum;
	}
};

/// Component i has gradients along the axes of the plane or space, and the radial one also around; `axis` of direction
/// j of component i.
template <int Dim> int rowOf(int i, int j) { return j < Dim ? i : 2; }
template <int Dim> int columnOf(int j) { return j < Dim ? j : 2; }

template <int Dim, int Axes> void setFlux(Lanes (&to)[Dim][Axes], int lane, double volume, const Mat3& flux)
{
	for (int i = 0; i < Dim; ++i)
		for (int j = 0; j < directionsOf<Dim, Axes>(i); ++j)
			to[i][j].v[lane] = volume * flux(rowOf<Dim>(i, j), columnOf<Dim>(j));
}

template <int Dim, int Axes>
void setModuli(const Pass<Dim>& pass, Chunk<Dim, Axes>& chunk, int b, int lane, double volume, const FluxOfPoint& flux, const Rates& rates)
{
	const auto set = [&](int i, int k, int pair) {
		for (int j = 0; j < directionsOf<Dim, Axes>(i); ++j)
			for (int l = 0; l < directionsOf<Dim, Axes>(k); ++l)
				chunk.moduli.value[pair][b][j][l].v[lane]
				        = volume * flux.derivative(rates, rowOf<Dim>(i, j), columnOf<Dim>(j), rowOf<Dim>(k, l), columnOf<Dim>(l));
	};
	if (pass.isSymmetric) PairModuli<Dim>::template forPairs<true>(set);
	else
		PairModuli<Dim>::template forPairs<false>(set);
}

/// Split into changes of shape and of volume, in the first n axes: VolumetricSplit is the same in principal axes.
struct TensorSplit {
	double mean = 0, bulk = 0;
	Mat3   axes = Mat3::Zero(), deviator, meanOfStrain = Mat3::Zero(), stressOfDilation = Mat3::Zero();
	Rates  rates;

	TensorSplit(const Mat3& stress, const Rates& of, int n)
	{
		for (int a = 0; a < n; ++a)
			axes(a, a) = 1, mean += stress(a, a) / n;
		for (int c = 0; c < 9; ++c)
			for (int a = 0; a < n; ++a) {
				meanOfStrain(c / 3, c % 3) += of(4 * a, c) / n;
				stressOfDilation(c / 3, c % 3) += of(c, 4 * a) / n;
			}
		bulk     = meanOfStrain.cwiseProduct(axes).sum() / n;
		deviator = stress - mean * axes;
		meanOfStrain -= bulk * axes, stressOfDilation -= bulk * axes;
		for (int r = 0; r < 9; ++r)
			for (int c = 0; c < 9; ++c)
				rates(r, c) = of(r, c) - axes(r / 3, r % 3) * (meanOfStrain(c / 3, c % 3) + bulk * axes(c / 3, c % 3))
				        - stressOfDilation(r / 3, r % 3) * axes(c / 3, c % 3);
	}
};

template <int Dim> SymTensor<3> inSpace(const SymTensor<Dim>& b1) { return SymTensor<3>::from(b1.full()); }

/// The part of water that cannot leave the pores, as BatchResponse adds it to that of principal laws.
void addWater(TensorPoint& r, double before, double modulus, const SymTensor<3>& b1, const Mat3& gradient)
{
	const double volumetric = volumetricStrain(b1) + std::log((gradient + Mat3::Identity()).determinant());
	r.stress += (before + modulus * volumetric) * Mat3::Identity();
	for (int a = 0; a < 9; a += 4)
		for (int b = 0; b < 9; b += 4)
			r.rates(a, b) += modulus;
}

/// Calls f(lane, index of the point, its response to the gradient that it sees) for those of the batch that have a
/// tensor law. Returns a point that fails.
template <int Dim, int Axes, class F> FailureCode forTensorPoints(const Pass<Dim>& pass, const Batch& batch, const Increment<Dim, Axes>& seen, F&& f)
{
	FailureCode first = noFailure;
	for (int lane = 0; lane < batch.count; ++lane) {
		const int       i        = batch.point[lane];
		const Material& material = pass.materials[pass.points.material[i]];
		if (!material.law->isTensorLaw) continue;
		const PointOfLaw at { material.ofPoints(pass.points.parameters), pass.points.internals, std::size_t(i) };
		const auto       b1       = inSpace(pass.points.leftCauchyGreen[i]);
		const Mat3       gradient = gradientOf(seen, lane);
		TensorPoint      r = respondInSpace(material.law, at, { b1, gradient, pass.duration, pass.sum.K != nullptr, Dim, Axes, pass.isBeginning });
		if (material.waterModulus > 0 && !r.failed) addWater(r, pass.points.water[i], material.waterModulus, b1, gradient);
		if (r.failed) first = std::min(first, codeOf({ pass.basis.order[i], PointFailure::Reason::noResponse }));
		else
			f(lane, i, r);
	}
	return first;
}

Mat3 inverseOf(const Mat3& gradient) { return (gradient + Mat3::Identity()).inverse(); }

} // namespace

template <int Dim, int Axes> FailureCode respondOfTensors(const Pass<Dim>& pass, Chunk<Dim, Axes>& chunk, const Batch& batch, int b)
{
	const Increment<Dim, Axes> increment(chunk.gradient[b]);
	return forTensorPoints(pass, batch, increment, [&](int lane, int i, const TensorPoint& r) {
		const FluxOfPoint flux { r.stress, inverseOf(gradientOf(increment, lane)) };
		setFlux(chunk.flux[b], lane, pass.points.volume0[i], flux.flux());
		if (pass.sum.K) setModuli(pass, chunk, b, lane, pass.points.volume0[i], flux, r.rates);
	});
}

template <int Dim, int Axes> FailureCode respondOfTensors(const Pass<Dim>& pass, FBarChunk<Dim, Axes>& chunk, const Batch& batch, int b)
{
	const FBarIncrement<Dim, Axes> increment(chunk, b);
	return forTensorPoints(pass, batch, increment.seen, [&](int lane, int i, const TensorPoint& r) {
		const double      volume = pass.points.volume0[i];
		const TensorSplit split(r.stress, r.rates, Axes);
		const FluxOfPoint flux { split.deviator, inverseOf(gradientOf(increment.own, lane)) };
		setFlux(chunk.flux[b], lane, volume, flux.flux());
		chunk.meanStress[b].v[lane] = volume * split.mean;
		if (!pass.sum.K) return;
		setModuli(pass, chunk, b, lane, volume, flux, split.rates);
		setFlux(chunk.meanOfStrain[b], lane, volume, split.meanOfStrain * flux.inverse.transpose());
		setFlux(chunk.stressOfDilation[b], lane, volume, split.stressOfDilation * flux.inverse.transpose());
		chunk.bulk[b].v[lane] = volume * split.bulk;
	});
}

template <int Dim>
void visitWithTensors(
        const StepPoints<Dim>& points, const std::vector<Material>& materials, int i, const Mat3& gradient, PointUpdate<Dim> u, const std::vector<int>& order,
        const Visitor<Dim>& visitor)
{
	const Material&  material = materials[points.material[i]];
	const PointOfLaw at { material.ofPoints(points.parameters), points.internals, std::size_t(i) };
	const auto       r = respondInSpace(material.law, at, { inSpace(points.leftCauchyGreen[i]), gradient, points.duration, false });
	u.elasticStrain    = SymTensor<Dim>::from(r.elasticStrain);
	u.kirchhoffStress  = SymTensor<Dim>::from(r.stress);
	u.internals        = r.state.numbers();
	visitor.call(visitor.f, order[i], u);
}

#define GIMPM_INSTANTIATE(Dim, Axes)                                                                                                                           \
	template FailureCode respondOfTensors(const Pass<Dim>&, Chunk<Dim, Axes>&, const Batch&, int);                                                         \
	template FailureCode respondOfTensors(const Pass<Dim>&, FBarChunk<Dim, Axes>&, const Batch&, int);
GIMPM_INSTANTIATE(2, 2)
GIMPM_INSTANTIATE(2, 3)
GIMPM_INSTANTIATE(3, 3)
#undef GIMPM_INSTANTIATE
template void visitWithTensors(
        const StepPoints<2>&, const std::vector<Material>&, int, const Mat3&, PointUpdate<2>, const std::vector<int>&, const Visitor<2>&);
template void visitWithTensors(
        const StepPoints<3>&, const std::vector<Material>&, int, const Mat3&, PointUpdate<3>, const std::vector<int>&, const Visitor<3>&);

} // namespace gimpm
