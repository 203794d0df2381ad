// SPDX-License-Identifier: GPL-2.0-or-later
// Points that are divided among processes: each assembles its rows from its own points and copies of others'. Threads
// stand for the processes.
#include "core/parallel/halo.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/inertia/inertia.hpp"
#include "core/terms/inertia/rayleigh.hpp"
#include "divided_points.hpp"
#include "threads_as_processes.hpp"
#include <atomic>

namespace gimpm::testDivision {
namespace {

	template <class Dimension> struct DivisionOf : InBothDimensions<Dimension> {
		static constexpr int Dim = Dimension::value;

		/// A block that hangs on its lowest layer, stretched unevenly, with points off the middle of the cells.
		static PointCloud<Dim> cloud(const Grid<Dim>& grid)
		{
			auto   c = block(grid, cellsOf<Dim>(5, 5, 6), 2);
			Random numbers(3);
			for (std::size_t p = 0; p < c.size(); ++p) {
				c.position[p].array() += 0.3;
				c.defGrad[p] += numbers.matrix<Dim, Dim>(0.01);
				c.halfSize[p] *= numbers.in(0.8, 1.2);
			}
			return c;
		}
		static Model<Dim> model(bool fBar, double ghost, bool isPeriodic = false)
		{
			Model<Dim> m;
			if (isPeriodic) m.grid.period[Dim - 1] = Dim == 2 ? 5 : 6; // domains reach beyond
			m.boundary     = Boundary<Dim>({ wallBelow<Dim>(m.grid, isPeriodic ? 0 : Dim - 1, 0) });
			m.materials    = { { Hencky(1e6, 0.3), 2000 } };
			m.fBar         = fBar;
			m.ghost.factor = ghost;
			return m;
		}

		/// Calls f(its points, its model) in each of two processes, and of three.
		template <class F> static void inProcesses(const PointCloud<Dim>& all, const Model<Dim>& model, F&& f)
		{
			for (const int processes : { 2, 3 })
				inThreads(processes, [&](const std::shared_ptr<const Processes>& process) {
					auto mine      = model;
					mine.processes = process;
					mine.division  = std::make_shared<Division>(Division { process, cutByWork(loadsOf(all, model), processes) });
					auto cloud     = partOf(all, model, *mine.division);
					f(cloud, mine);
				});
		}
	};
	TYPED_TEST_SUITE(DivisionOf, BothDimensions, DimensionName);

	TYPED_TEST(DivisionOf, ForcesAreThoseOfAllPoints)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& [fBar, ghost, isPeriodic] :
		     { std::tuple(false, 0., false), std::tuple(false, 0.01, false), std::tuple(true, 0.01, false), std::tuple(true, 0.01, true) }) {
			const auto            model = TestFixture::model(fBar, ghost, isPeriodic);
			const auto            all   = TestFixture::cloud(model.grid);
			StepReport            report;
			Load<Dim>             load { -9.81 * Vec<Dim>::Unit(Dim - 1), { 1, 1 } };
			const StepSystem<Dim> whole(all, model, load, report);
			const Eigen::VectorXd d = Random(1).vector(whole.nodalSize(), 0.02);
			Eigen::VectorXd       force, absoluteContributions;
			ASSERT_FALSE(whole.evaluate(d, force, nullptr, &absoluteContributions));
			TestFixture::inProcesses(all, model, [&](PointCloud<Dim>& cloud, const Model<Dim>& mine) {
				EXPECT_LT(cloud.size(), 0.7 * double(all.size()));
				const std::size_t own = cloud.size();
				{
					const Halo            halo(cloud, *mine.division, [&] { return pointsForOthers(cloud, mine); });
					StepReport            ofMine;
					const StepSystem<Dim> system(cloud, mine, load, ofMine);
					if (mine.processes->rank() > 0) {
						EXPECT_GT(cloud.size(), own) << "points reach nodes above them";
					}
					EXPECT_EQ(system.basis.nodes, whole.basis.nodes);
					EXPECT_EQ(system.basis.cells, whole.basis.cells);
					EXPECT_EQ(ofMine.ghostFaces, report.ghostFaces);
					Eigen::VectorXd found, foundContributions;
					EXPECT_FALSE(system.evaluate(d, found, nullptr, &foundContributions));
					EXPECT_LT((found - force).norm(), 1e-13 * force.norm());
					EXPECT_LT((foundContributions - absoluteContributions).norm(), 1e-13 * absoluteContributions.norm());
					EXPECT_LT((system.external - whole.external).norm(), 1e-13 * whole.external.norm());
				}
				EXPECT_EQ(cloud.size(), own);
			});
		}
	}

	/// Motion of points with these numbers, and its state after a step.
	template <int Dim> struct Moved {
		Motion<Dim>     motion {};
		Rayleigh        rayleigh { 0.5, 0.01 };
		Eigen::VectorXd force {}, own {};

		explicit Moved(const std::vector<std::int64_t>& points)
		{
			motion.duration = 0.01;
			for (const std::int64_t p : points) {
				Random random(p + 1);
				motion.mass.push_back(random.in(200, 300));
				motion.velocity.push_back(random.vector(Dim, 1));
				motion.acceleration.push_back(random.vector(Dim, 20));
			}
		}
		void step(const PointCloud<Dim>& cloud, Model<Dim> model, const Eigen::VectorXd& d)
		{
			motion.damping = { [&](const StepContext<Dim>& step) {
				return std::make_unique<RayleighDamping<Dim>>(rayleigh, model.materials, false, motion.mass, step);
			} };
			model.inertia = [&](const StepContext<Dim>& step) { return std::make_unique<Inertia<Dim>>(motion, step); };
			StepReport            report;
			const StepSystem<Dim> system(cloud, model, { Vec<Dim>::Unit(0), { 1, 0 } }, report);
			EXPECT_FALSE(system.evaluate(d, force, nullptr));
			own = system.inertialPredictor;
			system.terms.back()->commit(d);
		}
	};

	/// Motion with single points above the block, in cells that are loose; velocities, accelerations and works of a
	/// step, and what is left of the motion for the next one.
	TYPED_TEST(DivisionOf, MotionIsThatOfAllPoints)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    model = TestFixture::model(false, 0.01);
		auto          all   = TestFixture::cloud(model.grid);
		for (std::size_t p = 0, left = 0; p < all.size(); ++p)
			if (all.position[p][Dim - 1] > 3 && p % 7 != 0) all.position[p][Dim - 1] = 0.6 + 1e-3 * double(left++ % 9);
		std::vector<std::int64_t> numbers(all.size());
		std::iota(numbers.begin(), numbers.end(), 0);
		StepReport            report;
		const StepSystem<Dim> system(all, model, {}, report);
		const Eigen::VectorXd d = Random(1).vector(system.nodalSize(), 0.01);
		Moved<Dim>            whole(numbers);
		EXPECT_FALSE(looseOf(whole.motion, system.context()).empty());
		whole.step(all, model, d);
		TestFixture::inProcesses(all, model, [&](PointCloud<Dim>& cloud, const Model<Dim>& mine) {
			Moved<Dim> part(mine.division->id);
			{
				const Halo halo(cloud, *mine.division, [&] { return pointsForOthers(cloud, mine); });
				part.step(cloud, mine, d);
			}
			EXPECT_LT((part.force - whole.force).norm(), 1e-11 * whole.force.norm());
			EXPECT_LT((part.own - whole.own).norm(), 1e-10 * whole.own.norm());
			EXPECT_NEAR(part.motion.ghostWork / whole.motion.ghostWork, 1, 1e-9);
			EXPECT_NEAR(part.motion.gridWork / whole.motion.gridWork, 1, 1e-9);
			EXPECT_NEAR(part.rayleigh.work / whole.rayleigh.work, 1, 1e-9);
			ASSERT_EQ(part.motion.velocity.size(), mine.division->id.size()) << "those of copies have gone";
			for (std::size_t i = 0; i < mine.division->id.size(); ++i) {
				const auto p = mine.division->id[i];
				EXPECT_LT((part.motion.velocity[i] - whole.motion.velocity[p]).norm(), 1e-9);
				EXPECT_LT((part.motion.acceleration[i] - whole.motion.acceleration[p]).norm(), 1e-6);
			}
		});
	}

	std::vector<Key> ownOf(const std::vector<Key>& cells, const Division& division)
	{
		std::vector<Key> own;
		std::copy_if(cells.begin(), cells.end(), std::back_inserter(own), [&](Key cell) { return division.owns(cell); });
		return own;
	}

	/// A row of points that stands on the block, through the ranges of several processes.
	template <int Dim> PointCloud<Dim> withRow(PointCloud<Dim> block, int points)
	{
		for (int k = 0; k < points; ++k) {
			Vec<Dim> x = Vec<Dim>::Constant(2.5);
			x[Dim - 1] = (Dim == 2 ? 6.5 : 7.5) + k;
			addPoint<Dim>(block, x, Vec<Dim>::Constant(0.2));
		}
		return block;
	}

	/// Distance of a cell from one whose points tell its velocities is known to all.
	TYPED_TEST(DivisionOf, LooseCellsAreThoseOfAllPoints)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    model = TestFixture::model(false, 0.01);
		const auto    all   = withRow<Dim>(TestFixture::cloud(model.grid), 200);
		const auto    keys  = [&](const PointCloud<Dim>& cloud, const Model<Dim>& m, int reach) {
                        StepReport            report;
                        const StepSystem<Dim> system(cloud, m, {}, report);
                        Motion<Dim>           motion;
                        motion.mass.assign(cloud.size(), 1);
                        std::vector<Key> lowest;
                        for (const auto& cell : looseOf(motion, system.context(), reach))
                                lowest.push_back(system.basis.nodes[cell.node[0]]);
                        return lowest;
		};
		for (const int reach : { Dim, 1000 }) {
			const auto whole = keys(all, model, reach);
			EXPECT_EQ(whole.size() > 190, reach == Dim) << whole.size();
			TestFixture::inProcesses(all, model, [&](PointCloud<Dim>& cloud, const Model<Dim>& mine) {
				const Halo halo(cloud, *mine.division, [&] { return pointsForOthers(cloud, mine); });
				EXPECT_EQ(ownOf(keys(cloud, mine, reach), *mine.division), ownOf(whole, *mine.division));
			});
		}
	}

	TYPED_TEST(DivisionOf, MassOfTornCellsIsThatOfAllPoints)
	{
		constexpr int Dim     = TypeParam::value;
		const auto    model   = TestFixture::model(false, 0.01);
		const auto    all     = withRow<Dim>(TestFixture::cloud(model.grid), 50);
		const auto    momenta = [](const PointCloud<Dim>& cloud, const Model<Dim>& m, bool isTorn) {
                        StepReport            report;
                        const StepSystem<Dim> system(cloud, m, {}, report);
                        Motion<Dim>           motion;
                        motion.duration = 1;
                        motion.mass.assign(cloud.size(), 1);
                        const Eigen::VectorXd velocity = Random(1).vector(system.nodalSize(), isTorn ? 10 : 0.1);
                        const auto            loose    = looseOf(motion, system.context());
                        const auto            torn     = tornOf(loose, velocity, motion, system.context());
                        EXPECT_EQ(torn.empty(), !isTorn || loose.empty());
                        return Eigen::VectorXd(massMatrix(motion, system.context(), loose, torn) * velocity);
		};
		const Eigen::VectorXd whole = momenta(all, model, true);
		EXPECT_GT((whole - 100 * momenta(all, model, false)).norm(), 0.01 * whole.norm());
		TestFixture::inProcesses(all, model, [&](PointCloud<Dim>& cloud, const Model<Dim>& mine) {
			const Halo halo(cloud, *mine.division, [&] { return pointsForOthers(cloud, mine); });
			EXPECT_LT((momenta(cloud, mine, true) - whole).norm(), 1e-13 * whole.norm());
		});
	}

	TYPED_TEST(DivisionOf, CutsAreBalanced)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    model = TestFixture::model(false, 0);
		const auto    loads = loadsOf<Dim>(TestFixture::cloud(model.grid), model);
		for (const int processes : { 2, 3, 4 }) {
			const auto first = cutByWork(loads, processes);
			ASSERT_EQ(int(first.size()), processes - 1);
			inThreads(processes, [&](const std::shared_ptr<const Processes>& process) {
				const Division        division { process, first };
				std::vector<CellLoad> own;
				std::copy_if(
				        loads.begin(), loads.end(), std::back_inserter(own), [&](const CellLoad& load) { return division.owns(load.lowest); });
				EXPECT_LT(imbalance(*process, own), Dim == 2 ? 0.2 : 0.05);
			});
		}
		EXPECT_EQ(cutByWork({ { 7, 1 } }, 3), std::vector<Key>(2, ~Key(0))) << "one cell is one process's";
	}

	/// Whatever columns there are.
	TYPED_TEST(DivisionOf, CopiesHaveAllThatPointsHave)
	{
		constexpr int Dim   = TypeParam::value;
		const auto    model = TestFixture::model(false, 0.01);
		auto          all   = TestFixture::cloud(model.grid);
		all.internals       = { {}, std::vector<double>(1) };
		all.parameters      = { std::vector<double>(1) };
		int number          = 0;
		forColumns(all, [&](auto& column, ColumnPolicy policy) {
			++number;
			// Columns that no point needs.
			if (policy == ColumnPolicy::always || static_cast<void*>(&column) == &all.internals[0]) return;
			column.resize(all.size());
			for (auto& value : column)
				std::memset(static_cast<void*>(&value), number, sizeof value);
		});
		std::atomic_int compared { 0 };
		TestFixture::inProcesses(all, model, [&](PointCloud<Dim>& cloud, const Model<Dim>& mine) {
			const Halo halo(cloud, *mine.division, [&] { return pointsForOthers(cloud, mine); });
			const auto compare = [&](const auto& found, const auto& expected) {
				ASSERT_EQ(found.size(), expected.empty() ? 0 : cloud.size());
				for (std::size_t p = 0; p < found.size(); ++p)
					EXPECT_EQ(std::memcmp(&found[p], &expected[mine.division->idOf(int(p))], sizeof found[p]), 0);
				++compared;
			};
			const auto look = [&](auto of) {
				if constexpr (std::is_same_v<std::decay_t<decltype(cloud.*of)>, InternalColumns>)
					for (std::size_t k = 0; k < (all.*of).size(); ++k)
						compare((cloud.*of)[k], (all.*of)[k]);
				else
					compare(cloud.*of, all.*of);
			};
			std::apply([&](const auto&... column) { (look(column.of), ...); }, PointCloud<Dim>::columns());
		});
		EXPECT_EQ(compared, (2 + 3) * 16) << "columns in each of two processes, and of three";
	}

	/// One alone is asked as several are, and answers without a word to others.
	TEST(OneProcess, KnowsWhatAllKnow)
	{
		const Processes& one = *Processes::alone();
		EXPECT_EQ(one.size(), 1);
		EXPECT_EQ(one.rank(), 0);
		EXPECT_EQ(joined(one, std::vector<Key> { 3, 1 }), (std::vector<Key> { 3, 1 }));
		EXPECT_EQ(ofEach(one, 2.5), std::vector<double> { 2.5 });
		EXPECT_EQ(exchanged(one, { { 1, 2 } }), (std::vector<std::vector<double>> { { 1, 2 } }));
		EXPECT_EQ(firstSaid(one, "no"), "no");
		EXPECT_EQ(firstSaid(one, ""), "");
		EXPECT_TRUE(haveSame(one, []() -> std::uint64_t { throw std::logic_error("nobody is there to compare with"); }));
		EXPECT_EQ(one.sent(), 0);
	}

	TEST(OneProcess, HasAllPointsAndNodes)
	{
		const Division         all;
		const std::vector<Key> keys { 2, 5, 9 };
		std::vector<double>    values { 1, 2, 3 };
		all.complete(keys, values);
		all.extend(values);
		EXPECT_EQ(values, (std::vector<double> { 1, 2, 3 }));
		EXPECT_TRUE(all.isWhole());
		EXPECT_TRUE(all.owns(0) && all.owns(~Key(0)));
		EXPECT_EQ(all.united(keys), keys);
		EXPECT_EQ(all.startsAmong(keys), (std::vector<int> { 0, 3 }));
		EXPECT_EQ(all.ownOf(7), 7);
		EXPECT_EQ(all.idOf(4), 4);
		EXPECT_EQ(all.sum(0.1), 0.1);
		EXPECT_EQ(all.largest(-1), -1);
		Eigen::VectorXd nodal = Eigen::VectorXd::Ones(6);
		all.shareOf(keys).complete(nodal);
		EXPECT_EQ(nodal, Eigen::VectorXd::Ones(6));
	}

	/// Checksums as processes compare them.
	TEST(PointCloud, ChecksumIsThatOfEachColumn)
	{
		PointCloud<2> cloud;
		cloud.internals = cloud.parameters = { std::vector<double>(1) };
		forColumns(cloud, [](auto& column, ColumnPolicy) {
			column.resize(3);
			std::memset(static_cast<void*>(column.data()), 0, 3 * sizeof column[0]);
		});
		const std::uint64_t whole = checksumOf(cloud);
		int                 count = 0;
		forColumns(cloud, [&](auto& column, ColumnPolicy) {
			const auto before = column;
			std::memset(static_cast<void*>(&column[1]), 1, 4);
			EXPECT_NE(checksumOf(cloud), whole) << count;
			column = before;
			EXPECT_EQ(checksumOf(cloud), whole) << count;
			++count;
		});
		EXPECT_EQ(count, 15);
	}

} // namespace
} // namespace gimpm::testDivision
