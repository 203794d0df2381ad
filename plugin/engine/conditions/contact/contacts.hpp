// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Contact with rigid bodies, between the bodies of a scene and the term of a step.
#include "core/stepping/model.hpp"
#include "core/terms/contact/contact_system.hpp"
#include "engine/analysis/movers.hpp"
#include "engine/conditions/contact/MpmContact.hpp"
#include "engine/conditions/contact/deforming_bodies.hpp"
#include "engine/conditions/contact/free_bodies.hpp"
#include "engine/conditions/contact/implicit_bodies.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "yade_api/scene.hpp"
#include <algorithm>
#include <map>
#include <optional>

namespace yade {

template <int Dim> class Contacts : public Condition<Dim> {
public:
	explicit Contacts(const MpmCondition::Group&);
	Contacts(const Contacts&) = delete;
	~Contacts() override;

	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override;

	// Their forces enter the balance with a weight.
	void joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin) override;
	void part(gimpm::PointCloud<Dim>&, gimpm::Model<Dim>&) override;
	void advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override;

	// A free body must not be too light for the stiffness that it would be handed.
	void requireKept() const override;

	Work work(const StepOutcome<Dim>&) const override;

	// Writes back the records of the contacts, and the poses of the bodies if nobody else moves them.
	void reach(const StepOutcome<Dim>&) override;

	// The largest of their stiffnesses.
	Penalty penalty() const override;

	// Doubts about bodies near the soil that the soil cannot feel, and others.
	std::map<string, string> warnings() const override;

	bool areBeside(const gimpm::Vec<Dim>& point, const gimpm::Vec<Dim>& part) const override;

private:
	// Owner of the motion of bodies: one of them alone, or a clump.
	struct Owner {
		shared_ptr<MpmContact> contact;
		shared_ptr<Body>       body;
		// Pose when the run began: the scripts may have moved it since the last one.
		Se3r               given;
		Se3r               begin, target, reached; // poses of the run; reached: the end of the step
		gimpm::ContactLoad mean;                   // mean load of the run so far, in time steps
		bool               byYade = false, isFree = false, isNew = true;
		// Has been moved since the last run, or its way was not finished then.
		bool   byScript = false;
		size_t place    = 0; // in the contact's list of bodies, once that is written
		// Number among the free bodies of the system, if it is moved with the soil, and its motion as the step
		// begins.
		int        free = -1;
		FreeMotion motion {};
	};
	using Places = std::map<Body::id_t, int>; // number of bodies in a list
	struct Member {
		shared_ptr<Body> body;
		Se3r             own, first; // poses as seen from the owner; in space, that from which its turn counts
		vector<int>      nodes {};   // owners that it deforms with, if it does
	};

	void             advanceTo(Real time);
	void             addToMeans(Real part);
	bool             isBetween() const { return target - begin > 1.5 * dt; } // true if YADE makes iterations between load steps
	void             add(const shared_ptr<MpmContact>&, const Scene&, const gimpm::Grid<Dim>&);
	int              ownerOf(const shared_ptr<MpmContact>&, const Places& known, const shared_ptr<Body>&, const Scene&, const gimpm::Grid<Dim>&);
	void             requireTogether(const MpmContact&, const Body&, const Owner&, const Se3r& own) const;
	Real             partAt(Real time) const { return target > begin ? std::min(1., (time - begin) / (target - begin)) : 1; }
	void             addMember(const MpmContact&, const shared_ptr<Body>&, int owner, const gimpm::Grid<Dim>&);
	void             addDeforming(const shared_ptr<MpmContact>&, const Places& known, const shared_ptr<Body>&, const Scene&, const gimpm::Grid<Dim>&);
	void             add(const MpmContact&, gimpm::RigidBody<Dim>, const Member&, int owner);
	void             free(Owner&, const Scene&, const gimpm::Grid<Dim>&);
	void             advanceFree(const StepTime&, bool isRing);
	void             requireAlone(const gimpm::Model<Dim>&) const;
	vector<NodePose> nodePoses(const Member&) const;
	size_t           placeOf(const gimpm::ContactRecord<Dim>&) const;
	void             recall(const MpmContact&);
	void             keep(MpmContact&);
	void             keepRecords() const;

	// In the first run, about bodies that are far from the soil and do not come.
	string warningOfDistance(const gimpm::PointCloud<Dim>&) const;

	void requirePermeable(int body) const;

	template <class Surface> void partBy(vector<Surface> surfaces, gimpm::PointCloud<Dim>&, gimpm::Grid<Dim>&);

	vector<shared_ptr<MpmContact>>        given;
	const Scene*                          scene = nullptr; // of its bodies, once it has any
	shared_ptr<gimpm::ContactSystem<Dim>> system;          // its terms refer to it
	vector<Owner>                         owners;
	Places                                ownersById;
	vector<Member>                        members; // members in the order of the system's bodies
	bool                                  hasKept = false;
	Real                                  begin = 0, target = 0, end = 0;  // times of the run; end: of the last step
	Real                                  dt       = 0;                    // time step of YADE
	Real                                  cellSize = 0;                    // size of the smallest cells
	bool                                  inTime = false, hasFlow = false; // hasFlow: with MpmFlow
	SoilAtBody                            soil;
	string                                coefficient; // doubt about an angle of friction
	string                                distance;    // and about where the bodies are
	string                                inItsWay;    // feature that does not go with soil parted by thin bodies
	std::optional<Movers>                 movers;
	std::optional<gimpm::LoadCurve>       ofGravity;
	Vector3r                              gravity    = Vector3r::Zero(); // at factor 1
	bool                                  isExplicit = false;
};

} // namespace yade
