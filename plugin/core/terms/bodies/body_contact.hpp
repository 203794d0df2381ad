// SPDX-License-Identifier: GPL-2.0-or-later
// Contact of bodies of points with each other.
#pragma once
#include "core/terms/bodies/body_pair.hpp"
#include "core/terms/contact/facets.hpp"
#include "core/terms/contact_energy.hpp"
#include "core/terms/coupled_term.hpp"
#include "core/terms/passage.hpp"
#include <functional>

namespace gimpm {

/// Longest side of a piece over the cell size: in space legs of half a cell, as there are many.
template <int Dim> constexpr double pieceLimitOfBodies = Dim == 2 ? pieceLimit : 0.75;

/// Stretch of sides beyond which pieces are divided: without it most of them would be in the first step.
constexpr double stretchOfPieces = 1.2;

/// Deepest penetration of a contact point behind the surface of another body, over the cell size.
constexpr double deepestInBodies = 0.25;

/// The penalty on the gap over that on the slip. What sticks then slides as if a layer of some tenths of a cell lay
/// between the bodies.
constexpr double slipSoftnessOfBodies = 4;

/// Distance up to which pieces are searched, over the cell size.
constexpr double reachOfBodies = 0.5;

/// A body of points that others may meet.
template <int Dim> struct MeetingBody {
	std::string  name;
	int          layer = 0; ///< layer of its nodes
	Surface<Dim> surface;   ///< moved with it in each step that is accepted
	/// In this step: layers of the pieces that face others of the body nearby, -1 of the others; empty: there are
	/// none.
	std::vector<int> layerOfPiece {};

	/// Makes contact independent of the diagonals of rectangles, before the first step.
	void divideRectangles(double cellSize)
	{
		if constexpr (Dim == 3) gimpm::divideRectangles(surface, cellSize);
	}

	/// Parts of the surface are no longer than pieceLimitOfBodies at first, and later with stretchOfPieces. Returns
	/// for each which it has been part of.
	std::vector<int> refine(double cellSize)
	{
		const double stretch = surface.vertices == surface.vertices0 ? 1 : stretchOfPieces;
		return surface.refine(stretch * pieceLimitOfBodies<Dim> * cellSize);
	}
};

/// Two bodies that may meet, by their numbers: contact points on the one bear on pieces of the surface of the other. Of
/// a body and itself they are on the sides of folds in the higher layers.
template <int Dim> struct BodyMeeting {
	int    slave = 0, master = 0;
	double frictionCoefficient = 0;                                       ///< [-]
	double adhesion            = std::numeric_limits<double>::infinity(); ///< cap of the shear stress [Pa]
	double stiffness           = 10;
	bool   isOfOne             = false; ///< both are parts of one body
	double leakage             = 0;     ///< water that passes where they touch: volume by area and time, over the difference of the pressures [m3/(N s)]

	bool isFilled = false; ///< water is between them, also where they do not touch, and presses on both

	/// Stress on each piece of the slave's surface at the end of the last accepted step [Pa]; empty: none.
	std::vector<Vec<Dim>> shear {};
	std::vector<double>   pressure {};
	/// Resultant force on the slave [N], its moment about the origin [N m], and the number of contact points that
	/// touch.
	Vec<Dim> force    = Vec<Dim>::Zero();
	Vec3     moment   = Vec3::Zero();
	int      touching = 0, slipping = 0;
};

template <int Dim> class BodyContact;

/// In explicit steps what the end of the step adds to the forces is an impulse
/// (core/terms/inertia/contact_impulse.hpp).
template <int Dim> struct BodyContacts : ContactEnergy {
	std::vector<MeetingBody<Dim>> bodies;
	std::vector<BodyMeeting<Dim>> meetings;
	double                        duration = 0;  ///< duration of the step [s]
	const BodyContact<Dim>*       acting   = {}; ///< the term of the step that is being made
};

/// Positions on the surface of a slave against the nearest piece of the master's surface that faces them, wherever the
/// step takes both. The penalty on the gap g is a pressure of stiffness * E g / h, with the smaller one of the moduli
/// of both there and h of the smallest cells. Without friction it has a potential, the sum of penalty g^2 / 2.
template <int Dim> class BodyContact : public CoupledTerm<Dim> {
public:
	/// The bodies and meetings are written in commit().
	BodyContact(BodyContacts<Dim>&, const StepContext<Dim>&, const State& begins);

	void                        markCouplings(Couplings&) const override;
	std::optional<PointFailure> addCoupled(const State&, const FieldSum<Dim>&) const override;
	void                        addCoupledBefore(const State&, const FieldSum<Dim>&) const override;
	bool                        isSymmetric() const override { return !isExact_; }
	bool                        makeExact() override;
	std::string                 obstacle() const override { return obstacle_; }
	void                        restrain(const typename Term<Dim>::Constrain&) override;
	void                        restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Constrain&) override;
	Refusal                     refusal(const Eigen::VectorXd& d) override;
	void                        commit(const Eigen::VectorXd& d) override;

	/// Adds the forces that resist at d, or, where that is null, as the step begins, without their weight. The
	/// latter are those at the end of the last step, whatever gaps are found anew: so no momentum is lost.
	void addUnweighted(const Eigen::VectorXd* d, Eigen::VectorXd& resistance) const;

	/// The same at d, with symmetric derivatives by displacements, if these are asked for.
	void addWithTangent(const Eigen::VectorXd& d, Eigen::VectorXd& resistance, Couplings*) const;

private:
	/// A piece of the master near a contact point. The foot of the contact point as the step begins moves with the
	/// functions of the grid, and between the vertices of its piece by a little less or more than these: so what
	/// presses evenly is in balance with an even stress wherever pieces lie in the cells.
	struct Near {
		int                     piece;  ///< number among the master's facets
		std::array<double, Dim> weight; ///< weights of the vertices, at the foot
		Attachment<Dim>         foot;
	};
	/// On the surface of the slave of a meeting.
	struct ContactPoint {
		int               meeting, piece; ///< numbers of the meeting, and of the facet
		Vec<Dim>          start, normal;
		double            area; ///< [m2]
		ContactLaw<Dim>   law {};
		double            normalForce     = 0;                ///< force as the step begins [N]
		Vec<Dim>          tangentialForce = Vec<Dim>::Zero(); ///< the same
		double            closed          = 0;                ///< gap at which it begins to be pressed [m]
		Attachment<Dim>   at;
		std::vector<Near> near {};
		const Near*       first = nullptr; ///< the nearest as the step begins
	};
	using Positions = std::vector<std::vector<Vec<Dim>>>; ///< positions of the facets of each body
	struct Touching {
		const ContactPoint& contactPoint;
		const Near&         near;
		PairAction<Dim>     force;
		PairPositions<Dim>  now;
	};
	/// Contact at some displacements, kept for all calls of a step that need it there.
	struct ContactState {
		Eigen::VectorXd       d;
		Positions             now;
		std::vector<Touching> touching {};
	};
	/// Water between a contact point and the piece that it begins with, and its force on both.
	struct Wedge {
		const ContactPoint* contactPoint;
		PairAction<Dim>     force;
	};
	/// A node that moves some of the contact points of a pair, by these weights.
	struct PairNode {
		int                         node;
		std::array<double, Dim + 1> weight;
	};
	using Tangent = typename PairForce<Dim>::Tangent;

	void                          addContactPoints(int meeting, const StepContext<Dim>&);
	void                          findNear(ContactPoint&, const std::vector<int>& pieces, Attacher<Dim>& ofMaster) const;
	void                          makeLaws(const StepContext<Dim>&);
	void                          findFirst(ContactPoint&);
	bool                          isDeep(const ContactPoint&) const;
	void                          leaveOutDeepFolds();
	void                          keepApart(ContactPoint* begin, ContactPoint* end);
	void                          takeWater(const Eigen::VectorXd& pressures, bool flows);
	bool                          isInFilledJoint(const ContactPoint&) const;
	void                          addWedge(const ContactPoint&, double pressure);
	void                          begin(ContactPoint&);
	bool                          isFold(const BodyMeeting<Dim>& meeting) const { return meeting.slave == meeting.master; }
	int                           layerOf(int body, int piece) const;
	bool                          mayTouch(const ContactPoint&, int piece) const;
	std::vector<std::vector<int>> verticesOf(const BodyMeeting<Dim>&) const;
	int                 wholeOf(const ContactPoint& contactPoint) const { return facets_[meetingOf(contactPoint).slave].whole[contactPoint.piece]; }
	Positions           positionsAt(const Eigen::VectorXd& d) const;
	PairPositions<Dim>  pair(const Vec<Dim>& position, int body, int piece, const Positions&) const;
	PairPositions<Dim>  pairNow(const ContactPoint&, const Near&, const Eigen::VectorXd& d, const Positions&) const;
	PairPositions<Dim>  pairThen(const ContactPoint&, const Near&, const Eigen::VectorXd* d, const Positions&) const;
	const Near*         nearestOf(const ContactPoint&, const Eigen::VectorXd* d, const Positions&) const;
	bool                isRough() const;
	bool                goesOn(const PairPositions<Dim>&) const;
	const ContactState& contactAt(
	        const Eigen::VectorXd& d, PairJacobian = PairJacobian::none, const std::function<void(const Touching&, const Tangent&)>& = {}) const;
	PairJacobian          jacobianKind() const { return isExact_ || !isRough() ? PairJacobian::exact : PairJacobian::symmetric; }
	std::vector<PairNode> nodesOf(const ContactPoint&, const Near&) const;
	void                  markNodes(const ContactPoint&, std::vector<int>& nodes) const;
	void add(const Eigen::VectorXd& d, double weight, Eigen::VectorXd& force, Eigen::VectorXd* absoluteContributions, Couplings*, PairJacobian) const;
	void addForces(
	        const std::vector<PairNode>&, const PairAction<Dim>&, double factor, Eigen::VectorXd& force, Eigen::VectorXd* absoluteContributions) const;
	void                    addTangent(const std::vector<PairNode>&, const Tangent&, double factor, Couplings&) const;
	void                    constrainAt(const Touching&, bool slips, const typename Term<Dim>::Constrain&) const;
	void                    moveSurfaces(const Positions& now);
	double                  work(const Eigen::VectorXd& d) const;
	double                  energyGain(const Eigen::VectorXd& d) const;
	Refusal                 refusalOfEnergy(const Eigen::VectorXd& d) const;
	double                  approach(const BodyMeeting<Dim>&, const Positions& now) const;
	bool                    areFar(const BodyMeeting<Dim>&, double reach) const;
	const BodyMeeting<Dim>& meetingOf(const ContactPoint& contactPoint) const { return system_.meetings[contactPoint.meeting]; }

	BodyContacts<Dim>&        system_;
	const double              cellSize_, tolerance_, reach_; // tolerance: of a gap that counts as touching; reach: of the search [m]
	const bool                isRing_;
	bool                      isExact_ = false; // derivatives are those of the forces
	const Eigen::Index        unknowns_;
	std::vector<Facets<Dim>>  facets_; // facets of the bodies
	Positions                 start_;
	std::vector<ContactPoint> contactPoints_;
	std::vector<Passage<Dim>> passages_;
	std::vector<Wedge>        wedges_;
	std::string               obstacle_;
	mutable ContactState      state_; // the last one
};

} // namespace gimpm
