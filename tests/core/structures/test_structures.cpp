// SPDX-License-Identifier: GPL-2.0-or-later
// Bars and beams: their energies against differences, closed forms, and the force on the soil with its tangent.
#include "core/stepping/step_system.hpp"
#include "core/structures/parting_lines.hpp"
#include "core/structures/structure_force.hpp"
#include "derivatives.hpp"
#include "moving.hpp"
#include "scenes.hpp"

namespace gimpm::testStructures {
namespace {

	/// Errors of the first and second derivative of an energy at u, relative to their largest entries.
	template <int N, class F> std::pair<double, double> derivativeErrors(const F& energyAt, const Eigen::Matrix<double, N, 1>& u, double step)
	{
		const Energy<N>             at = energyAt(u);
		Eigen::Matrix<double, N, 1> gradient;
		Eigen::Matrix<double, N, N> hessian;
		for (int i = 0; i < N; ++i) {
			const auto move = [&](double s) { return energyAt(u + s * step * Eigen::Matrix<double, N, 1>::Unit(i)); };
			const auto up = move(1), down = move(-1), up2 = move(2), down2 = move(-2);
			gradient[i]    = (8 * (up.value - down.value) - (up2.value - down2.value)) / (12 * step);
			hessian.col(i) = (8 * (up.gradient - down.gradient) - (up2.gradient - down2.gradient)) / (12 * step);
		}
		return { (at.gradient - gradient).cwiseAbs().maxCoeff() / gradient.cwiseAbs().maxCoeff(),
			 (at.hessian - hessian).cwiseAbs().maxCoeff() / hessian.cwiseAbs().maxCoeff() };
	}

	template <class Dimension> using BarPieces = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(BarPieces, BothDimensions, DimensionName);

	TYPED_TEST(BarPieces, ForceAndTangentAreDerivatives)
	{
		constexpr int Dim = TypeParam::value;
		using Ends        = Eigen::Matrix<double, 2 * Dim, 1>;
		Random random(2);
		for (const bool yields : { false, true }) {
			const BarSection section { 5e3, yields ? 100. : infinity, true };
			BarPiece<Dim>    piece { random.matrix<Dim>(), 0.1 };
			piece.length0              = piece.along.norm() * std::exp(-0.1);
			const Ends u               = random.matrix<2 * Dim>(0.02);
			const auto energyAt        = [&](const Ends& at) { return energyOf<Dim>(piece, section, at); };
			const auto [first, second] = derivativeErrors<2 * Dim>(energyAt, u, 1e-4);
			EXPECT_LT(first, 1e-9);
			EXPECT_LT(second, 1e-9);
			EXPECT_LT((energyAt(u).hessian - energyAt(u).hessian.transpose()).norm(), 1e-14 * energyAt(u).hessian.norm());
		}
	}

	TYPED_TEST(BarPieces, TakesNoCompressionIfItIsSlack)
	{
		constexpr int                     Dim = TypeParam::value;
		BarPiece<Dim>                     piece { Vec<Dim>::Unit(0) };
		Eigen::Matrix<double, 2 * Dim, 1> u = Eigen::Matrix<double, 2 * Dim, 1>::Zero();
		u[Dim]                              = -0.1;
		EXPECT_EQ(energyOf<Dim>(piece, { 5e3, infinity, true }, u).gradient.norm(), 0);
		const double force = -5e3 * std::log(0.9) / 0.9;
		EXPECT_NEAR(energyOf<Dim>(piece, { 5e3, infinity, false }, u).gradient[0], force, 1e-12 * force);
	}

	TEST(BeamPieces, ForcesAndTangentAreDerivatives)
	{
		Random            random(3);
		const BeamSection section { 5e3, 70 };
		for (const double strength : { infinity, 20., 0. })
			for (int draw = 0; draw < 5; ++draw) {
				BeamPiece piece { random.matrix<2>(), 0.02 };
				piece.length0     = piece.along.norm() - piece.elongation;
				piece.turns       = random.matrix<2>(0.2);
				piece.strength[0] = strength;
				if (draw > 2) piece.strength[1] = strength;
				const Eigen::Matrix<double, 6, 1> u = random.matrix<6>(0.3);
				const auto [first, second]
				        = derivativeErrors<6>([&](const Eigen::Matrix<double, 6, 1>& at) { return energyOf(piece, section, at); }, u, 1e-4);
				EXPECT_LT(first, 1e-8) << strength;
				EXPECT_LT(second, 1e-8) << strength;
			}
	}

	/// From (0, 0) to (length, 0), without soil.
	Structure<2> beamAlone(double length, int pieces, BeamSection section)
	{
		Structure<2> structure;
		structure.beam.emplace();
		structure.beam->section = section;
		structure.beam->begin(divided<2>({ { 0, 0 }, { length, 0 } }, length / pieces));
		return structure;
	}

	/// One step with the loads that it has.
	void settle(Structure<2>& structure)
	{
		StructureSystem<2> system(structure, std::vector<SoilAtVertex>(structure.vertices()));
		const auto         found = system.solve(Eigen::VectorXd(0), {});
		EXPECT_TRUE(found.isFound);
		system.commit(found.x);
	}

	/// The elastica of a cantilever with a force P across its end, P L^2 / EI = 10 (Mattiasson 1981).
	TEST(Beams, CantileverBendsAsTheElastica)
	{
		constexpr double EI = 3, force = 10 * EI;
		double           error[2];
		for (const int pieces : { 10, 20 }) {
			Structure<2> structure    = beamAlone(1, pieces, { 1e7, EI });
			structure.beam->fixedFoot = { true, true, true };
			for (int step = 1; step <= 10; ++step) {
				structure.beam->headForce = { 0, -force * step / 10 };
				settle(structure);
			}
			const Vec<2> end       = structure.beam->positions.front();
			error[pieces / 10 - 1] = std::hypot(end[0] - 0.55500, end[1] + 0.81061);
			EXPECT_NEAR(structure.beam->turns.front(), 1.43029, 5e-3);
		}
		EXPECT_LT(error[1], 5e-4);
		EXPECT_NEAR(error[0] / error[1], 4, 1);
	}

	TEST(Beams, SimplySupportedBeamSagsAsInTheBooks)
	{
		constexpr double L = 4, EI = 2e6, weight = 100;
		Structure<2>     structure = beamAlone(L, 16, { 1e9, EI });
		auto&            beam      = *structure.beam;
		beam.fixedHead = { true, true, false }, beam.fixedFoot = { false, true, false };
		beam.weight = { 0, -weight };
		settle(structure);
		EXPECT_NEAR(beam.positions[8][1], -5 * weight * std::pow(L, 4) / (384 * EI), 4e-3 * 5 * weight * std::pow(L, 4) / (384 * EI));
		EXPECT_NEAR(std::abs(beam.moments[8][0]), weight * L * L / 8, 5e-3 * weight * L * L / 8);
	}

	/// Between ends that are held it keeps its force; drawn at an end it is as much longer as the difference asks
	/// for.
	TEST(Beams, KeepTheirPrestress)
	{
		constexpr double EA = 1e6, N = -2e4, pull = 1e4;
		Structure<2>     structure;
		auto&            beam = structure.beam.emplace();
		beam.section          = { EA, 2e6 };
		beam.begin(divided<2>({ { 0, 0 }, { 4, 0 } }, 0.25), N);
		beam.fixedHead = beam.fixedFoot = { true, true, true };
		settle(structure);
		for (const double force : beam.axialForce)
			EXPECT_NEAR(force, N, 1e-9 * std::abs(N));
		beam.fixedHead = {}, beam.headForce = { -pull, 0 };
		settle(structure);
		EXPECT_NEAR(beam.axialForce[7], pull, 1e-9 * pull);
		EXPECT_NEAR(4 - beam.positions.front()[0], 4 * (1 + pull / EA) / (1 + N / EA), 1e-9);
	}

	/// Smooth beam without weight between soil that settles on both sides: a pivot that is round-off must not move
	/// it along itself.
	TEST(Beams, StayWhereNothingHoldsThemAlongThemselves)
	{
		for (const double axialStiffness : { 1e7, 1e9 }) {
			Structure<2> structure;
			Beam&        beam = structure.beam.emplace();
			beam.section      = { axialStiffness, 1e5 };
			beam.adhesion     = 0;
			beam.begin(divided<2>({ { 2.3, 3 }, { 2.87, 0.9 } }, 0.25));
			const int    count = int(beam.positions.size());
			SoilAtVertex soil { true, 3 };
			soil.young = 1e6, soil.cellSize = 0.5;
			for (int v = 0; v < count; ++v)
				for (BeamSide& side : beam.sides)
					side.normalForce[v] = beam.sizeAt(v) * 4e3 * (3.2 - beam.positions[v][1]);
			beam.isStuck.assign(count, 0);
			StructureSystem<2> system(structure, std::vector<SoilAtVertex>(2 * count, soil));
			Eigen::VectorXd    u(system.soilUnknowns());
			for (int position = 0; position < 2 * count; ++position) {
				const double y = beam.positions[position % count][1];
				u.segment<2>(system.soilUnknown(position))
				        = Vec<2>(1e-4 * std::sin(y + position / count), -0.01 * y - 0.003 * (position / count));
			}
			const auto   found  = system.solve(u, {});
			const Vec<2> before = beam.positions[0], along = beam.tangentAt(0);
			EXPECT_TRUE(found.isFound);
			system.commit(found.x);
			EXPECT_LT(std::abs((beam.positions[0] - before).dot(along)), 1e-5) << axialStiffness;
		}
	}

	/// Deflection with a hinge in the middle of a beam clamped at both ends: two cantilevers, each with w L^4 / 8
	/// EI.
	TEST(Beams, HingesTakeNoMoment)
	{
		constexpr double L = 2, EI = 2e6, weight = 100;
		Structure<2>     structure = beamAlone(2 * L, 16, { 1e9, EI });
		auto&            beam      = *structure.beam;
		beam.fixedHead = beam.fixedFoot = { true, true, true };
		beam.isHinge[8]                 = 1;
		beam.weight                     = { 0, -weight };
		settle(structure);
		const double sag = weight * std::pow(L, 4) / (8 * EI);
		EXPECT_NEAR(beam.positions[8][1], -sag, 1e-2 * sag);
		EXPECT_NEAR(beam.moments[8][0], 0, 1e-9 * weight * L * L);
		EXPECT_NEAR(std::abs(beam.moments[0][0]), weight * L * L / 2, 1e-2 * weight * L * L / 2);
	}

	/// Clamped beam under a uniform load: w L^2 = 16 Mp at collapse. Below it sags little; beyond it goes down
	/// until it hangs.
	TEST(Beams, YieldAtThePlasticMoment)
	{
		constexpr double L = 4, EI = 2e6, Mp = 100;
		for (const double part : { 0.98, 1.02 }) {
			Structure<2> structure = beamAlone(L, 16, { 1e9, EI });
			auto&        beam      = *structure.beam;
			beam.fixedHead         = { true, true, true };
			beam.fixedFoot         = { false, true, true };
			beam.plasticMoment     = Mp;
			for (int step = 1; step <= 20; ++step) {
				beam.weight = { 0, -part * 16 * Mp / (L * L) * step / 20 };
				settle(structure);
			}
			double largest = 0;
			for (const auto& m : beam.moments)
				largest = std::max(largest, m.cwiseAbs().maxCoeff());
			EXPECT_NEAR(largest, Mp, 1e-9 * Mp);
			EXPECT_EQ(-beam.positions[8][1] > L / 20, part > 1) << beam.positions[8][1];
		}
	}

	TEST(ShellPieces, ForcesAndTangentAreDerivatives)
	{
		Random random(4);
		for (int draw = 0; draw < 5; ++draw) {
			ShellPiece   piece { { random.matrix<2>(), 0.02 } };
			const double length        = piece.meridian.along.norm();
			piece.meridian.length0     = length - 0.02;
			piece.meridian.turns       = random.matrix<2>(0.2);
			piece.radius0              = { draw == 0 ? 0. : 1.5, 2 };
			piece.outwards             = random.matrix<2>(0.1);
			piece.slope0               = piece.meridian.along[1] / length + 0.1;
			const auto [first, second] = derivativeErrors<6>(
			        [&](const Eigen::Matrix<double, 6, 1>& at) {
				        return energyOf(piece, { 5e3, 70, 0.3 }, at);
			        },
			        random.matrix<6>(0.1), 1e-4);
			EXPECT_LT(first, 1e-8);
			EXPECT_LT(second, 1e-8);
		}
	}

	/// Section of a plate of this thickness, with E = 1e9 Pa.
	BeamSection plateOf(double thickness, double poisson)
	{
		const double C = 1e9 * thickness / (1 - poisson * poisson);
		return { C, C * thickness * thickness / 12, poisson };
	}

	Structure<2> shellAlong(const std::vector<Vec<2>>& meridian, double longest, BeamSection section)
	{
		Structure<2> structure;
		structure.beam.emplace();
		structure.beam->section = section;
		structure.beam->isShell = true;
		structure.beam->begin(divided<2>(meridian, longest));
		return structure;
	}

	/// A pressure w = p a^4 / 64 D in the middle of a clamped plate, with the moments p a^2 (1 + nu) / 16 there and
	/// -p a^2 / 8 at its edge; of one that is simply supported (5 + nu) / (1 + nu) times as much (Timoshenko and
	/// Woinowsky-Krieger 1959, section 16).
	TEST(Shells, RoundPlatesBendAsInTheBooks)
	{
		constexpr double a = 2, p = 100, nu = 0.3;
		for (const bool isClamped : { true, false }) {
			Structure<2> structure = shellAlong({ { 0, 1 }, { a, 1 } }, a / 20, plateOf(0.1, nu));
			auto&        plate     = *structure.beam;
			plate.fixedFoot = { false, true, isClamped }, plate.weight = { 0, -p };
			settle(structure);
			const double w = p * std::pow(a, 4) / (64 * plate.section.bendingStiffness) * (isClamped ? 1 : (5 + nu) / (1 + nu));
			const double M = p * a * a * (isClamped ? 1 + nu : 3 + nu) / 16, atEdge = isClamped ? -p * a * a / 8 : 0;
			const double hoopAtEdge = isClamped ? nu * atEdge : p * a * a * (1 - nu) / 8;
			EXPECT_NEAR(plate.positions.front()[1] - 1, -w, 0.003 * w);
			EXPECT_NEAR(-plate.moments.front()[0], M, 0.01 * M);
			EXPECT_NEAR(plate.hoopMoment.front()[0], M, 0.01 * M);
			EXPECT_NEAR(plate.moments.back()[1], atEdge, 0.005 * M);
			EXPECT_NEAR(plate.hoopMoment.back()[1], hoopAtEdge, 0.005 * M);
			EXPECT_NEAR(plate.shearForce[10], -p * 0.525 * a / 2, 0.002 * p * a); // p r / 2 in the middle of a piece
		}
	}

	/// A long cylinder under a pressure, held at its foot: with b^4 = 3 (1 - nu^2) / (R t)^2 the moment is p / 2
	/// b^2 at a clamped edge and falls as exp(-b x) (cos b x - sin b x); far away N = p R around and the radius
	/// grows by p R^2 / E t.
	TEST(Shells, ACylinderBendsAtItsEdge)
	{
		constexpr double R = 3, t = 0.05, p = 1000, nu = 0.25;
		const double     b = std::pow(3 * (1 - nu * nu), 0.25) / std::sqrt(R * t), M = p / (2 * b * b), grows = p * R * R / (1e9 * t);
		Structure<2>     structure = shellAlong({ { R, 4 }, { R, 0 } }, 0.2 / b, plateOf(t, nu));
		auto&            wall      = *structure.beam;
		wall.fixedFoot = { true, true, true }, wall.weight = { p, 0 };
		settle(structure);
		const std::size_t last = wall.length0.size(), far = last / 2;
		EXPECT_NEAR(wall.positions[far][0] - R, grows, 0.002 * grows);
		EXPECT_NEAR(wall.hoopForce[far], p * R, 0.002 * p * R);
		EXPECT_NEAR(wall.axialForce[far], 0, 1e-6 * p * R);
		EXPECT_NEAR(std::abs(wall.moments.back()[1]), M, 0.01 * M);
		for (std::size_t i = last - 15; i < last; ++i) { // at the upper end of a piece
			const double x = b * wall.positions[i][1], moment = M * std::exp(-x) * (std::cos(x) - std::sin(x));
			EXPECT_NEAR(
			        wall.moments[i][0] * wall.moments.back()[1] < 0 ? std::abs(wall.moments[i][0]) : -std::abs(wall.moments[i][0]), moment,
			        0.01 * M);
			EXPECT_NEAR(wall.hoopMoment[i][0], -nu * wall.moments[i][0], 0.002 * M);
		}
	}

	/// A half of a sphere under its own weight, on rollers: without bending N = -q a / (1 + cos phi) along the
	/// meridian and q a (1 / (1 + cos phi) - cos phi) around, phi from the top; away from the foot.
	TEST(Shells, ADomeBearsItsWeightWithoutBending)
	{
		constexpr double    a = 5, q = 1000;
		std::vector<Vec<2>> meridian;
		for (int i = 0; i <= 60; ++i)
			meridian.push_back(a * Vec<2>(std::sin(i * M_PI / 120), std::cos(i * M_PI / 120)));
		meridian.front()[0]    = 0;
		Structure<2> structure = shellAlong(meridian, 1, plateOf(0.05, 0.2));
		auto&        dome      = *structure.beam;
		dome.fixedFoot = { false, true, false }, dome.weight = { 0, -q };
		settle(structure);
		for (int i = 2; i < 40; ++i) {
			const double c = std::cos((i + 0.5) * M_PI / 120);
			EXPECT_NEAR(dome.axialForce[i], -q * a / (1 + c), 0.01 * q * a) << i;
			EXPECT_NEAR(dome.hoopForce[i], q * a * (1 / (1 + c) - c), 0.01 * q * a) << i;
		}
	}

	/// A ball pressed from all sides by springs of soil that comes to it: N = p R / 2 both ways, p that of the
	/// springs.
	TEST(Shells, ASphereIsPressedFromAllSides)
	{
		constexpr double    R = 2, nu = 0.2;
		std::vector<Vec<2>> meridian;
		for (int i = 0; i <= 60; ++i)
			meridian.push_back(R * Vec<2>(std::sin(i * M_PI / 60), std::cos(i * M_PI / 60)));
		meridian.front()[0] = meridian.back()[0] = 0;
		Structure<2>              structure      = shellAlong(meridian, 1, plateOf(0.1, nu));
		auto&                     ball           = *structure.beam;
		std::vector<SoilAtVertex> soil(ball.positions.size());
		for (auto& at : soil)
			at = { true, 1, 0, 0, 1e7, 0.5 }; // the line goes round clockwise: to its left is outside
		ball.adhesion = 0;
		StructureSystem<2> system(structure, soil);
		Eigen::VectorXd    moves(system.soilUnknowns());
		for (std::size_t v = 0; v < meridian.size(); ++v)
			moves.segment<2>(system.soilUnknown(int(v))) = -1e-4 * meridian[v] / R;
		const auto found = system.solve(moves, {});
		ASSERT_TRUE(found.isFound);
		system.commit(found.x);
		const double k = 10 * 1e7 / 0.5, C = 2 * 1e9 * 0.1 / (R * R * (1 - nu)), p = 1e-4 * k * C / (k + C);
		for (std::size_t v = 2; v + 2 < meridian.size(); ++v) // up to 3 % too small at the poles
			EXPECT_NEAR(ball.sides[0].normalForce[v] / ball.sizeAt(int(v)), p, 0.02 * p) << v;
		for (std::size_t i = 0; i < ball.length0.size(); ++i) {
			EXPECT_NEAR(ball.axialForce[i], -p * R / 2, 0.01 * p * R / 2) << i;
			EXPECT_NEAR(ball.hoopForce[i], -p * R / 2, 0.02 * p * R / 2) << i;
		}
	}

	/// Plate with a hinge on a circle, whose parts turn by themselves: its middle is simply supported on the
	/// ring.
	TEST(Shells, HingesTakeNoMoment)
	{
		constexpr double a = 2, p = 100;
		Structure<2>     structure = shellAlong({ { 0, 1 }, { a, 1 } }, a / 20, plateOf(0.1, 0.3));
		auto&            plate     = *structure.beam;
		plate.isHinge[10] = plate.isHinge[20] = 1; // the one at the edge wins over what is held there
		plate.fixedFoot = { false, true, true }, plate.weight = { 0, -p };
		settle(structure);
		EXPECT_NEAR(plate.moments[9][1], 0, 1e-9 * p * a * a);
		EXPECT_NEAR(plate.moments[10][0], 0, 1e-9 * p * a * a);
		EXPECT_NEAR(plate.moments[19][1], 0, 1e-9 * p * a * a);
		const double M = p * a * a / 4 * 3.3 / 16;
		EXPECT_NEAR(-plate.moments[0][0], M, 0.02 * M);
	}

	/// Pull-out of an elastic strip from soil that does not move: u = P coth(a L) / (EA a) at its front,
	/// a^2 = k / EA.
	TEST(Bars, AreDrawnFromRigidSoilAsByTheClosedForm)
	{
		constexpr double EA = 1e6, k = 4e5, L = 2, P = 100, bond = 2000;
		Structure<2>     structure;
		structure.bars.resize(1);
		auto& bar         = structure.bars[0];
		bar.section       = { EA };
		bar.bondStiffness = k, bar.bond = bond, bar.pull = P;
		bar.begin(divided<2>({ { 0, 0 }, { 1.2, 1.6 } }, L / 40));
		const auto step = [&] {
			std::vector<SoilAtVertex> soil(bar.positions.size());
			for (auto& at : soil)
				at.exists = true;
			StructureSystem<2> system(structure, soil);
			const auto         found = system.solve(Eigen::VectorXd::Zero(system.soilUnknowns()), {});
			EXPECT_TRUE(found.isFound);
			system.commit(found.x);
		};
		step();
		const double a = std::sqrt(k / EA), expected = P / (EA * a * std::tanh(a * L));
		EXPECT_NEAR(bar.slip.front(), -expected, 1e-3 * expected); // against the direction of the bar
		bar.pull = 0.99 * bond * L;                                // the strength of the bond is bond * L
		step();
		EXPECT_NEAR(bar.bondForce.front(), -bond * L / 80, 1e-9);
		bar.pull = 0;
		step();
		EXPECT_LT(bar.slip.front(), 0); // it does not come back all the way
	}

	/// A block of soil with a structure in it.
	template <int Dim> struct Ground {
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		Structure<Dim>  structure;
		StepReport      report;
		LinearSolver    solver;

		Ground()
		{
			model.grid.cellSize    = 0.5;
			model.materials        = { { Hencky(1e6, 0.3), 0 } };
			model.newton.tolerance = 1e-10;
			Vec<Dim> top           = Vec<Dim>::Constant(infinity);
			top[1]                 = 0;
			model.boundary = Boundary<Dim>({ held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), top, std::string("xyz").substr(0, Dim)) });
			cloud          = block<Dim>(model.grid, cellsOf<Dim>(6, 4, 2), 2);
			model.coupledTerms
			        = { [this](const StepContext<Dim>& step, const State&) { return std::make_unique<StructureForce<Dim>>(structure, step); } };
		}
		Reinforcement<Dim>& nail()
		{
			structure.bars.resize(1);
			Reinforcement<Dim>& bar = structure.bars[0];
			bar.section             = { 1e6, infinity, false };
			Vec<Dim> from = Vec<Dim>::Constant(0.3), to = from;
			from[1] = 1.7, to[0] = 2.6, to[1] = 1.1;
			bar.begin(divided<Dim>({ from, to }, lengthOfPieces * model.grid.cellSize));
			return bar;
		}
		/// Error of the whole tangent along a direction.
		double tangentError()
		{
			const StepSystem<Dim> system(cloud, model, {}, report);
			Eigen::VectorXd       d = Random(3).vector(system.nodalSize(), 0.003), direction = Random(4).vector(system.nodalSize(), 1);
			system.basis.affineConstraints.template distribute<Dim>(d);
			system.basis.affineConstraints.template distribute<Dim>(direction);
			NodeMatrix<Dim> K;
			Couplings       beside;
			Eigen::VectorXd force, slope = Eigen::VectorXd::Zero(d.size());
			const auto      forceAt = [&](double s) {
                                EXPECT_FALSE(system.evaluate(d + s * direction, force, nullptr));
                                return force;
			};
			system.prepare(K, &beside);
			EXPECT_FALSE(system.evaluate(d, force, &K, nullptr, &beside));
			K.multiplyAdd(direction, slope);
			beside.multiplyAdd(direction, slope);
			system.basis.affineConstraints.template condense<Dim>(slope);
			const double          h        = 1e-6;
			const Eigen::VectorXd expected = (forceAt(h) - forceAt(-h)) / (2 * h);
			return (slope - expected).norm() / expected.norm();
		}
	};

	template <class Dimension> using Structures = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Structures, BothDimensions, DimensionName);

	TYPED_TEST(Structures, BarsWithAndWithoutSlipHaveTheTangentOfTheirForce)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool slips : { false, true }) {
			Ground<Dim> ground;
			auto&       bar = ground.nail();
			if (slips) bar.bondStiffness = 1e5, bar.bond = 3e3, bar.pull = 500;
			EXPECT_LT(ground.tangentError(), 1e-7);
		}
	}

	/// A bar that is pulled more in the step, and a beam that gets its loads and shrinks in it.
	TYPED_TEST(Structures, ForcesAtTheBeginningAreThoseOfTheLoadsOfThen)
	{
		constexpr int Dim         = TypeParam::value;
		const auto    atBeginning = [](Ground<Dim>& ground) {
                        const StepSystem<Dim> system(ground.cloud, ground.model, {}, ground.report);
                        const Eigen::VectorXd resistance = -system.context().imbalance();
                        Vec<Dim>              sum        = Vec<Dim>::Zero();
                        for (Eigen::Index i = 0; i < resistance.size(); ++i)
                                sum[i % Dim] += resistance[i];
                        return sum;
		};
		Ground<Dim> ground;
		auto&       bar   = ground.nail();
		bar.bondStiffness = 1e5, bar.bond = 3e4, bar.hasFreeLength = true, bar.head = Reinforcement<Dim>::Head::pulled;
		bar.pull = 500, bar.pullBefore = 200;
		EXPECT_NEAR(atBeginning(ground).norm(), 200, 1e-6);
		if constexpr (Dim == 2) {
			Ground<2> other;
			other.structure.beam.emplace();
			auto& beam            = *other.structure.beam;
			beam.section          = { 1e7, 1e5 };
			beam.weight           = { 0, -2000 };
			beam.headForce        = { 100, -200 };
			beam.shrinkage        = 0.99;
			beam.before.weight    = { 0, -500 };
			beam.before.headForce = { 0, -60 };
			beam.begin(divided<2>({ { 0.3, 1.3 }, { 2.7, 1.3 } }, 0.25));
			const Vec<2> force = atBeginning(other); // force by which the beam resists: its loads, turned round
			EXPECT_NEAR(force[0], 0, 1e-6);
			EXPECT_NEAR(force[1], 500 * 2.4 + 60, 1e-5);
		}
	}

	TYPED_TEST(Structures, FreeLengthsHaveTheTangentOfTheirForce)
	{
		constexpr int Dim = TypeParam::value;
		using Head        = typename Reinforcement<Dim>::Head;
		for (const Head head : { Head::plate, Head::pulled }) {
			Ground<Dim> ground;
			auto&       bar   = ground.nail();
			bar.hasFreeLength = true, bar.head = head, bar.bondStiffness = 1e5, bar.bond = 3e4;
			if (head == Head::pulled) bar.pull = 500;
			else
				bar.jack = 500;
			EXPECT_LT(ground.tangentError(), 1e-7);
		}
	}

	TEST(Structures, BeamsOnAndInTheSoilHaveTheTangentOfTheirForce)
	{
		for (const double height : { 2., 1.3 }) {
			Ground<2> ground;
			ground.structure.beam.emplace();
			auto& beam     = *ground.structure.beam;
			beam.section   = { 1e7, 1e5 };
			beam.weight    = { 0, -2000 };
			beam.headForce = { 100, -200 };
			beam.adhesion  = 300;
			beam.begin(divided<2>({ { 0.3, height }, { 2.7, height } }, 0.25));
			ground.structure.bars.resize(1);
			auto& anchor   = ground.structure.bars[0];
			anchor.section = { 1e6 };
			anchor.head = Reinforcement<2>::Head::joined, anchor.joint = 3, anchor.hasFreeLength = true;
			anchor.begin({ beam.positions[3], { 1.6, 0.9 }, { 1.8, 0.7 } });
			EXPECT_LT(ground.tangentError(), 1e-7);
		}
	}

	/// In a block that is stretched, a bar without slip has the strain of the soil.
	TYPED_TEST(Structures, ABarIsStretchedAsTheSoilIs)
	{
		constexpr int Dim = TypeParam::value;
		Ground<Dim>   ground;
		ground.nail().section.stiffness = 1e-3; // so that it does not matter to the soil
		ConstrainedBox<Dim> all
		        = held<Dim>(ground.model.grid, Vec<Dim>::Constant(-infinity), Vec<Dim>::Constant(infinity), std::string("xyz").substr(1, Dim - 1));
		ConstrainedBox<Dim> far = wallAbove<Dim>(ground.model.grid, 0, 3);
		far.displacement[0]     = 0.03;
		ground.model.boundary   = Boundary<Dim>({ all, wallBelow<Dim>(ground.model.grid, 0, 0), far });
		Load<Dim> load;
		load.factor = { 1, 1 };
		ASSERT_TRUE(loadStep(ground.cloud, ground.model, load, ground.solver).converged());
		const auto&  bar = ground.structure.bars[0];
		const double dx = 2.3, dy = 0.6, strain = std::log(std::hypot(1.01 * dx, dy) / std::hypot(dx, dy));
		for (std::size_t i = 0; i < bar.strain.size(); ++i)
			EXPECT_NEAR(bar.strain[i], strain, 1e-4 * strain);
	}

	/// Sand that only the stabilisation would hold goes on until stress bears it, also beside a bar that bears
	/// next to nothing.
	TEST(Structures, TheWorkOfTheStabilisationIsKnownBesideABar)
	{
		StepReport reports[2];
		for (const bool hasBar : { false, true }) {
			Ground<2> ground;
			ground.model.materials           = { { MohrCoulomb(1e7, 0.3, 1e3, 0.5, 0), 2e3 } };
			ground.model.ghost.workTolerance = 0.05;
			if (hasBar) ground.nail().section.stiffness = 1e-3;
			else
				ground.model.coupledTerms.clear();
			Load<2> load;
			load.gravity    = { 0, -10 };
			load.factor     = { 1, 1 };
			reports[hasBar] = loadStep(ground.cloud, ground.model, load, ground.solver);
			ASSERT_TRUE(reports[hasBar].converged()) << reports[hasBar].cause;
		}
		EXPECT_GT(reports[0].passes, 0);
		EXPECT_EQ(reports[1].passes, reports[0].passes);
		EXPECT_NEAR(reports[1].ghostShare, reports[0].ghostShare, 1e-4);
	}

	/// A loaded beam on soil hands all of its load to it.
	TEST(Structures, ABeamStandsOnTheSoil)
	{
		Ground<2> ground;
		ground.structure.beam.emplace();
		auto& beam   = *ground.structure.beam;
		beam.section = { 1e7, 1e5 };
		beam.weight  = { 0, -1000 };
		beam.begin(divided<2>({ { 0.5, 2 }, { 2.5, 2 } }, 0.25));
		ASSERT_TRUE(loadStep(ground.cloud, ground.model, {}, ground.solver).converged());
		double sum = 0;
		for (const double force : beam.sides[1].normalForce) // to the right of the beam, which is below
			sum += force;
		EXPECT_NEAR(sum, 2000, 1e-6 * 2000);
	}

	/// A block with a beam from its top down into it, which parts the soil beside it.
	struct PartedGround : Ground<2> {
		PartedGround(const Vec<2>& head, const Vec<2>& foot, BeamSection section = { 1e7, 1e5 })
		{
			structure.beam.emplace();
			structure.beam->section = section;
			structure.beam->begin(divided<2>({ head, foot }, 0.25));
			partSoil({ &*structure.beam }, cloud, model.grid);
		}
	};

	/// The cut ends half a cell to one and a half cells beyond the foot, wherever that is in its cell, and only
	/// points beside it, to its right, are in another layer.
	TEST(PartedSoil, IsPartedBeyondTheTip)
	{
		for (const double foot : { 0.8, 1., 1.2 }) {
			const PartedGround ground({ 1.5, 2 }, { 1.5, foot });
			ASSERT_TRUE(ground.model.grid.parting);
			const auto isOwn = [&](int x, int y) { return ground.model.grid.parting->isOwn(Grid<2>::key({ x, y }, 0, 1)); };
			EXPECT_TRUE(isOwn(3, 2) && isOwn(3, 3) && isOwn(3, 4));
			EXPECT_FALSE(isOwn(3, 1) || isOwn(2, 3) || isOwn(4, 3));
			for (std::size_t p = 0; p < ground.cloud.size(); ++p) {
				const Vec<2>& x = ground.cloud.position[p];
				EXPECT_EQ(ground.cloud.layer[p], x[0] < 1.5 && x[0] > 0.75 && x[1] > 0.25) << x.transpose();
			}
		}
		EXPECT_FALSE(PartedGround({ 0.5, 2 }, { 2.5, 2 }).model.grid.parting) << "there is soil on one side only";
	}

	TEST(PartedSoil, HasTheTangentOfItsForce)
	{
		for (const auto& [head, foot] : { std::pair(Vec<2>(1.5, 2), Vec<2>(1.5, 0.9)), std::pair(Vec<2>(1.2, 2.1), Vec<2>(1.9, 0.6)) }) {
			PartedGround ground(head, foot);
			auto&        beam = *ground.structure.beam;
			beam.headForce    = { 100, -200 };
			beam.friction     = 0.3;
			EXPECT_LT(ground.tangentError(), 1e-7);
		}
	}

	/// In time: a block that flies and whose two halves run into a beam between them. It needs no more of Newton's
	/// method than a whole one, loses no momentum, and its halves bounce back.
	TEST(PartedSoil, KeepsItsMomentumInTime)
	{
		for (const TimeScheme& scheme : { TimeScheme {}, TimeScheme::midpoint() }) {
			Moving<2>    moving(0.5, Hencky(1e6, 0.3), 2000, scheme);
			Structure<2> structure;
			moving.model.newton.tolerance = 1e-11;
			moving.put(block<2>(moving.model.grid, { 6, 4 }, 2), [](const Vec<2>& x) { return Vec<2>(x[0] < 1.5 ? 1.2 : 0.8, 2); });
			structure.beam.emplace();
			structure.beam->section = { 1e7, 1e5 };
			structure.beam->begin(divided<2>({ { 1.5, 2 }, { 1.5, 0.5 } }, 0.25));
			moving.model.coupledTerms
			        = { [&structure](const StepContext<2>& step, const State&) { return std::make_unique<StructureForce<2>>(structure, step); } };
			const Vec<2> before  = moving.momentum();
			double       pressed = 0;
			for (int step = 0; step < 10; ++step) {
				moving.model.grid.parting.reset(), moving.cloud.layer.clear(); // same as for each step of an engine
				partSoil({ &*structure.beam }, moving.cloud, moving.model.grid);
				ASSERT_EQ(structure.beam->layer, 1);
				const StepReport report = moving.step(2e-3);
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_LE(report.iterations, 6);
				pressed = std::max(pressed, structure.beam->sides[0].normalForce[2]);
			}
			EXPECT_LT((moving.momentum() - before).norm(), 1e-10 * before.norm());
			EXPECT_GT(pressed, 100);
		}
	}

	/// Lines of force go along the cut, wherever it is, and do not end at it: displacements stay linear, also
	/// across the faces of the stabilisation, which are there for all cells that the cut leaves half empty.
	TEST(PartedSoil, TakesNoNoticeOfAPullAlongTheCut)
	{
		for (const auto& [head, foot] : { std::pair(Vec<2>(1.5, 2), Vec<2>(1.5, 1)), std::pair(Vec<2>(1.63, 2.1), Vec<2>(1.63, 0.77)) }) {
			PartedGround ground(head, foot);
			ground.model.coupledTerms.clear(); // the cut alone
			ground.model.materials = { { Hencky(1e6, 0), 0 } };
			auto base              = held<2>(ground.model.grid, { -infinity, -infinity }, { infinity, 0 }, "xy");
			auto top               = held<2>(ground.model.grid, { -infinity, 2 }, { infinity, infinity }, "xy");
			top.displacement       = { 0, 0.02 };
			ground.model.boundary  = Boundary<2>({ base, top });
			ground.cloud.position0 = ground.cloud.position;
			const auto before      = ground.cloud.position;
			ASSERT_TRUE(loadStep(ground.cloud, ground.model, { {}, 1, 1 }, ground.solver).converged());
			for (std::size_t p = 0; p < before.size(); ++p) {
				const Vec<2> u = ground.cloud.position[p] - before[p];
				EXPECT_NEAR(u[1], 0.01 * before[p][1], 1e-10);
				EXPECT_NEAR(u[0], 0, 1e-10);
			}
		}
	}

	/// Two columns on a smooth base, of which one is heavier, slide on a smooth beam between them.
	TEST(PartedSoil, SlidesOnASmoothBeam)
	{
		PartedGround ground({ 1.5, 2 }, { 1.5, 0 });
		auto&        beam      = *ground.structure.beam;
		beam.adhesion          = 0;
		ground.model.materials = { { Hencky(1e6, 0), 1000 }, { Hencky(1e6, 0), 3000 } };
		for (std::size_t p = 0; p < ground.cloud.size(); ++p)
			ground.cloud.material[p] = ground.cloud.position[p][0] > 1.5;
		ground.model.boundary = Boundary<2>({ held<2>(ground.model.grid, { -infinity, -infinity }, { 0, infinity }, "x"),
		                                      held<2>(ground.model.grid, { 3, -infinity }, { infinity, infinity }, "x"),
		                                      held<2>(ground.model.grid, { -infinity, -infinity }, { infinity, 0 }, "y") });
		const auto before     = ground.cloud.position;
		ASSERT_TRUE(loadStep(ground.cloud, ground.model, { { 0, -1 }, 1, 1 }, ground.solver).converged());
		for (std::size_t p = 0; p < before.size(); ++p) {
			const double rho = before[p][0] > 1.5 ? 3000 : 1000, y = before[p][1], exact = rho * (2 * y - y * y / 2) / 1e6;
			EXPECT_NEAR(before[p][1] - ground.cloud.position[p][1], exact, 0.02 * rho * 2 / 1e6) << before[p].transpose();
		}
	}

} // namespace
} // namespace gimpm::testStructures
