// SPDX-License-Identifier: GPL-2.0-or-later
// Contact over the surfaces of bodies: uniform pressure, action and reaction, areas, what turns with the body, energy,
// and points that are divided among processes.
#include "core/parallel/halo.hpp"
#include "core/stepping/step_system.hpp"
#include "threads_as_processes.hpp"
#include "touched_soil.hpp"
#include <Eigen/Geometry>

namespace gimpm::testContactPlaces {
namespace {

	constexpr double young = TouchedSoil<2>::young, h = TouchedSoil<2>::h;

	template <int Dim> struct Scene : TouchedSoil<Dim> {
		using TouchedSoil<Dim>::model, TouchedSoil<Dim>::cloud, TouchedSoil<Dim>::contacts, TouchedSoil<Dim>::report;

		explicit Scene(double height = 1.5, bool isRing = false) : TouchedSoil<Dim>(1000, 1e-10, height, isRing) { }

		/// A sheet at this height, beyond the soil, that looks down, or up, or both ways.
		RigidBody<Dim>& addSheet(double height, bool isTwoSided, bool up = false)
		{
			auto& body = this->add(RigidKind::sheet, height * Vec<Dim>::Unit(1));
			if (up) std::swap(body.shape.corners[0], body.shape.corners[1]);
			body.shape.isTwoSided = isTwoSided;
			return body;
		}
		void step() { ASSERT_TRUE(TouchedSoil<Dim>::step().converged()) << report.cause; }
		/// A step in which the nodes go as they are told. Returns the forces on them, and where they are at its
		/// end.
		template <class F> std::pair<Eigen::VectorXd, std::vector<Vec<Dim>>> go(F&& displacement)
		{
			const StepSystem<Dim> system(cloud, model, Load<Dim>(), report);
			auto                  places     = nodePositions(system.basis, model.grid);
			const Eigen::VectorXd d          = nodal<Dim>(system.basis, model.grid, displacement);
			Eigen::VectorXd       resistance = Eigen::VectorXd::Zero(d.size());
			EXPECT_FALSE(system.terms.back()->add(d, { resistance }));
			system.terms.back()->commit(d);
			for (std::size_t n = 0; n < places.size(); ++n)
				places[n] += d.template segment<Dim>(Dim * Eigen::Index(n));
			return { -resistance, places };
		}
		/// Area by which soil is pressed, from what presses it.
		double area() const
		{
			double sum = 0;
			for (const auto& r : contacts.records)
				if (r.normalForce > 0) sum += r.normalForce / -r.gap * h / (contacts.bodies[r.body].stiffness * young);
			return sum;
		}
		Vec3 force() const
		{
			Vec3 sum = Vec3::Zero();
			for (const auto& load : contacts.loads)
				sum += load.force;
			return sum;
		}
	};

	template <class T> using ContactPlacesOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(ContactPlacesOf, BothDimensions, DimensionName);

	/// Soil ends on a line of the grid, or anywhere in a cell: the pressure is the same everywhere, to round-off.
	TYPED_TEST(ContactPlacesOf, UniformPressureWithAFaceInMidCell)
	{
		constexpr int Dim = TypeParam::value;
		for (const double height : { 1.5, 1.25 })
			for (const RigidKind kind : { RigidKind::plane, RigidKind::block }) {
				Scene<Dim> scene(height);
				scene.rollers();
				Vec<Dim> place = Vec<Dim>::Zero();
				place[1]       = height + (kind == RigidKind::block ? 3 : 0);
				auto& plate    = scene.add(kind, place);
				plate.shape.halfSize.setConstant(3);
				for (int i = 0; i < 3; ++i) {
					scene.contacts.bodies[0].end.position[1] -= 0.05;
					scene.step();
				}
				const double strain = std::log(1 - 0.15 / height),
				             stress = young * strain / (1 - 0.15 / height); // stress of a rigid plate
				double least = 0, most = stress, off = 0;
				for (const auto& of : scene.cloud.stress) {
					const Mat<Dim> s = of.inPlane();
					least = std::min(least, s(1, 1)), most = std::max(most, s(1, 1));
					off = std::max(off, (s - s(1, 1) * Vec<Dim>::Unit(1) * Vec<Dim>::Unit(1).transpose()).norm());
				}
				EXPECT_NEAR(most / stress, 1, 0.02);
				EXPECT_LT(most - least + off, 1e-7 * -stress);
				EXPECT_LE(scene.area(), std::pow(1.5, Dim - 1) + 1e-9);
				EXPECT_GE(scene.area(), std::pow(1.5, Dim - 1) - 1e-9);
			}
	}

	/// Whatever touches: the nodes get what the owner gives, and about any place the same torque.
	TYPED_TEST(ContactPlacesOf, WhatTheSoilGetsTheOwnerLoses)
	{
		constexpr int Dim = TypeParam::value;
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::plane, RigidKind::sheet }) {
			Scene<Dim> scene;
			Vec<Dim>   place = Vec<Dim>::Constant(0.7);
			place[1]         = kind == RigidKind::plane || kind == RigidKind::sheet ? 1.5 : 2.5;
			auto& body       = scene.add(kind, place, 0.3);
			for (int i = 0; i < Dim; ++i) // an oblique sheet
				body.shape.corners[i] = Vec<Dim>::Unit(i) - Vec<Dim>::Constant(1. / Dim);
			if (kind != RigidKind::plane) body.end.rotation = turn<Dim>(0.02);
			body.end.position += 0.01 * Vec<Dim>::LinSpaced(1, 2) - 0.06 * Vec<Dim>::Unit(1);
			body.shape.isTwoSided    = kind == RigidKind::sheet;
			scene.contacts.owners[0] = Vec<Dim>::LinSpaced(0.3, 3);
			Random random(2);
			for (int step = 0; step < 2; ++step) { // the second one with friction from the first
				const auto [force, places] = scene.go([&](const Vec<Dim>&) { return random.template matrix<Dim>(0.01).eval(); });
				Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
				for (std::size_t n = 0; n < places.size(); ++n) {
					Vec3 f = Vec3::Zero(), arm = Vec3::Zero();
					f.template head<Dim>()   = force.template segment<Dim>(Dim * Eigen::Index(n));
					arm.template head<Dim>() = places[n] - scene.contacts.owners[0];
					sum += f, torque += arm.cross(f);
				}
				const auto& load = scene.contacts.loads[0];
				EXPECT_GT(load.force[1], 1e3);
				EXPECT_LT((load.force + sum).norm(), 1e-12 * sum.norm());
				EXPECT_LT((load.torque + torque).norm(), 1e-12 * (torque.norm() + sum.norm()));
			}
		}
	}

	/// Around the axis places stand for rings.
	TEST(ContactPlaces, RingsAddUpToTheCircle)
	{
		for (const RigidKind kind : { RigidKind::plane, RigidKind::block, RigidKind::sheet }) {
			Scene<2> scene(1.5, true);
			scene.rollers();
			auto& plate = kind == RigidKind::sheet ? scene.addSheet(1.5, true) : scene.add(kind, { 0, kind == RigidKind::block ? 3.5 : 1.5 });
			plate.shape.halfSize.setConstant(2);
			plate.end.position[1] -= 0.05;
			scene.step();
			EXPECT_NEAR(scene.area(), M_PI * 1.5 * 1.5, 1e-9);
			const double stress = -scene.cloud.stress[0].inPlane()(1, 1);
			EXPECT_NEAR(scene.force()[1] / (stress * M_PI * 1.5 * 1.5), 1, 0.02);
			for (const auto& of : scene.cloud.stress)
				EXPECT_NEAR(-of.inPlane()(1, 1) / stress, 1, 0.05) << "at the axis as elsewhere";
		}
	}

	/// Planes, blocks and sheets at the same place, one in another, and side by side with a common part.
	TYPED_TEST(ContactPlacesOf, BodiesOverEachOtherCountOnce)
	{
		constexpr int  Dim     = TypeParam::value;
		const Vec<Dim> up      = Vec<Dim>::Unit(1);
		const auto     pressed = [&](auto&& addBodies) {
                        Scene<Dim> scene;
                        scene.rollers();
                        addBodies(scene);
                        for (auto& body : scene.contacts.bodies)
                                body.end.position[1] -= 0.05;
                        scene.step();
                        EXPECT_LE(scene.area(), std::pow(1.5, Dim - 1) + 1e-9);
                        EXPECT_GE(scene.area(), std::pow(1.5, Dim - 1) - 1e-9);
                        return scene.force()[1];
		};
		const auto block
		        = [&](Scene<Dim>& scene, const Vec<Dim>& size, const Vec<Dim>& place) { scene.add(RigidKind::block, place).shape.halfSize = size; };
		const auto cube = [&](Scene<Dim>& scene, double size, double x = 0) {
			block(scene, Vec<Dim>::Constant(size), (1.5 + size) * up + x * Vec<Dim>::Unit(0));
		};
		const double                                      one = pressed([&](auto& scene) { scene.add(RigidKind::plane, 1.5 * up); });
		const std::vector<std::pair<const char*, double>> found {
			{ "planes", pressed([&](auto& scene) { scene.add(RigidKind::plane, 1.5 * up), scene.add(RigidKind::plane, 1.5 * up); }) },
			{ "plane and block", pressed([&](auto& scene) { scene.add(RigidKind::plane, 1.5 * up), cube(scene, 3); }) },
			{ "one in another", pressed([&](auto& scene) { cube(scene, 2), cube(scene, 3); }) },
			{ "the other way round", pressed([&](auto& scene) { cube(scene, 3), cube(scene, 2); }) },
			{ "side by side", pressed([&](auto& scene) { cube(scene, 2, -1.5), cube(scene, 2, 2); }) },
			{ "with a joint", pressed([&](auto& scene) { cube(scene, 2, 0.75 - 2), cube(scene, 2, 0.75 + 2); }) },
			{ "a lower one before", pressed([&](auto& scene) { cube(scene, 3), block(scene, Vec<Dim>::Constant(3), (1.7 + 3) * up); }) },
			{ "sheets", pressed([&](auto& scene) { scene.addSheet(1.5, true), scene.addSheet(1.5, true, true); }) },
		};
		for (const auto& [of, force] : found)
			EXPECT_NEAR(force / one, 1, Dim == 2 ? 1e-6 : 2e-5) << of; // in space places of triangles are others
	}

	/// It does not matter which way its normal looks, and soil on both of its sides meets it.
	TYPED_TEST(ContactPlacesOf, SheetsActOnBothSides)
	{
		constexpr int Dim = TypeParam::value;
		double        force[2];
		for (const bool up : { false, true }) {
			Scene<Dim> scene;
			scene.rollers();
			scene.addSheet(1.5, true, up).end.position[1] -= 0.05;
			scene.step();
			force[up] = scene.force()[1];
		}
		EXPECT_GT(force[0], 1e4);
		EXPECT_NEAR(force[1] / force[0], 1, 1e-9);
		Scene<Dim> scene; // lifted: soil above it bears the force
		scene.rollers();
		scene.addSheet(0, true).end.position[1] += 0.05;
		scene.go([](const Vec<Dim>&) { return Vec<Dim>(Vec<Dim>::Zero()); });
		EXPECT_NEAR(scene.force()[1] / (-100 * young * 0.05 / h * std::pow(1.5, Dim - 1)), 1, Dim == 2 ? 1e-9 : 0.01);
	}

	/// Body and soil turn together, by any angle: no gap changes, and forces turn with them.
	TYPED_TEST(ContactPlacesOf, WhatIsRememberedTurnsWithTheBody)
	{
		constexpr int  Dim = TypeParam::value;
		const Mat<Dim> R   = turn<Dim>(0.3);
		for (const RigidKind kind : { RigidKind::ball, RigidKind::block, RigidKind::sheet }) {
			Scene<Dim>     scene;
			const Vec<Dim> place     = Vec<Dim>::Constant(0.7) + 1.8 * Vec<Dim>::Unit(1);
			auto&          body      = kind == RigidKind::sheet ? scene.addSheet(1.5, true) : scene.add(kind, place);
			body.frictionCoefficient = 0.5;
			scene.contacts.kind      = StepKind::dynamic; // gaps stay as they are
			scene.go([&](const Vec<Dim>& x) { return Vec<Dim>(0.002 * Vec<Dim>::LinSpaced(1, 2) + 0.04 * Vec<Dim>::Unit(1) - 0.01 * x); });
			const auto remembered = scene.contacts.records;
			scene.go([](const Vec<Dim>&) { return Vec<Dim>(Vec<Dim>::Zero()); });
			const auto before      = scene.contacts.records;
			const Vec3 force       = scene.force();
			scene.contacts.records = remembered;
			const Vec<Dim> middle  = 0.3 * Vec<Dim>::Ones();
			body.end               = { middle + R * (body.begin.position - middle), R * body.begin.rotation };
			scene.go([&](const Vec<Dim>& x) { return Vec<Dim>(middle + R * (x - middle) - x); });
			int slip = 0, stick = 0;
			for (const auto& s : before) {
				const auto r = std::find_if(
				        scene.contacts.records.begin(), scene.contacts.records.end(), [&](const auto& of) { return of.number == s.number; });
				ASSERT_NE(r, scene.contacts.records.end());
				EXPECT_NEAR(r->gap, s.gap, 1e-13);
				EXPECT_EQ(r->touches, s.touches);
				EXPECT_NEAR(r->normalForce, s.normalForce, 1e-10 * force.norm());
				EXPECT_LT((r->tangentialForce - R * s.tangentialForce).norm(), 1e-10 * force.norm());
				(s.slips ? slip : stick) += s.touches && s.tangentialForce.norm() > 0;
			}
			EXPECT_GT(slip + stick, 0);
			EXPECT_GT(force.norm(), 1e3);
			EXPECT_LT((scene.force().template head<Dim>() - R * force.template head<Dim>()).norm(), 1e-10 * force.norm());
		}
	}

	/// Soil that goes about an edge at random, in steps of up to 0.6 of a cell, and through the body: contact never
	/// gives back more than it has taken, as there is nothing that a fixed body without friction could have done.
	TYPED_TEST(ContactPlacesOf, NoEnergyIsGivenAtEdges)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(7);
		for (int run = 0; run < (Dim == 2 ? 20 : 4); ++run) {
			Scene<Dim> scene(0.5);
			scene.contacts.kind = StepKind::dynamic;
			auto& body          = scene.add(RigidKind::block, Vec<Dim>::Constant(1.5) + Vec<Dim>::Unit(1) * 0.1);
			body.begin.rotation = body.end.rotation = turn<Dim>(random.in(-0.5, 0.5));
			double taken = 0, most = 0;
			for (int step = 0; step < 20; ++step) {
				const Vec<Dim> way = random.template matrix<Dim>(0.3 * h / (run % 3 + 1)) + 0.02 * Vec<Dim>::Unit(1);
				scene.go([&](const Vec<Dim>&) { return way; });
				for (Vec<Dim>& x : scene.cloud.position)
					x += way;
				taken -= scene.contacts.work;
				most = std::max(most, taken);
				EXPECT_LE(scene.contacts.energyGain, 1e-10 * (1 + most));
				EXPECT_GE(taken, -1e-10 * (1 + most));
			}
			EXPECT_GT(most, 10);
		}
	}

	/// A part of the points in each process, and copies of others: forces, loads and what is remembered are those
	/// of all.
	TYPED_TEST(ContactPlacesOf, DividedPointsGiveTheSame)
	{
		constexpr int Dim  = TypeParam::value;
		const auto    make = [](Scene<Dim>& scene) {
                        Vec<Dim> place = Vec<Dim>::Constant(0.7);
                        place[1]       = 2.5;
                        scene.add(RigidKind::ball, place, 0.3).end.position[1] -= 0.05;
                        scene.add(RigidKind::plane, Vec<Dim>::Zero(), 0.3).shape.normal = Vec<Dim>::Unit(1);
                        scene.contacts.bodies[1].end.position += 0.02 * Vec<Dim>::Unit(1);
		};
		const auto field = [](const Vec<Dim>& x) { return Vec<Dim>(0.01 * Vec<Dim>::Ones() - 0.004 * x); };
		Scene<Dim> whole;
		make(whole);
		const auto [force, places] = whole.go(field);
		EXPECT_GT(force.norm(), 1e3);
		inThreads(3, [&, &force = force](const std::shared_ptr<const Processes>& process) {
			Scene<Dim> mine;
			make(mine);
			std::map<Key, double> counts;
			for (std::size_t p = 0; p < mine.cloud.size(); ++p)
				++counts[lowestCell(mine.cloud.position[p], mine.cloud.halfSize[p], mine.model.grid, mine.model.basis)];
			std::vector<CellLoad> loads;
			for (const auto& [cell, count] : counts)
				loads.push_back({ cell, count });
			mine.model.processes = process;
			mine.model.division  = std::make_shared<Division>(Division { process, cutByWork(loads, 3) });
			Division&  division  = *mine.model.division;
			const auto all       = mine.cloud;
			for (int p = 0; p < int(all.size()); ++p)
				if (division.owns(lowestCell(all.position[p], all.halfSize[p], mine.model.grid, mine.model.basis))) division.id.push_back(p);
			forColumns(mine.cloud, [&](auto& column, ColumnPolicy) {
				const auto ofAll = column;
				column.clear();
				for (const std::int64_t p : division.id)
					if (!ofAll.empty()) column.push_back(ofAll[p]);
			});
			EXPECT_LT(mine.cloud.size(), all.size());
			const Halo halo(mine.cloud, division, [&] { return pointsForOthers(mine.cloud, mine.model); });
			const auto [found, where] = mine.go(field);
			EXPECT_LT((found - force).norm(), 1e-12 * force.norm());
			ASSERT_EQ(mine.contacts.records.size(), whole.contacts.records.size());
			for (std::size_t i = 0; i < mine.contacts.records.size(); ++i) {
				const auto &r = mine.contacts.records[i], &s = whole.contacts.records[i];
				EXPECT_TRUE(r.body == s.body && r.number == s.number && r.touches == s.touches);
				EXPECT_NEAR(r.gap, s.gap, 1e-14);
			}
			for (std::size_t b = 0; b < 2; ++b)
				EXPECT_LT((mine.contacts.loads[b].force - whole.contacts.loads[b].force).norm(), 1e-12 * force.norm());
		});
	}

} // namespace
} // namespace gimpm::testContactPlaces
