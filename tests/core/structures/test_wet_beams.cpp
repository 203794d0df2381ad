// SPDX-License-Identifier: GPL-2.0-or-later
// Beams beside water that flows: its pressure at each iterate, and the volume that opens between soil and beam.
#include "core/structures/parting_lines.hpp"
#include "core/structures/structure_force.hpp"
#include "derivatives.hpp"
#include "wet_soil.hpp"

namespace gimpm::testWetBeams {
namespace {

	/// A box of wet soil with a beam from its top down into it.
	struct WetGround : Soil<2> {
		Structure<2> structure;

		explicit WetGround(bool isWhole) : Soil<2>(0.5, { 3, 2 })
		{
			if (isWhole) this->water.whole.emplace().weight = Vec<2>(0, -1e4);
			structure.beam.emplace();
			Beam& beam      = *structure.beam;
			beam.section    = { 1e7, 1e5 };
			beam.waterPulls = !isWhole;
			beam.begin({ { 1.45, 2 }, { 1.45, 1.75 }, { 1.45, 1.5 }, { 1.45, 1.25 }, { 1.45, 1 }, { 1.45, 0.8 } });
			partSoil({ &beam }, cloud, model.grid);
			model.coupledTerms.push_back(
			        [this](const StepContext<2>& step, const State&) { return std::make_unique<StructureForce<2>>(structure, step); });
			model.water = [](const CloudBasis<2>& basis, const Eigen::VectorXd* field) {
				return field ? *field : Eigen::VectorXd(Eigen::VectorXd::Zero(Eigen::Index(basis.nodes.size())));
			};
		}
	};

	TEST(WetBeams, TheTangentIsThatOfTheForces)
	{
		for (const bool isWhole : { true, false }) {
			WetGround ground(isWhole);
			ground.water.duration = isWhole ? 3 : 0; // a symmetric matrix leaves a part of flow out
			ASSERT_TRUE(ground.model.grid.parting);
			Random random(3);
			for (auto& pressure : ground.water.pressure)
				pressure = random.in(-3e3, 1e4);
			StepReport          report;
			const StepSystem<2> system(ground.cloud, ground.model, Load<2>(), report);
			const auto          in = [&](int field, double size) {
                                Eigen::VectorXd x   = Eigen::VectorXd::Zero(system.map.size()),
                                                own = random.vector(system.map.end(field) - system.map.begin(field), size);
                                const auto& tied    = system.basis.affineConstraints; // nodes beyond the cut
                                field == 0 ? tied.template distribute<2>(own) : tied.template distribute<1>(own);
                                system.map.of(field, x) = own;
                                return x;
			};
			const auto rows = [&](int field, const Eigen::VectorXd& x) {
				Eigen::VectorXd own  = system.map.of(field, x);
				const auto&     tied = system.basis.affineConstraints;
                                field == 0 ? tied.template condense<2>(own) : tied.template condense<1>(own);
				return own;
			};
			const double          sizes[] = { 0.004, 5e3 };
			const Eigen::VectorXd x       = in(0, sizes[0]) + in(1, sizes[1]);
			EXPECT_EQ(system.isSymmetric(), !isWhole);
			for (const int column : { 0, 1 }) {
				const auto [tangent, slope] = coupledDerivatives(system, x, in(column, 1e-4 * sizes[column]));
				for (const int row : { 0, 1 })
					EXPECT_LE((rows(row, tangent) - rows(row, slope)).norm(), 1e-6 * rows(row, slope).norm()) << isWhole << row << column;
			}
		}
	}

	/// Soil that drains nowhere takes a load of which the beam knows in the same step: none of it is left to the
	/// springs between them, and what opens there is what the soil around loses.
	TEST(WetBeams, WaterOfTheSameStepPresses)
	{
		WetGround ground(false);
		ground.hold({ wallAbove<2>(ground.model.grid, 0, 3) });
		ground.push(line({ 3, 2 }, { 0, 2 }), { 0, -1e3 });
		ASSERT_TRUE(ground.step(1e-6).converged());
		const Beam& beam = *ground.structure.beam;
		for (std::size_t v = 1; v + 1 < beam.positions.size(); ++v)
			for (const BeamSide& side : beam.sides) {
				EXPECT_NEAR(side.water[v], 1e3, 20) << v;
				EXPECT_NEAR(side.normalForce[v], 0, 0.02 * 1e3 * beam.sizeAt(int(v))) << v;
			}
	}

} // namespace
} // namespace gimpm::testWetBeams
