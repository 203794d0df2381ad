// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies of points in contact, between the conditions of a scene and the term of a step.
#include "core/terms/bodies/body_contact.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/bodies/contact_records.hpp"
#include <set>

namespace yade {

template <int Dim> class MeetingBodies : public Condition<Dim> {
public:
	MeetingBodies(const MpmCondition::Group&, const Analysis&);

	// Layers of the bodies.
	void hold(gimpm::Model<Dim>&) override;
	void join(gimpm::Model<Dim>&, const Surroundings<Dim>&) override;
	// Their forces enter the balance with a weight.
	void joinMotion(gimpm::Motion<Dim>&, const gimpm::Model<Dim>&, Real begin) override;
	// Parts the soil at folds of bodies that are in contact with themselves.
	void part(gimpm::PointCloud<Dim>&, gimpm::Model<Dim>&) override;
	void advance(const StepTime&, gimpm::Model<Dim>&, gimpm::Load<Dim>&) override;
	Work work(const StepOutcome<Dim>&) const override;
	void reach(const StepOutcome<Dim>&) override;

private:
	gimpm::MeetingBody<Dim>       coreBody(int number) const;
	void                          keep(int contact);
	void                          addMeetings(int contact, Real leakage);
	gimpm::BodyMeeting<Dim>       coreMeeting(const MpmBodyContact&, ContactRecord) const;
	Real                          leakageOf(const MpmBodyContact&, const Surroundings<Dim>&, const gimpm::Division&) const;
	int                           slaveOf(const MpmBodyContact&, const Surroundings<Dim>&, const gimpm::Model<Dim>&) const;
	std::set<std::pair<int, int>> apart(const vector<MaterialPoint>&, const gimpm::Division&) const;
	void                          requireNoneBetween(const vector<MaterialPoint>&, const gimpm::Model<Dim>&) const;
	string                        nameOf(int body) const { return body < 0 ? "one without a name" : "'" + grid.nameOfWhole(body) + "'"; }

	const Analysis&                           analysis;
	const MpmGrid&                            grid;
	vector<shared_ptr<MpmBodyContact>>        given;
	vector<int>                               contactOf; // number of the contact by that of the pair
	vector<int>                               layers;    // layer by the number of the body, from -1 on
	std::shared_ptr<gimpm::BodyContacts<Dim>> system;    // its terms refer to it
};

} // namespace yade
