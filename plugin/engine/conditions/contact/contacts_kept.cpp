// SPDX-License-Identifier: GPL-2.0-or-later
// Records of contacts that are kept from step to step.
#include "engine/conditions/contact/contact_records.hpp"
#include "engine/conditions/contact/contacts.hpp"
#include <map>

namespace yade {

// Reads the records of a contact, in numbers of this run.
template <int Dim> void Contacts<Dim>::recall(const MpmContact& contact)
{
	Places numbers;
	for (size_t i = 0; i < members.size(); ++i)
		numbers[members[i].body->id] = int(i);
	for (const auto& r : ContactRecords::from(contact.records))
		if (const auto body = numbers.find(r.body); body != numbers.end()) // else it is erased
			system->records.push_back(ContactRecords::inDimension<Dim>(r, body->second));
}

// The impulses are those since the last run.
template <int Dim> void Contacts<Dim>::keep(MpmContact& contact)
{
	std::map<Body::id_t, Vector3r> impulses;
	for (size_t i = 0; i < contact.bodies.size(); ++i)
		impulses[contact.bodies[i]] = hasKept ? contact.impulses[i] : contact.impulsesSince[i];
	contact.forget();
	contact.ownPoses.clear();
	for (size_t i = 0; i < owners.size(); ++i)
		if (owners[i].contact.get() == &contact) {
			const auto since = impulses.find(owners[i].body->id);
			owners[i].place  = contact.bodies.size();
			contact.keep(
			        owners[i].body->id, owners[i].isFree && inTime ? owners[i].mean : system->loads[i], owners[i].reached, owners[i].isFree,
			        since == impulses.end() ? Vector3r(Vector3r::Zero()) : since->second);
		}
}

template <int Dim> void Contacts<Dim>::keepRecords() const
{
	for (size_t i = 0; i < members.size(); ++i) {
		Matrix3r turn                  = Matrix3r::Identity();
		turn.topLeftCorner<Dim, Dim>() = system->bodies[i].shape.axes;
		owners[system->bodies[i].owner].contact->keepTurn(members[i].body->id, turn);
	}
	for (const auto& r : system->records) {
		const Owner& owner = owners[system->bodies[r.body].owner];
		MpmContact&  to    = *owner.contact;
		ContactRecords::append(ContactRecords::inDimension<3>(r, members[r.body].body->id), to.records);
		to.touching[placeOf(r)] += r.touches;
		to.slipping[placeOf(r)] += r.slips;
	}
}

// In the contact's list of bodies, of who owns the body; of its nodes the one that is closest.
template <int Dim> size_t Contacts<Dim>::placeOf(const gimpm::ContactRecord<Dim>& r) const
{
	int closest = system->bodies[r.body].owner;
	for (const int node : members[r.body].nodes)
		if ((system->owners[node] - r.position).squaredNorm() < (system->owners[closest] - r.position).squaredNorm()) closest = node;
	return owners[closest].place;
}

template void   Contacts<2>::recall(const MpmContact&);
template void   Contacts<3>::recall(const MpmContact&);
template void   Contacts<2>::keep(MpmContact&);
template void   Contacts<3>::keep(MpmContact&);
template void   Contacts<2>::keepRecords() const;
template void   Contacts<3>::keepRecords() const;
template size_t Contacts<2>::placeOf(const gimpm::ContactRecord<2>&) const;
template size_t Contacts<3>::placeOf(const gimpm::ContactRecord<3>&) const;

} // namespace yade
