// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/parallel.hpp"
#include "yade_api/bodies.hpp"
#include <algorithm>
#include <atomic>
#include <typeinfo>

namespace yade {

namespace {
	[[noreturn]] void refuse(Body::id_t id, const string& why) { throw std::invalid_argument("Body #" + std::to_string(id) + ": " + why); }

	// A cast that costs little where the object is of this very class, as nearly always.
	template <class T, class Base> shared_ptr<T> castTo(const shared_ptr<Base>& object)
	{
		if (!object) return nullptr;
		const Base& known = *object;
		return typeid(known) == typeid(T) ? boost::static_pointer_cast<T>(object) : boost::dynamic_pointer_cast<T>(object);
	}

	template <class T> string classOf(const shared_ptr<T>& part) { return part ? part->getClassName() : "none"; }

	// The integrator moves the members of a clump with it, whatever their own state says.
	bool isInClump(const Body& body) { return body.clumpId >= 0; }

	// True if YADE's collider and integrator leave it alone.
	bool isLeftAlone(const Body& body, const MpmState& state) { return !body.isBounded() && state.blockedDOFs == State::DOF_ALL && !isInClump(body); }

	bool isStillOf(const MaterialPoint& point, const Body& body)
	{
		return point.id == body.id && point.shape.get() == body.shape.get() && point.state.get() == body.state.get()
		        && point.material.get() == body.material.get() && isLeftAlone(body, *point.state);
	}

	MaterialPoint complete(const Body& body, shared_ptr<MpmPoint>&& shape, const MaterialPoint* previous)
	{
		auto material = previous && previous->material.get() == body.material.get() ? previous->material
		                                                                            : boost::dynamic_pointer_cast<MpmMaterial>(body.material);
		if (!material)
			refuse(body.id,
			       "an MpmPoint shape needs a material for material points, such as MpmElasticMat; there is " + classOf(body.material) + ".");
		auto state = castTo<MpmState>(body.state);
		if (!state) refuse(body.id, "an MpmPoint shape needs an MpmState, as from material.newAssocState(); there is " + classOf(body.state) + ".");
		if (isInClump(body))
			refuse(body.id,
			       "a material point cannot be part of a clump (here of body #" + std::to_string(body.clumpId)
			               + "): YADE would move it as a rigid body. Release it with O.bodies.releaseFromClump().");
		if (!isLeftAlone(body, *state))
			refuse(body.id,
			       "YADE's collider and integrator must leave material points alone: set bounded = False and state.blockedDOFs = 'xyzXYZ'.");
		return { body.id, std::move(shape), std::move(state), std::move(material) };
	}

	void refuseOtherShape(const Body& body)
	{
		if (!dynamic_cast<MpmMaterial*>(body.material.get())) return;
		refuse(body.id,
		       "material '" + body.material->label + "' (" + body.material->getClassName() + ") is for material points, but the shape is "
		               + classOf(body.shape) + ". Functions such as sphere() take the last material of O.materials unless given one.");
	}

	// Whatever the two-dimensional computation would leave out has to be zero.
	void requireInPlane(const MpmState& state, bool isRing)
	{
		const Real around = isRing ? state.defGrad(2, 2) : 1;
		for (const auto& [name, tensor, normal] :
		     { std::tuple { "stress", &state.stress, state.stress(2, 2) },
		       std::tuple { "elasticStrain", &state.elasticStrain, state.elasticStrain(2, 2) }, std::tuple { "defGrad", &state.defGrad, around } })
			if (tensor->topRightCorner<2, 1>().any() || tensor->bottomLeftCorner<1, 2>().any() || (*tensor)(2, 2) != normal)
				throw std::invalid_argument(
				        string("MpmState.") + name
				        + " has shear or stretch out of the x-y plane, which a grid with dim=2 (plane strain) does not admit.");
		if (state.force[2] != 0)
			throw std::invalid_argument("MpmState.force has a z component, which a grid with dim=2 (plane strain) does not admit.");
	}
}

void MaterialPoint::requireAdmissible(int dim, bool isRing) const
{
	try {
		shape->requireAdmissible();
		state->requireAdmissible();
		if (dim == 2) requireInPlane(*state, isRing);
	} catch (const std::invalid_argument& error) {
		refuse(id, error.what());
	}
}

void MaterialPoint::requireStart(const Matrix3r& stress) const
{
	try {
		material->requireStart(stress);
	} catch (const std::invalid_argument& error) {
		refuse(id, error.what());
	}
}

Real MaterialPoint::internalOf(const gimpm::Law& law, size_t k) const
{
	const Real* value = state->internal(gimpm::internalVariables[law->columns[k]].name);
	return value ? *value : law->initialInternals[k];
}

vector<Real> MaterialPoint::internalsOf(const gimpm::Law& law) const
{
	vector<Real> values;
	for (size_t k = 0; k < law->columns.size(); ++k)
		values.push_back(internalOf(law, k));
	return values;
}

void MaterialPoint::requireInternals(const gimpm::Law& law) const
{
	const auto& columns = law->columns;
	for (size_t k = 0; k < columns.size(); ++k)
		if (const auto& variable = gimpm::internalVariables[columns[k]]; !variable.admits(internalOf(law, k)))
			refuse(id, refusalOf(variable, internalOf(law, k)));
	for (const auto& [name, value] : state->internals)
		if (std::none_of(columns.begin(), columns.end(), [&name = name](int column) { return name == gimpm::internalVariables[column].name; }))
			refuse(id, "MpmState.internals has '" + name + "', which is no internal variable of " + material->getClassName() + ".");
}

int MaterialPoint::materialIndex(const Scene& scene) const
{
	const int  id     = material->id;
	const bool isThis = id >= 0 && size_t(id) < scene.materials.size() && scene.materials[id].get() == material.get();
	return isThis ? id : -1;
}

namespace {
	// True if these are all points of the scene, and nothing else is to be refused: as in nearly all steps, which
	// several threads see sooner.
	bool areStill(const vector<MaterialPoint>& points, const BodyContainer& bodies, int mask)
	{
		const auto firstFrom = [&](size_t id) {
			return std::lower_bound(points.begin(), points.end(), id, [](const MaterialPoint& p, size_t least) { return size_t(p.id) < least; });
		};
		std::atomic_bool are { true };
		inRanges(bodies.size(), [&](size_t begin, size_t end) {
			auto       point = firstFrom(begin);
			const auto last  = end == bodies.size() ? points.end() : firstFrom(end);
			for (size_t id = begin; id < end && are; ++id) {
				const shared_ptr<Body>& body = bodies[id];
				if (!body || !maskMatches(*body, mask)) continue;
				if (point != last && isStillOf(*point, *body)) ++point;
				else if (dynamic_cast<MpmPoint*>(body->shape.get()) || dynamic_cast<MpmMaterial*>(body->material.get()))
					are = false;
			}
			if (point != last) are = false;
		});
		return are;
	}
}

void updateMaterialPoints(vector<MaterialPoint>& points, const Scene& scene, int mask)
{
	const BodiesLock     lock(scene);
	const BodyContainer& bodies = *scene.bodies;
	if (!points.empty()) {
		if (areStill(points, bodies, mask)) return;
		PointWriter();
	}
	size_t n = 0;
	for (size_t id = 0; id < bodies.size(); ++id) {
		const shared_ptr<Body>& body = bodies[id];
		if (!body || !maskMatches(*body, mask)) continue; // null: erased
		if (n < points.size() && isStillOf(points[n], *body)) ++n;
		else if (auto shape = castTo<MpmPoint>(body->shape)) {
			auto point = complete(*body, std::move(shape), n == 0 ? nullptr : &points[n - 1]);
			if (n < points.size()) points[n] = std::move(point);
			else
				points.push_back(std::move(point));
			++n;
		} else
			refuseOtherShape(*body);
	}
	points.erase(points.begin() + n, points.end());
}

vector<MaterialPoint> materialPoints(const Scene& scene, int mask)
{
	vector<MaterialPoint> points;
	points.reserve(scene.bodies->size());
	updateMaterialPoints(points, scene, mask);
	return points;
}

} // namespace yade
