// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Contact with rigid bodies, between the bodies of a scene and the term of a step.
#include "core/stepping/model.hpp"
#include "core/terms/contact.hpp"
#include "engine/conditions/MpmContact.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/solver/contact_halves.hpp"
#include "engine/solver/movers.hpp"
#include "yade_api/scene.hpp"
#include <algorithm>
#include <map>
#include <optional>

namespace yade {

// The bodies that a contact means: neither material points nor clumps, but members of these.
vector<shared_ptr<Body>> bodiesOf(const MpmContact&, const Scene&);

// Between load steps, too, the bodies that YADE moves feel the soil.
void handOver(const vector<shared_ptr<MpmContact>>&, Scene&, bool isBetween);

template <int Dim> class Contacts {
public:
	Contacts() = default;
	// For the load steps from one time to another. std::invalid_argument names what cannot be computed with.
	Contacts(
	        const vector<shared_ptr<MpmContact>>&, const Scene&, const gimpm::Grid<Dim>&, const vector<MaterialPoint>&, const gimpm::Division&, Real begin,
	        Real target);

	bool areThere() const { return bool(system); }

	// Their forces enter the balance with this weight. Null: there are none.
	const gimpm::ContactSystem<Dim>* weigh(Real weight)
	{
		if (system) system->weight = weight;
		return system.get();
	}

	// The largest of their stiffnesses, over Young's modulus per cell [-].
	Real penalty() const
	{
		Real largest = 0;
		for (const auto& contact : given)
			largest = std::max(largest, contact->stiffness);
		return largest;
	}

	// On the soil in the last step that was accepted [J].
	Real work() const { return system ? system->work : 0; }

	// Makes them act in the model's steps, for as long as this exists.
	void join(gimpm::Model<Dim>&);

	// Before the state of a step is kept: std::invalid_argument names a free body that is too light for the stiffness that it would be handed.
	void requireStable() const;

	// What the soil cannot feel of bodies near it, and other doubts: sentences for YADE's log.
	std::map<string, string> doubts(bool isDynamic) const; // by what they are about

	// Of a step in time: all energy that has come in before it [J]. What contact itself has given in the last step that was accepted [J].
	void know(Real energy)
	{
		if (system) system->energy = energy;
	}
	Real gift() const { return system ? system->given : 0; }

	// The next step ends here.
	void advanceTo(Real time);

	// Whether the middle of a part of a point, as seen from that of the point, is on the same side of all bodies as they are at the end of the step.
	bool areBeside(const gimpm::Vec<Dim>& point, const gimpm::Vec<Dim>& part) const;

	// What is remembered of a point is shared by its halves.
	void share(const HalvedDomain&) const;

	// Writes a converged state back: what the contacts keep, and where the bodies are if nobody else moves them.
	void scatter(Real time);

private:
	// Of a point in the records of the system; -1: it has been erased.
	int numberOf(Body::id_t id) const
	{
		if (areDivided) return id;
		const auto point = std::lower_bound(points.begin(), points.end(), id);
		return point == points.end() || *point != id ? -1 : int(point - points.begin());
	}

	// Who moves bodies: one of them alone, or a clump.
	struct Owner {
		shared_ptr<MpmContact> contact;
		shared_ptr<Body>       body;
		Se3r                   given;                  // where it stood when the run began: the scripts may have moved it since the last one
		Se3r                   begin, target, reached; // of the run; reached: the end of the step
		bool                   byYade = false, isFree = false, isNew = true;
		bool                   byScript = false; // has been moved since the last run, or its way was not finished then
		size_t                 place    = 0;     // in the contact's list of bodies, once that is written
	};
	using Places = std::map<Body::id_t, int>; // of bodies in a list
	struct Member {
		shared_ptr<Body> body;
		Se3r             own, first; // as seen from the owner; in space when the run begins
	};

	void add(const shared_ptr<MpmContact>&, const Scene&, const gimpm::Grid<Dim>&);
	int  ownerOf(const shared_ptr<MpmContact>&, const Places& known, const Body&, const Scene&);
	void requireTogether(const MpmContact&, const Body&, const Owner&, const Se3r& own) const;
	Real partAt(Real time) const { return target > begin ? std::min(1., (time - begin) / (target - begin)) : 1; }
	void addMember(const MpmContact&, const shared_ptr<Body>&, int owner, const gimpm::Grid<Dim>&);
	void recall(const MpmContact&);
	void keep(MpmContact&);
	void keepRecords() const;

	vector<shared_ptr<MpmContact>>        given;
	shared_ptr<gimpm::ContactSystem<Dim>> system; // its terms refer to it
	vector<Owner>                         owners;
	Places                                ownersById;
	vector<Member>                        members; // as the system's bodies
	vector<Body::id_t>                    points;  // ids; none where they are divided, and the system knows them by their ids
	bool                                  areDivided = false, hasKept = false;
	Real                                  begin = 0, target = 0, end = 0; // of the run; end: of the last step
	Real                                  dt = 0;                         // of an iteration of YADE
	string                                coefficient;                    // doubt about an angle of friction
	std::optional<Movers>                 movers;
};

} // namespace yade
