// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/build_model.hpp"
#include "engine/solver/MpmDynamicEngine.hpp"
#include "engine/solver/exchange.hpp"
#include "engine/solver/requirements.hpp"
#include "engine/solver/shaking.hpp"
#include "engine/solver/walls.hpp"

namespace yade {

namespace {
	// Through edges that absorb waves no point reaches, in whatever is computed.
	template <int Dim> void openEdges(const MpmImplicitEngine& engine, gimpm::Model<Dim>& model)
	{
		const auto* dynamic = dynamic_cast<const MpmDynamicEngine*>(&engine);
		if (!dynamic || dynamic->absorbing.empty()) return;
		vector<gimpm::HeldBox<Dim>> open;
		for (size_t i = 0; i < dynamic->absorbing.size(); ++i)
			open.push_back(boxOfEdge(dynamic->absorbing[i], i, *engine.grid, model.grid));
		model.boundary = gimpm::Boundary<Dim>(model.boundary.boxes(), open);
	}
}

template <int Dim> gimpm::Model<Dim> emptyModel(const MpmImplicitEngine& engine)
{
	auto model = toModel<Dim>(*engine.grid, engine.basis, engine.fBar, engine.boundaries, *engine.ghost, *engine.newton);
	openEdges(engine, model);
	return model;
}

template <int Dim>
Setup<Dim> buildModel(
        MpmImplicitEngine& engine, const Scene& scene, const vector<MaterialPoint>& points, Real begin, Real target, const TakePoints<Dim>& takePoints)
{
	requireSettings(engine);
	Setup<Dim> setup;
	auto&      model = setup.model = emptyModel<Dim>(engine);
	takePoints(setup);
	const auto& division = *model.division;
	(setup.surfaceLoads = SurfaceLoads<Dim>(engine, model.grid)).join(model);
	(setup.waters = Waters<Dim>(engine, model.grid, setup.cloud, division)).join(model);
	(setup.contacts = Contacts<Dim>(engine.contacts, scene, model.grid, points, division, begin, target)).join(model);
	return setup;
}

template <int Dim> bool advance(Setup<Dim>& setup, const MpmImplicitEngine& engine, Real from, Real to)
{
	setup.surfaceLoads.advanceTo(to);
	setup.waters.advance(from, to);
	setup.contacts.advanceTo(to);
	const bool wallsMove = moveWalls(engine.boundaries, setup.model, to - from);
	return wallsMove || setup.contacts.areThere();
}

template <int Dim> Setup<Dim> currentState(MpmImplicitEngine& engine, const std::shared_ptr<gimpm::Division>& division)
{
	const auto scene  = engine.ownScene();
	const auto points = materialPoints(*scene, engine.mask);
	auto       setup  = buildModel<Dim>(engine, *scene, points, engine.loadTime, engine.loadTime, [&](Setup<Dim>& to) {
                to.model.division = division;
                to.cloud          = gather(points, to.model);
        });
	advance(setup, engine, engine.loadTime, engine.loadTime);
	return setup;
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template gimpm::Model<Dim> emptyModel(const MpmImplicitEngine&);                                                                                       \
	template Setup<Dim>        buildModel(MpmImplicitEngine&, const Scene&, const vector<MaterialPoint>&, Real, Real, const TakePoints<Dim>&);             \
	template bool              advance(Setup<Dim>&, const MpmImplicitEngine&, Real, Real);                                                                 \
	template Setup<Dim>        currentState(MpmImplicitEngine&, const std::shared_ptr<gimpm::Division>&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
