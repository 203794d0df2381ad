// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/structure_system.hpp"
#include <Eigen/SparseCholesky>

namespace gimpm {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Energy of a spring that yields at a force, or that only presses: its force and tangent are the derivatives; with a
/// secant, the tangent is that of a parabola which touches the energy here and is above it elsewhere.
Energy<1> springEnergy(double trial, double stiffness, double limit, bool oneSided, bool secant = false)
{
	Energy<1> energy;
	if (oneSided && trial < 0) return energy;
	if (std::abs(trial) <= limit) {
		energy.value         = trial * trial / (2 * stiffness);
		energy.gradient[0]   = trial;
		energy.hessian(0, 0) = stiffness;
	} else {
		energy.value       = limit * (std::abs(trial) - limit / 2) / stiffness;
		energy.gradient[0] = trial < 0 ? -limit : limit;
		if (secant) energy.hessian(0, 0) = stiffness * limit / std::abs(trial);
	}
	return energy;
}

/// Solves with a symmetric matrix, made definite where nothing resists, as where all springs have yielded: there a beam
/// stays where it is, while a pivot that is round-off would move it by anything.
class Factor {
public:
	explicit Factor(const Sparse& matrix)
	{
		factor_.compute(matrix);
		if (isUsable(matrix)) return;
		const double largest = matrix.nonZeros() > 0 ? matrix.diagonal().cwiseAbs().maxCoeff() : 0;
		Sparse       shift(matrix.rows(), matrix.cols());
		shift.setIdentity();
		factor_.compute(matrix + (largest > 0 ? 1e-9 * largest : 1.) * shift);
	}
	template <class B> auto solve(const B& b) const { return factor_.solve(b); }

private:
	/// True if no pivot is round-off of the diagonal that it is left of.
	bool isUsable(const Sparse& matrix) const
	{
		constexpr double roundOff = 1e-12;
		if (factor_.info() != Eigen::Success) return false;
		const Eigen::VectorXd diagonal = factor_.permutationP() * Eigen::VectorXd(matrix.diagonal());
		return (factor_.vectorD().array().abs() > roundOff * diagonal.array().abs()).all();
	}

	Eigen::SimplicialLDLT<Sparse> factor_;
};

} // namespace

template <int Dim> StructureSystem<Dim>::StructureSystem(Structure<Dim>& structure, const std::vector<SoilAtVertex>& soil) : structure_(structure)
{
	number(soil);
	addSprings(soil);
}

/// Displacements of the soil at vertices, to the right of the beam, and on the two sides of bonds.
template <int Dim> void StructureSystem<Dim>::numberSoil(const std::vector<SoilAtVertex>& soil)
{
	const int ofBeam = this->ofBeam();
	for (int v = 0; v < int(stations_.size()); ++v)
		if (soil[v].exists && stations_[v].moves && !isSecondOfRing(v)) {
			stations_[v].soil = unknowns_;
			unknowns_ += Dim;
		}
	for (int v = 0; v < ofBeam && stations_.size() + v < soil.size(); ++v)
		if (soil[stations_.size() + v].exists && stations_[v].soil >= 0 && !isSecondOfRing(v)) {
			stations_[v].toTheRight = unknowns_;
			unknowns_ += Dim;
		}
	for (std::size_t position = stations_.size() + ofBeam; position < soil.size(); ++position) {
		bondSoil_.push_back(soil[position].exists ? unknowns_ : -1);
		if (soil[position].exists) unknowns_ += Dim;
	}
}

template <int Dim> void StructureSystem<Dim>::numberWater(const std::vector<SoilAtVertex>& soil)
{
	for (std::size_t position = 0; position < soil.size(); ++position)
		water_.push_back(soil[position].isWet && soilUnknown(int(position)) >= 0 ? unknowns_++ : -1);
	for (int v = 0; v < ofBeam(); ++v)
		for (const int side : { 0, 1 }) {
			const bool isParted = stations_[v].toTheRight >= 0;
			const int  position = isParted && side == 1 ? int(stations_.size()) + v : v;
			if ((isParted || soil[v].sides == 1 << side) && water_[position] >= 0) wetSides_.push_back({ v, side, position });
		}
}

/// The beam's vertices come first, of which the heads of bars may be copies.
template <int Dim> void StructureSystem<Dim>::number(const std::vector<SoilAtVertex>& soil)
{
	using Head = typename Reinforcement<Dim>::Head;
	stations_.resize(structure_.vertices());
	const int ofBeam = this->ofBeam();
	for (int v = 0; v < ofBeam; ++v)
		stations_[v].isFree = true;
	forBars([&](const Reinforcement<Dim>& bar, int first) {
		if (bar.head == Head::pulled) stations_[first].moves = false;
	});
	numberSoil(soil);
	numberWater(soil);
	soilUnknowns_ = unknowns_;
	if constexpr (Dim == 2) numberBeam();
	forBars([&](const Reinforcement<Dim>& bar, int first) {
		const int last = int(bar.positions.size()) - 1;
		for (int v = 0; v <= last; ++v) {
			Station& station = stations_[first + v];
			if (v == 0 && bar.head == Head::joined) {
				station      = stations_[bar.joint];
				station.soil = -1;
				continue;
			}
			station.direction = (bar.positions[std::min(v + 1, last)] - bar.positions[std::max(v - 1, 0)]).normalized();
			const bool isHead = v == 0 && bar.head != Head::bonded;
			if (isHead ? bar.head == Head::pulled : bar.slips()) station.slip = unknowns_++;
		}
	});
}

template <int Dim> void StructureSystem<Dim>::numberBeam()
{
	if (!structure_.beam) return;
	const Beam& beam = *structure_.beam;
	const int   last = int(beam.positions.size()) - 1;
	for (int v = 0; v <= last - beam.isClosed; ++v) {
		const bool isEnd = (v == 0 || v == last) && !beam.isClosed;
		for (int i = 0; i < 3; ++i) {
			const bool isHinge       = i == 2 && beam.isHinge[v];
			const bool isConstrained = (v == 0 && beam.fixedHead[i]) || (v == last && beam.fixedFoot[i]);
			// A hinge at an end of a beam leaves the turn of that end without meaning; one of a shell
			// lets it go.
			const bool isIdle = isEnd && isHinge && !beam.isShell;
			if ((!isConstrained || (isHinge && beam.isShell)) && !isIdle && !(beam.isOnAxis(v) && i != 1)) stations_[v].own[i] = unknowns_++;
		}
		if (beam.isShell && beam.isHinge[v] && !isEnd) stations_[v].turnBehind = unknowns_++;
	}
	if (beam.isClosed) stations_[last].own = stations_[0].own;
}

template <int Dim> LinearForm StructureSystem<Dim>::component(const Station& station, int axis) const
{
	LinearForm form;
	if (station.isFree) form.add(station.own[axis], 1);
	else if (station.moves)
		form.add(station.soil + axis, 1);
	form.add(station.slip, station.direction[axis]);
	return form;
}

template <int Dim> std::array<LinearForm, 2 * Dim> StructureSystem<Dim>::ends(int first, int second) const
{
	std::array<LinearForm, 2 * Dim> forms;
	for (int a = 0; a < Dim; ++a) {
		forms[a]       = component(stations_[first], a);
		forms[Dim + a] = component(stations_[second], a);
	}
	return forms;
}

template <int Dim> std::array<LinearForm, 6> StructureSystem<Dim>::beamEnds(int first) const
{
	std::array<LinearForm, 6> forms;
	for (int end = 0; end < 2; ++end)
		for (int i = 0; i < 3; ++i) {
			const Station& station = stations_[first + end];
			const bool     isPast  = end == 0 && i == 2 && station.turnBehind >= 0;
			forms[3 * end + i].add(isPast ? station.turnBehind : station.own[i], 1);
		}
	return forms;
}

template <int Dim> BarPiece<Dim> StructureSystem<Dim>::piece(const Reinforcement<Dim>& bar, std::size_t i) const
{
	BarPiece<Dim> made { bar.positions[i + 1] - bar.positions[i], bar.strain[i], bar.length0[i] };
	if (i == 0 || !bar.hasFreeLength) made.given = bar.jack;
	return made;
}

/// Piece of the beam. One of two adjacent pieces has the strength of the section between them: where both had it and
/// yielded, nothing would say how much either turns.
template <int Dim> BeamPiece StructureSystem<Dim>::beamPiece(std::size_t i) const
{
	const Beam&  beam     = *structure_.beam;
	const auto   strength = [&](std::size_t v) { return beam.isHinge[v] ? 0 : beam.plasticMoment; };
	const double length   = beam.shrinkage * beam.length0[i];
	BeamPiece    made { beam.positions[i + 1] - beam.positions[i], beam.elongation[i] + (beam.length0[i] - length), length, beam.bend[i] };
	made.strength[0] = strength(i);
	if (i + 1 == beam.length0.size() && !beam.isClosed) made.strength[1] = strength(i + 1);
	return made;
}

template <int Dim> ShellPiece StructureSystem<Dim>::shellPiece(std::size_t i) const
{
	const Beam& beam = *structure_.beam;
	ShellPiece  made { beamPiece(i), { beam.radius0[i], beam.radius0[i + 1] }, Vec<2>::Zero(), beam.slope0[i] };
	for (int end = 0; end < 2; ++end)
		made.outwards[end] = beam.positions[i + end][0] - made.radius0[end];
	return made;
}

template <int Dim> Energy<6> StructureSystem<Dim>::energyOfPiece(std::size_t i, const Eigen::Matrix<double, 6, 1>& u) const
{
	const BeamSection& section = structure_.beam->section;
	return structure_.beam->isShell ? energyOf(shellPiece(i), section, u) : energyOf(beamPiece(i), section, u);
}

template <int N> Eigen::Matrix<double, N, 1> valuesOf(const std::array<LinearForm, N>& forms, const Eigen::VectorXd& x)
{
	Eigen::Matrix<double, N, 1> values;
	for (int i = 0; i < N; ++i)
		values[i] = forms[i].at(x);
	return values;
}

template <int Dim> EnergySum StructureSystem<Dim>::energyAt(const Eigen::VectorXd& x, bool secants) const
{
	EnergySum sum(unknowns_);
	forBars([&](const Reinforcement<Dim>& bar, int first) {
		for (std::size_t i = 0; i < bar.length0.size(); ++i) {
			const auto forms = ends(first + int(i), first + int(i) + 1);
			sum.add<2 * Dim>(forms, energyOf<Dim>(piece(bar, i), bar.section, valuesOf<2 * Dim>(forms, x)));
		}
	});
	if constexpr (Dim == 2)
		for (std::size_t i = 0; structure_.beam && i < structure_.beam->length0.size(); ++i) {
			const auto forms = beamEnds(int(i));
			sum.add<6>(forms, energyOfPiece(i, valuesOf<6>(forms, x)));
		}
	for (const Spring& spring : springs_) {
		const double trial = spring.force + spring.stiffness * spring.form.at(x);
		sum.add<1>({ spring.form }, springEnergy(trial, spring.stiffness, spring.limit, spring.oneSided, secants));
	}
	addLoads(x, sum);
	return sum;
}

namespace {

/// The part of a second derivative in these rows and columns.
Sparse part(const EnergySum& sum, int row, int rows, int column, int columns)
{
	std::vector<Eigen::Triplet<double>> entries;
	for (const auto& entry : sum.hessian)
		if (entry.row() >= row && entry.row() < row + rows && entry.col() >= column && entry.col() < column + columns)
			entries.emplace_back(entry.row() - row, entry.col() - column, entry.value());
	Sparse matrix(rows, columns);
	matrix.setFromTriplets(entries.begin(), entries.end());
	return matrix;
}

} // namespace

/// Downhill: where the second derivative says otherwise, by the diagonal.
template <int Dim> Eigen::VectorXd StructureSystem<Dim>::direction(const EnergySum& sum) const
{
	const int             own      = unknowns_ - soilUnknowns_;
	const Eigen::VectorXd gradient = sum.gradient.tail(own);
	const Sparse          H        = part(sum, soilUnknowns_, own, soilUnknowns_, own);
	Eigen::VectorXd       step     = -Factor(H).solve(gradient);
	if (!step.allFinite() || step.dot(gradient) > 0) step = -gradient.cwiseQuotient(Eigen::VectorXd(H.diagonal()).cwiseAbs().cwiseMax(1e-300));
	return step;
}

/// Largest displacement or slip in a step of the structure's own unknowns [m].
template <int Dim> double StructureSystem<Dim>::farthestMove(const Eigen::VectorXd& step) const
{
	double     farthest = 0;
	const auto look     = [&](int unknown) {
                if (unknown >= 0) farthest = std::max(farthest, std::abs(step[unknown - soilUnknowns_]));
	};
	for (const Station& station : stations_)
		look(station.own[0]), look(station.own[1]), look(station.slip);
	return farthest;
}

/// Solves by Newton's method first, in whole steps: where a slender beam turns, these take the energy up once and then
/// far down, while shorter ones that only go down hardly get on. Where most springs yield nothing holds the structure
/// for it, and it would end anywhere; by secants of the springs the energy then only goes down, and Newton's method
/// ends what they begin.
template <int Dim> typename StructureSystem<Dim>::Solution StructureSystem<Dim>::solve(const Eigen::VectorXd& soil, const Eigen::VectorXd& guess) const
{
	constexpr int newtonSteps = 25, secantSteps = 40, rounds = 5;
	Solution      start { Eigen::VectorXd::Zero(unknowns_) };
	start.x.head(soilUnknowns_) = soil;
	if (!hasOwnUnknowns()) return start;
	if (guess.size() > 0) start.x.tail(unknowns_ - soilUnknowns_) = guess.tail(unknowns_ - soilUnknowns_);
	Solution found = iterate(start.x, newtonSteps, false);
	for (int round = 0; round < rounds && !found.isFound; ++round) {
		start = iterate(start.x, secantSteps, true);
		found = iterate(start.x, newtonSteps, false);
	}
	return found;
}

template <int Dim> double StructureSystem<Dim>::moveInSoil(int v, const Eigen::VectorXd& x) const
{
	const Station& station  = stations_[v];
	double         shortest = std::numeric_limits<double>::infinity();
	for (const int soil : { station.soil, station.toTheRight }) {
		if (soil < 0) continue;
		Vec<Dim> apart;
		for (int a = 0; a < Dim; ++a)
			apart[a] = component(station, a).at(x) - x[soil + a];
		shortest = std::min(shortest, apart.norm());
	}
	return std::isfinite(shortest) ? shortest : 0;
}

template <int Dim> typename StructureSystem<Dim>::Solution StructureSystem<Dim>::iterate(Eigen::VectorXd from, int mostSteps, bool secants) const
{
	constexpr double tolerance = 1e-11, roundOffOfForces = 1e-8, leastDescent = 1e-4;
	constexpr int    mostHalves = 30;
	const int        own        = unknowns_ - soilUnknowns_;
	Solution         at { std::move(from) };
	EnergySum        sum = energyAt(at.x, secants);
	for (int step = 0; step < mostSteps; ++step) {
		const Eigen::VectorXd gradient = sum.gradient.tail(own);
		if (!(gradient.norm() > tolerance * sum.absoluteContributions.tail(own).norm())) break;
		const Eigen::VectorXd direction = this->direction(sum);
		if (!secants && !(farthestMove(direction) < structure_.length())) break;
		const double    descent = gradient.dot(direction), roundOff = 1e-13 * std::abs(sum.value);
		Eigen::VectorXd x = at.x;
		EnergySum       next(0);
		double          length = 1;
		for (int half = 0; half < mostHalves; ++half, length /= 2) {
			x.tail(own)           = at.x.tail(own) + length * direction;
			next                  = energyAt(x, secants);
			const bool isPossible = std::isfinite(next.value) && next.gradient.allFinite();
			if (isPossible && (!secants || next.value <= sum.value + leastDescent * length * descent + roundOff)) break;
		}
		at.x = x, sum = std::move(next);
	}
	at.isFound = sum.gradient.tail(own).norm() <= roundOffOfForces * sum.absoluteContributions.tail(own).norm();
	return at;
}

template <int Dim> Eigen::MatrixXd StructureSystem<Dim>::condensed(const EnergySum& sum) const
{
	const int       own = unknowns_ - soilUnknowns_;
	Eigen::MatrixXd K   = part(sum, 0, soilUnknowns_, 0, soilUnknowns_);
	if (own == 0) return K;
	const Sparse across = part(sum, soilUnknowns_, own, 0, soilUnknowns_);
	const Factor factor(part(sum, soilUnknowns_, own, soilUnknowns_, own));
	K -= across.transpose() * Eigen::MatrixXd(factor.solve(Eigen::MatrixXd(across)));
	return K;
}

template <int Dim> std::vector<std::pair<int, int>> StructureSystem<Dim>::joinedVertices() const
{
	std::vector<std::pair<int, int>> joined;
	forBars([&](const Reinforcement<Dim>& bar, int first) {
		for (int i = 0; i < int(bar.positions.size()); ++i) {
			joined.emplace_back(first + i, first + i);
			if (i > 0) joined.emplace_back(first + i - 1, first + i);
		}
	});
	return joined;
}

template <int Dim> void StructureSystem<Dim>::commitBar(Reinforcement<Dim>& bar, int first, const Eigen::VectorXd& x)
{
	std::vector<Vec<Dim>> moved = bar.positions;
	for (std::size_t v = 0; v < moved.size(); ++v)
		for (int a = 0; a < Dim; ++a)
			moved[v][a] += component(stations_[first + v], a).at(x);
	for (std::size_t i = 0; i < bar.length0.size(); ++i) {
		const BarPiece<Dim> before = piece(bar, i);
		const auto          u      = valuesOf<2 * Dim>(ends(first + int(i), first + int(i) + 1), x);
		const double        over   = bar.length0[i] / (moved[i + 1] - moved[i]).norm();
		const double        strain = before.strainAfter(u.template tail<Dim>() - u.template head<Dim>());
		bar.force[i]               = before.given ? *before.given : over * bar.section.at(strain).gradient[0];
		bar.strain[i]              = before.given ? *before.given / over / bar.section.stiffness : bar.section.elastic(strain);
	}
	for (std::size_t v = 0; v < moved.size(); ++v)
		if (const int slip = stations_[first + v].slip; slip >= 0 && stations_[first + v].moves) bar.slip[v] += x[slip];
	bar.positions = std::move(moved);
}

template <int Dim> void StructureSystem<Dim>::commitPiece(std::size_t i, const Eigen::Matrix<double, 6, 1>& u)
{
	Beam&            beam   = *structure_.beam;
	const BeamPiece  before = beamPiece(i);
	const BeamShape  shape(before, u);
	const EndMoments ends = endMoments(before, beam.section, shape.turns);
	if (beam.isShell) {
		const ShellForces of = forcesIn(shellPiece(i), beam.section, u);
		beam.hoopForce.resize(beam.length0.size()), beam.hoopMoment.resize(beam.length0.size());
		beam.axialForce[i] = of.axial, beam.shearForce[i] = of.shear, beam.hoopForce[i] = of.hoop;
		beam.moments[i] = of.moments, beam.hoopMoment[i] = of.hoopMoments;
	} else {
		beam.axialForce[i] = beam.section.axialStiffness / before.length0 * shape.elongation;
		beam.shearForce[i] = ends.moment.sum() / (before.length0 + shape.elongation);
		beam.moments[i]    = ends.moment;
	}
	beam.length0[i]    = before.length0;
	beam.elongation[i] = shape.elongation;
	beam.bend[i]       = beam.isShell ? shape.turns : Vec<2>(shape.turns - ends.yielded);
}

template <int Dim> void StructureSystem<Dim>::commitBeam(const Eigen::VectorXd& x)
{
	Beam& beam = *structure_.beam;
	for (std::size_t i = 0; i < beam.length0.size(); ++i)
		commitPiece(i, valuesOf<6>(beamEnds(int(i)), x));
	const auto valueAt = [&](int unknown) { return unknown < 0 ? 0 : x[unknown]; };
	for (std::size_t v = 0; v < beam.positions.size(); ++v) {
		beam.positions[v] += Vec<2>(valueAt(stations_[v].own[0]), valueAt(stations_[v].own[1]));
		beam.turns[v] += valueAt(stations_[v].own[2]);
	}
	if (!beam.isClosed) return;
	for (BeamSide& side : beam.sides)
		for (auto* values : { &side.normalForce, &side.gap, &side.shearForce })
			values->back() = values->front();
	beam.isStuck.back() = beam.isStuck.front();
}

template <int Dim> void StructureSystem<Dim>::commit(const Eigen::VectorXd& x)
{
	for (const Spring& spring : springs_) {
		const double trial = spring.force + spring.stiffness * spring.form.at(x);
		const double force = springEnergy(trial, spring.stiffness, spring.limit, spring.oneSided).gradient[0];
		*spring.memory     = force / spring.area;
		if (spring.gap) *spring.gap = spring.oneSided && trial < 0 ? -trial / spring.stiffness : 0;
	}
	forBars([&](Reinforcement<Dim>& bar, int first) { commitBar(bar, first, x); });
	if constexpr (Dim == 2)
		if (structure_.beam) commitBeam(x);
}

/// The last vertex of a closed beam, which is its first one.
template <int Dim> bool StructureSystem<Dim>::isSecondOfRing(int v) const
{
	return structure_.beam && structure_.beam->isClosed && v + 1 == int(structure_.beam->positions.size());
}

template class StructureSystem<2>;
template class StructureSystem<3>;

} // namespace gimpm
