// SPDX-License-Identifier: GPL-2.0-or-later
// A user material by Abaqus' interface with tensors among its state variables: a back stress, and a plastic strain with
// twice the shear components.
#include "core/materials/umat.hpp"
#include "core/terms/points/point_update.hpp"
#include "scenes.hpp"

namespace gimpm::testUmat {
namespace {

	constexpr double K = 2e3, G = 1e3, yield = 20, byBackStress = 200, byStrain = 100;

	/// Von Mises with linear kinematic hardening: by the back stress in state[1] to state[6], and by the plastic
	/// strain in state[7] to state[12]; state[0] is a scalar.
	void kinematic(
	        double* stress, double* state, double* tangent, double*, double*, double*, double*, double*, double*, double*, const double*,
	        const double* increment, const double*, const double*, const double*, const double*, const double*, const double*, const char*, const int*,
	        const int*, const int*, const int* states, const double*, const int*, const double*, const double*, double*, const double*, const double*,
	        const double*, const int*, const int*, const int*, const int*, const int*, const int*, int)
	{
		ASSERT_EQ(*states, 13);
		ASSERT_TRUE(std::isnan(state[13]));
		const double volume = increment[0] + increment[1] + increment[2];
		double       relative[6], square = 0;
		for (int i = 0; i < 6; ++i)
			stress[i] += i < 3 ? K * volume + 2 * G * (increment[i] - volume / 3) : G * increment[i];
		const double mean = (stress[0] + stress[1] + stress[2]) / 3;
		for (int i = 0; i < 6; ++i) {
			relative[i] = stress[i] - (i < 3 ? mean : 0) - state[1 + i] - byStrain * state[7 + i] / (i < 3 ? 1 : 2);
			square += (i < 3 ? 1 : 2) * relative[i] * relative[i];
		}
		const double length = std::sqrt(square), flow = std::max(0., length - yield) / (2 * G + byBackStress + byStrain);
		for (int i = 0; i < 6; ++i) {
			const double strain = length > 0 ? flow * relative[i] / length : 0;
			stress[i] -= 2 * G * strain;
			state[1 + i] += byBackStress * strain;
			state[7 + i] += (i < 3 ? 1 : 2) * strain;
			tangent[7 * i] = 1;
		}
		state[0] += flow;
	}

	/// One point on a path of deformation gradients.
	struct Path {
		Law             law;
		InternalColumns internals {};
		SymTensor<3>    elasticStrain {};
		Mat3            stress = Mat3::Zero();

		explicit Path(const UmatTensors& tensors) : law(lawOf(tensors)) { provideInternals(internals, { { law, 1 } }, 1); }

		static Law lawOf(const UmatTensors& tensors)
		{
			const auto door
			        = std::make_shared<UmatDoor>(kinematic, std::vector<double> {}, std::vector<double>(13, 0.), nullptr, "", "umat_", tensors);
			door->elastic = Hencky(9 * K * G / (3 * K + G), (3 * K - 2 * G) / (6 * K + 2 * G));
			if (door->tensors() == 2) return UserLaw<2, 8>(door);
			return UserLaw<0, 20>(door);
		}
		void apply(const Mat3& F)
		{
			const TensorPoint now
			        = respondInSpace(law, { {}, internals, 0 }, { leftCauchyGreenMinusOne(elasticStrain), F - Mat3::Identity(), 0, false });
			elasticStrain = SymTensor<3>::from(now.elasticStrain), stress = now.stress;
			storeInternals(law, now.state.numbers(), internals, 0);
		}
		Mat3 tensor(const std::string& name) const
		{
			Mat3       t;
			const char axes[] = "XYZ";
			for (int i = 0; i < 3; ++i)
				for (int j = i; j < 3; ++j) {
					const bool isLast = i == 0 && j == 2; // named ZX
					t(i, j) = t(j, i) = internals[internalVariables.find(name + axes[isLast ? 2 : i] + axes[isLast ? 0 : j])][0];
				}
			return t;
		}
	};

	/// Largest difference of the stress that an observer sees who turns at random, turned back, over the yield
	/// stress.
	double differenceByTurns(const UmatTensors& tensors)
	{
		Random random(5);
		Path   ours(tensors), theirs(tensors);
		Mat3   Q          = Mat3::Identity();
		double difference = 0;
		for (int step = 0; step < 20; ++step) {
			const Mat3 F = Mat3::Identity() + random.matrix<3, 3>(.05), turn = random.rotation<3>();
			ours.apply(F), theirs.apply(turn * F * Q.transpose());
			Q          = turn;
			difference = std::max(difference, (theirs.stress - Q * ours.stress * Q.transpose()).norm() / yield);
		}
		return difference;
	}

	TEST(Umat, TensorsAmongItsStateVariablesTurnWithTheMaterial)
	{
		EXPECT_LT(differenceByTurns({ { 1 }, { 7 } }), 1e-10);
		EXPECT_GT(differenceByTurns({}), .1); // as numbers they stay behind
	}

	TEST(Umat, ATensorLikeStrainHasTwiceTheShearInTheLaw)
	{
		Path path({ { 1 }, { 7 } });
		Mat3 F  = Mat3::Identity();
		F(0, 1) = .2;
		path.apply(F);
		const Mat3 back = path.tensor("stateTensor1"), strain = path.tensor("stateTensor2");
		EXPECT_GT(back(0, 1), yield / 4);
		EXPECT_LT((back - byBackStress * strain).norm(), 1e-10 * yield);
	}

} // namespace
} // namespace gimpm::testUmat
