// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies and what they consist of. Members inside of #ifdef belong to a feature that YADE is built with or not, or came
// with a later version: CMakeLists.txt finds out.
#include "yade_api/serializable.hpp"
#include <bitset>
#include <map>
#include <mutex>

#pragma GCC visibility push(default)
namespace yade {
class Bound;
class BoundFunctor;
class Interaction;
class InternalForceFunctor;

class State : public Serializable, public Indexable {
public:
	// Bits of blockedDOFs.
	enum { DOF_X = 1, DOF_Y = 2, DOF_Z = 4, DOF_RX = 8, DOF_RY = 16, DOF_RZ = 32, DOF_ALL = 63 };
	Vector3r&    pos; // se3.position
	Quaternionr& ori; // se3.orientation
	std::mutex   updateMutex;
	Se3r         se3;
	Vector3r     vel;
	Real         mass;
	Vector3r     angVel, angMom, inertia, refPos;
	Quaternionr  refOri;
	unsigned     blockedDOFs;
	bool         isDamped;
	Real         densityScaling;
#ifdef YADE_API_SPH
	Real rho, rho0, press;
#endif
#ifdef YADE_API_LIQMIGRATION
	Real Vf, Vmin;
#endif
#ifdef YADE_API_DEFORM
	Real dR;
#endif
	State();
	~State() override;
	YADE_API_OVERRIDES(State)
	YADE_API_INDEX_ROOT
};

class Shape : public Serializable, public Indexable {
public:
	Shape() : color(1, 1, 1), wire(false), highlight(false) { }
	~Shape() override;
	shared_ptr<BoundFunctor> boundFunctor;
#ifdef YADE_API_FEMLIKE
	shared_ptr<InternalForceFunctor> internalforcefunctor;
#endif
	Vector3r color;
	bool     wire, highlight;
	YADE_API_OVERRIDES(Shape)
#ifdef YADE_API_SHAPE_HAS_VOLUME
	virtual Real getVolume();
#endif
	YADE_API_INDEX_ROOT
};

class Sphere : public Shape {
public:
	Sphere();
	~Sphere() override;
	Real radius;
	YADE_API_OVERRIDES(Sphere)
#ifdef YADE_API_SHAPE_HAS_VOLUME
	Real getVolume() override;
#endif
	YADE_API_INDEX_DERIVED
};

class Box : public Shape {
	Box();

public:
	Vector3r extents;
	~Box() override;
	YADE_API_OVERRIDES(Box)
	YADE_API_INDEX_DERIVED
};

class Wall : public Shape {
	Wall();

public:
	int sense, axis;
	~Wall() override;
	YADE_API_OVERRIDES(Wall)
	YADE_API_INDEX_DERIVED
};

class Facet : public Shape {
	Vector3r edgeNormals[3];
	Real     inscribedRadius, lengths[3];
	Vector3r directions[3];
	Facet();

public:
	vector<Vector3r> vertices;
	Vector3r         normal;
	Real             area;
	~Facet() override;
	YADE_API_OVERRIDES(Facet)
	YADE_API_INDEX_DERIVED
};

class Material : public Serializable, public Indexable {
public:
	Material() : id(-1), density(1000) { }
	~Material() override;
	virtual shared_ptr<State> newAssocState() const;
	virtual bool              stateTypeOk(State*) const;
	int                       id;
	string                    label;
	Real                      density;
	YADE_API_OVERRIDES(Material)
	YADE_API_INDEX_ROOT
};

class ElastMat : public Material {
public:
	ElastMat();
	~ElastMat() override;
	Real young, poisson;
	YADE_API_OVERRIDES(ElastMat)
	YADE_API_INDEX_DERIVED
};

class FrictMat : public ElastMat {
public:
	FrictMat();
	~FrictMat() override;
	Real frictionAngle;
	YADE_API_OVERRIDES(FrictMat)
	YADE_API_INDEX_DERIVED
};

class Body : public Serializable {
public:
	using id_t = int;
#ifdef YADE_API_MASK_BITS
	using mask_t = std::bitset<YADE_API_MASK_BITS>;
#else
	using mask_t = int;
#endif
	enum { FLAG_BOUNDED = 1, FLAG_ASPHERICAL = 2 }; // bits of flags
	id_t   id;
	mask_t groupMask;
	int    flags;
#ifdef YADE_API_MPI
	int subdomain;
#endif
	shared_ptr<Material>                    material;
	shared_ptr<State>                       state;
	shared_ptr<Shape>                       shape;
	shared_ptr<Bound>                       bound;
	std::map<id_t, shared_ptr<Interaction>> intrs;
	id_t                                    clumpId;
	long                                    iterBorn;
	Real                                    timeBorn;
	Body();
	~Body() override;
	virtual void userForcedDisplacementRedrawHook();
	bool         isBounded() const { return flags & FLAG_BOUNDED; }
	bool         isClump() const { return clumpId == id; }
	bool         isClumpMember() const { return clumpId >= 0 && clumpId != id; }
	YADE_API_OVERRIDES(Body)
};

// Only the last of its members is used: bodies are counted, read and added by its exported functions.
class BodyContainer : public Serializable {
	BodyContainer();
	vector<shared_ptr<Body>> body;
	bool                     dirty, checkedByCollider;
	vector<Body::id_t>       insertedBodies, erasedBodies, realBodies;

public:
	bool useRedirection, enableRedirection;
#ifdef YADE_API_MPI
	vector<Body::id_t> subdomainBodies;
#endif
	std::mutex drawloopmutex; // held by erase()
	~BodyContainer() override;
	size_t                  size() const;
	shared_ptr<Body>&       operator[](unsigned);
	const shared_ptr<Body>& operator[](unsigned) const; // null after O.bodies.erase()
	Body::id_t              insert(shared_ptr<Body>);
	Body::id_t              insertAtId(shared_ptr<Body>, Body::id_t);
	bool                    erase(Body::id_t, bool eraseClumpMembers);
	bool                    exists(Body::id_t) const;
	YADE_API_OVERRIDES(BodyContainer)
};

static_assert(sizeof(State) >= 320 && sizeof(Material) == 80, "layout of YADE");
} // namespace yade
#pragma GCC visibility pop
