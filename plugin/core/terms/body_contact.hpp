// SPDX-License-Identifier: GPL-2.0-or-later
// Contact of bodies of points with each other.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/grid/surface_lines.hpp"
#include "core/terms/body_pair.hpp"
#include "core/terms/coupled_term.hpp"

namespace gimpm {

/// A body of points that others may meet.
template <int Dim> struct MeetingBody {
	std::string  name;
	int          layer = 0; ///< of its nodes
	Surface<Dim> surface;   ///< moved with it in each step that is accepted

	/// At first it is cut at the lines of the grid; sides of its pieces are never longer than a quarter of a cell, in
	/// space than half of one. Returns for each piece which it has been part of.
	std::vector<int> refine(const Grid<Dim>& grid, bool isFirst)
	{
		if (isFirst) cutAtLines(surface, grid);
		return surface.refine((Dim == 2 ? pieceLimit : 2 * pieceLimit) * grid.cellSize);
	}
};

/// Two bodies that may meet, by their numbers: places on the one bear on pieces of the surface of the other.
template <int Dim> struct BodyMeeting {
	int    slave = 0, master = 0;
	double friction  = 0;                                       ///< coefficient [-]
	double adhesion  = std::numeric_limits<double>::infinity(); ///< cap of the shear stress [Pa]
	double stiffness = 50;

	/// Of the last step that was accepted, by the places of the slave's surface, Dim on each of its pieces: forces
	/// on them [N]; empty: none.
	std::vector<Vec<Dim>> shear {};
	std::vector<double>   pressure {};
	/// Of all of it: force on the slave [N], its moment about the origin [N m], and how many of the places touch.
	Vec<Dim> force    = Vec<Dim>::Zero();
	Vec3     moment   = Vec3::Zero();
	int      touching = 0, slipping = 0;
};

template <int Dim> class BodyContact;

template <int Dim> struct BodyContacts {
	std::vector<MeetingBody<Dim>> bodies;
	std::vector<BodyMeeting<Dim>> meetings;
	double                        work   = 0;  ///< on the bodies in the last step that was accepted, with the forces at its end [J]
	double                        weight = 1;  ///< with which forces enter the balance of a step in time (core/terms/time_scheme.hpp)
	const BodyContact<Dim>*       acting = {}; ///< the term of the step that is being made
};

/// Places on the surface of a slave against the nearest piece of the master's surface that faces them, wherever the
/// step takes both. The penalty on the gap g is a pressure of stiffness * E g / h, with the smaller one of the moduli
/// of both there and h of the smallest cells. Without friction it has a potential, the sum of penalty g^2 / 2.
template <int Dim> class BodyContact : public CoupledTerm<Dim> {
public:
	/// The bodies and meetings are written in commit().
	BodyContact(BodyContacts<Dim>&, const Beginning<Dim>&);

	void                        markCouplings(Couplings&) const override;
	std::optional<PointFailure> addCoupled(const State&, const FieldSum<Dim>&) const override;
	void                        addCoupledBefore(const State&, const FieldSum<Dim>&) const override;
	bool                        isSymmetric() const override;
	std::string                 obstacle() const override { return obstacle_; }
	void                        restrain(const typename Term<Dim>::Hold&) const override;
	void                        restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Hold&) const override;
	Refusal                     refusal(const Eigen::VectorXd& d) const override;
	void                        commit(const Eigen::VectorXd& d) override;

	/// Adds the forces that resist at d, or, where that is null, as the step begins, without their weight.
	void addUnweighted(const Eigen::VectorXd* d, Eigen::VectorXd& resistance) const;

private:
	/// On the surface of the slave of a meeting. It moves with the vertices of its piece.
	struct Place {
		int              meeting, piece, number; ///< of the piece; of the place on that
		Vec<Dim>         normal;                 ///< as the step begins
		double           area;                   ///< as it was at first [m2]
		double           areaNow;                ///< as the step begins [m2]
		double           young = 0;
		Vec<Dim>         shear = Vec<Dim>::Zero(); ///< as the step begins [N]
		std::vector<int> near {};                  ///< pieces of the master
	};
	using Places = std::vector<std::vector<Vec<Dim>>>; ///< of the vertices of each body
	struct Touching {
		const Place&    place;
		int             piece; ///< of the master
		PairForce<Dim>  force;
		PairPlaces<Dim> now;
	};
	/// A node that moves some of the places of a pair, by these weights.
	struct PairNode {
		int                         node;
		std::array<double, Dim + 1> weight;
	};

	void                    attachAll(const Beginning<Dim>&);
	bool                    isThere(int body, int piece) const; ///< whether there is material at all of its vertices
	void                    addPlaces(int meeting);
	void                    takeModuli(const Beginning<Dim>&);
	void                    requireApart();
	Places                  placesAt(const Eigen::VectorXd& d) const;
	Vec<Dim>                placeAt(const Place&, const std::vector<Vec<Dim>>& vertices) const; ///< of the slave
	PairPlaces<Dim>         pair(const Place&, int piece, const Places&) const;
	int                     nearestOf(const Place&, const Places&) const;
	template <class F> void forTouching(const Eigen::VectorXd& d, bool withSlope, F&& f) const; ///< f(Touching)
	std::vector<PairNode>   nodesOf(const Place&, int piece) const;
	void                    add(const Eigen::VectorXd& d, double weight, Eigen::VectorXd& force, Eigen::VectorXd* sizes, Couplings*) const;
	void                    holdAt(const Touching&, bool sticks, const typename Term<Dim>::Hold&) const;
	double                  approach(const BodyMeeting<Dim>&, const Places& now) const;
	void                    moveSurfaces(const Places& now);
	const BodyMeeting<Dim>& meetingOf(const Place& place) const { return system_.meetings[place.meeting]; }
	const Surface<Dim>&     surfaceOf(int body) const { return system_.bodies[body].surface; }

	BodyContacts<Dim>& system_;
	const double       cellSize_, tolerance_, reach_; // tolerance: of a gap that counts as touching; reach: of the search [m]
	const bool         isRing_;
	const Eigen::Index unknowns_;
	const Grid<Dim>&   grid_;
	// Of the vertices of each body; none: there is no material near.
	std::vector<std::vector<std::optional<Attachment<Dim>>>> at_;
	Places                                                   start_;
	std::vector<Place>                                       places_;
	std::string                                              obstacle_;
};

} // namespace gimpm
