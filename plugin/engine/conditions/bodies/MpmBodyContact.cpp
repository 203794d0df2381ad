// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/bodies/MpmBodyContact.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/surface.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/bodies/body_contacts.hpp"
#include "engine/conditions/bodies/contact_records.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include "engine/conditions/bodies/tearing.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/conditions/structures/parting.hpp"
#include "yade_api/registration.hpp"
#include <set>

namespace yade {

void MpmBodyContact::requireAdmissible() const
{
	Exposed<MpmBodyContact, MpmCondition>::requireAdmissible();
	size_t     ofPairs = 0;
	const bool arePairs
	        = std::all_of(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.size() == 3 && pair[2] >= 0 && (ofPairs += pair[2], true); });
	if (pressures.size() != shears.size() || slave < -1 || slave > 1 || !arePairs || (!pairs.empty() && ofPairs != pressures.size()))
		throw std::invalid_argument("MpmBodyContact: the stored data of its segments or triangles do not match; is the saved file damaged?");
}

std::shared_ptr<Condition<2>> MpmBodyContact::make(InPlane, const Group& group, const Analysis& analysis) const
{
	return std::make_shared<MeetingBodies<2>>(group, analysis);
}
std::shared_ptr<Condition<3>> MpmBodyContact::make(InSpace, const Group& group, const Analysis& analysis) const
{
	return std::make_shared<MeetingBodies<3>>(group, analysis);
}

// Feature that does not go with soil parted at folds; empty: there is none.
static string obstacleToFolds(const Analysis& analysis)
{
	if (analysis.isExplicit()) return "explicit steps";
	return obstacleToParting(analysis);
}

void MpmBodyContact::requireFitting(const Analysis& analysis, const string& name) const
{
	for (const string& body : between) {
		const int number = analysis.grid->bodyNamed(body);
		if (number < 0) {
			const string known = bodiesThereAre(*analysis.grid);
			throw std::invalid_argument(gimpm::sentence(
			        name, ".between: no body is called '", body, "'; ",
			        known.empty()
			                ? string("MpmGrid.bodies is empty: fill it with mpm.fill(..., body='" + body + "') and the MpmGrid of the engine.")
			                : "there are " + known + "."));
		}
		const auto& pieces = analysis.grid->bodies[number]->pieces;
		if (pieces.empty() || int(pieces[0].size()) != analysis.grid->dim)
			throw std::invalid_argument(gimpm::sentence(
			        name, ".between: body '", body, "' has no surface of ", analysis.grid->dim == 2 ? "segments" : "triangles",
			        " for the contact (MpmGrid.bodies[", number, "].pieces)."));
	}
	for (const Listed& other : analysis.conditions()) {
		const auto* contact = dynamic_cast<const MpmBodyContact*>(other.condition.get());
		if (!contact || contact == this) continue;
		if (std::set<string>(contact->between.begin(), contact->between.end()) == std::set<string>(between.begin(), between.end()))
			throw std::invalid_argument(
			        name + " and " + other.name() + " are both between '" + between[0] + "' and '" + between[1] + "': one is admitted.");
	}
	if (filled && (analysis.isDynamic() || !MpmFlow::of(analysis)))
		throw std::invalid_argument(
		        name
		        + ".filled = True: the water is that of an MpmFlow in flow of an MpmImplicitEngine, whose steps have no inertia. Leave it out, or see to these.");
	if (folds && !isOfOne())
		throw std::invalid_argument(name + ".folds = True is of a body in contact with itself: name one body twice in between, or leave folds out.");
	if (const string obstacle = folds ? obstacleToFolds(analysis) : ""; !obstacle.empty())
		throw std::invalid_argument(name + ".folds = True does not go with " + obstacle + " yet; leave one of the two out.");
	if (isOfOne() && analysis.distributed)
		throw std::invalid_argument(
		        name + ".between: contact of body '" + between[0] + "' with itself cannot go with distributed=True yet; leave one of the two out.");
}

string MpmBodyContact::divideBodies(const Analysis& analysis, const vector<MaterialPoint>& points) const
{
	return isOfOne() ? tear(between[0], analysis, points) : "";
}

void MpmBodyContact::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	const string name = "contact" + std::to_string(listed.number);
	rows.setVector(name, force, analysis.grid->dim);
	rows.set(name + "_touching", touching);
}

// On a piece of a surface [N]: a segment, of a ring where the scene is axisymmetric, or a triangle.
static Vector3r forceOn(const vector<Vector3r>& at, Real pressure, const Vector3r& shear, bool isRing)
{
	Vector3r normal = Vector3r::Zero(); // times the size
	if (at.size() == 2) normal.head<2>() = gimpm::pieceNormal(gimpm::Vec<2>(at[0].head<2>()), gimpm::Vec<2>(at[1].head<2>()));
	else
		normal = gimpm::pieceNormal(gimpm::Vec<3>(at[0]), gimpm::Vec<3>(at[1]), gimpm::Vec<3>(at[2]));
	return (isRing ? M_PI * (at[0][0] + at[1][0]) : 1) * (normal.norm() * shear - pressure * normal);
}

// Forces and stresses on the slave.
void MpmBodyContact::draw(Picture& picture, const Analysis& analysis, const Listed& listed) const
{
	for (const ContactRecord& record : recordsOf(*this, *analysis.grid)) {
		const MpmBody& body  = *analysis.grid->bodies[record.slave];
		const int      first = int(picture.corners.size());
		if (record.pressures.size() != body.pieces.size()) continue;
		picture.corners.insert(picture.corners.end(), body.vertices.begin(), body.vertices.end());
		for (size_t i = 0; i < body.pieces.size(); ++i) {
			vector<int>      piece = body.pieces[i];
			vector<Vector3r> at;
			for (int& corner : piece) {
				at.push_back(body.vertices[corner]);
				corner += first;
			}
			picture.add(piece);
			picture.set("force", forceOn(at, record.pressures[i], record.shears[i], analysis.grid->axisymmetric));
			picture.set("pressure", record.pressures[i]);
			picture.set("shear", record.shears[i].norm());
			picture.set("touches", int(record.pressures[i] > 0));
			picture.set("contact", int(listed.number));
		}
	}
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmBodyContact)
static const yade::PluginClasses<yade::MpmBodyContact> registeredMpmBodyContact(__FILE__);
