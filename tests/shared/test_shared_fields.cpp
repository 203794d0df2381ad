// SPDX-License-Identifier: GPL-2.0-or-later
// Several processes, which mpirun starts, make steps with several fields and with nodes that are coupled: each compares
// what they come to with what it comes to alone.
#include "core/base/checksum.hpp"
#include "core/solvers/multigrid.hpp"
#include "core/solvers/opened_processes.hpp"
#include "divided_points.hpp"
#include "seepage.hpp"
#include "tendon.hpp"
#include <dlfcn.h>

namespace gimpm::testSharedFields {
namespace {

	using namespace seepage;

	const std::shared_ptr<const Processes>& all()
	{
		static const std::shared_ptr<const Processes> opened = [] {
			Multigrid::openFrom(MPM_PETSC);
			std::string reason;
			auto        processes = openProcesses(reason);
			if (!processes) ADD_FAILURE() << reason;
			return processes;
		}();
		return opened;
	}

	/// Each has its own points, or all of them have all.
	template <int Dim> void share(PointCloud<Dim>& cloud, Model<Dim>& model, bool isDivided)
	{
		model.processes = all();
		if (!isDivided) return;
		model.division = std::make_shared<Division>(Division { all(), cutByWork(loadsOf(cloud, model), all()->size()) });
		cloud          = partOf(cloud, model, *model.division);
	}

	/// Largest distance of the points of this process from their positions in a whole.
	template <int Dim> double distance(const PointCloud<Dim>& own, const Division& division, const PointCloud<Dim>& whole)
	{
		double largest = 0;
		for (std::size_t p = 0; p < own.size(); ++p)
			largest = std::max(largest, (own.position[p] - whole.position[division.idOf(int(p))]).norm());
		return largest;
	}

	template <class Dimension> using SharedFields = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(SharedFields, BothDimensions, DimensionName);

	TYPED_TEST(SharedFields, AreThoseOfOneProcess)
	{
		constexpr int Dim = TypeParam::value;
		ASSERT_GT(all()->size(), 1);
		const auto run = [](Body<Dim>& body, const Medium& medium, StepReport& report) {
			body.medium                 = medium;
			body.model.newton.tolerance = 1e-12;
			for (int step = 0; step < (Dim == 2 ? 3 : 2); ++step) {
				body.ends[0] += 5e3, body.ends[1] -= 2e3;
				report = body.step();
				ASSERT_TRUE(report.converged()) << report.cause;
				body.before = body.value.mean();
			}
		};
		for (const Medium& medium : { Medium { 1e-8, 0, 1, 1, -1, 0.01 }, Medium { 1e-7, 1e-4, 1, 1, 1, 0.01 } }) {
			Body<Dim>  alone(0.3);
			StepReport told, toldTogether;
			run(alone, medium, told);
			for (const bool isDivided : { false, true })
				for (const auto method : { LinearMethod::direct, LinearMethod::iterative }) { // iterative: with multigrid
					Body<Dim> together(0.3);
					share(together.cloud, together.model, isDivided);
					EXPECT_EQ(together.cloud.size() < alone.cloud.size(), isDivided);
					together.model.newton.linearSolver = method;
					run(together, medium, toldTogether);
					EXPECT_EQ(toldTogether.conjugateGradients.iterations > 0, method != LinearMethod::direct);
					EXPECT_EQ(toldTogether.conjugateGradients.fallbacks, 0) << toldTogether.conjugateGradients.reason;
					EXPECT_TRUE(method != LinearMethod::direct || toldTogether.iterations == told.iterations);
					ASSERT_EQ(together.value.size(), alone.value.size());
					const double largest = alone.value.template lpNorm<Eigen::Infinity>(),
					             flow    = alone.flow.template lpNorm<Eigen::Infinity>();
					EXPECT_LT((together.value - alone.value).template lpNorm<Eigen::Infinity>(), 1e-10 * largest);
					EXPECT_LT((together.flow - alone.flow).template lpNorm<Eigen::Infinity>(), 1e-10 * flow);
					EXPECT_LT(distance(together.cloud, *together.model.division, alone.cloud), 1e-10 * Body<Dim>::length);
					Checksum bits;
					bits.mix(std::vector<double>(together.value.begin(), together.value.end()));
					EXPECT_TRUE(all()->haveSame(bits.take())) << "the same in all processes, to the last bit";
				}
		}
	}

	TYPED_TEST(SharedFields, NodesFarApartAreCoupledAsInOneProcess)
	{
		constexpr int Dim = TypeParam::value, length = 12;
		for (const bool isDivided : { false, true })
			for (const auto method : { LinearMethod::direct, LinearMethod::iterative, LinearMethod::multigrid }) {
				Braced<Dim>  alone(length, LinearMethod::direct), together(length, method);
				LinearSolver solver, shared;
				share(together.cloud, together.model, isDivided);
				const StepReport report  = loadStep<Dim>(alone.cloud, alone.model, {}, solver);
				const StepReport another = loadStep<Dim>(together.cloud, together.model, {}, shared);
				ASSERT_TRUE(report.converged() && another.converged()) << another.cause;
				EXPECT_EQ(another.conjugateGradients.iterations > 0, method != LinearMethod::direct);
				EXPECT_EQ(another.conjugateGradients.fallbacks, 0) << another.conjugateGradients.reason;
				EXPECT_NEAR(together.tendon.force / alone.tendon.force, 1, 1e-10);
				EXPECT_LT(distance(together.cloud, *together.model.division, alone.cloud), 1e-10);
			}
	}

} // namespace
} // namespace gimpm::testSharedFields

int main(int count, char** arguments)
{
	testing::InitGoogleTest(&count, arguments);
	gimpm::testSharedFields::all();
	const int failed = RUN_ALL_TESTS();
	// MPI is ended by the program that opens the library. There is another function of this name, of a solver for
	// one process.
	const auto end = reinterpret_cast<int (*)()>(dlsym(dlopen(MPM_PETSC, RTLD_NOW | RTLD_NOLOAD), "MPI_Finalize"));
	return end() + failed;
}
