// SPDX-License-Identifier: GPL-2.0-or-later
// Contact of the body with rigid bodies: penalty, friction, and what is remembered of both.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/terms/contact/contact_free.hpp"
#include "core/terms/contact/contact_law.hpp"
#include "core/terms/contact/contact_search.hpp"
#include "core/terms/contact/contact_sight.hpp"
#include "core/terms/contact/contact_surface.hpp"
#include "core/terms/contact/force_distribution.hpp"
#include "core/terms/coupled_term.hpp"
#include "core/terms/step_kind.hpp"

namespace gimpm {

/// A contact point on the surface of a body that had soil in front of it at the end of a step that was accepted.
template <int Dim> struct ContactRecord {
	int          body;
	std::int64_t number;      ///< number of the contact point on the body, and above contactPointBits the layer of the soil
	double       gap     = 0; ///< to the soil, < 0 by the penalty [m]
	bool         touches = false, slips = false;
	double       normalForce     = 0; ///< [N]
	double       areaFraction    = 0; ///< area fraction of soil in front of it (core/terms/contact/contact_sight.hpp)
	double       travel          = 0; ///< distance that soil moved along the body in that step [m]
	double       creep           = 0; ///< the part of it in which soil moves through the grid [m]
	Vec<Dim>     tangentialForce = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero(); ///< on the soil [N]; of the body
	Vec<Dim>     position = Vec<Dim>::Zero();                                   ///< position of the soil at the end of the step [m]
};

/// So a number stays one that doubles have.
constexpr int contactPointBits = 51, layersOfContactPoints = 4;

/// Forces of the soil on the owner of bodies.
struct ContactLoad {
	using Stiffness = Eigen::Matrix<double, 6, 6>;
	Vec3      force = Vec3::Zero(), torque = Vec3::Zero(); ///< about the owner's position [N], [N m]
	Stiffness stiffness = Stiffness::Zero();               ///< in 3D, an upper bound: of the penalties alone, for a translation and a rotation of the owner
	double    area = 0, young = 0; ///< area of the contact points that touch [m2], and that by Young's modulus of the soil there [N]

	ContactLoad& operator+=(const ContactLoad& other)
	{
		force += other.force, torque += other.torque, stiffness += other.stiffness;
		area += other.area, young += other.young;
		return *this;
	}
};

template <int Dim> class Contact;

/// The rigid bodies beside the soil, and what is between them.
template <int Dim> struct ContactSystem {
	std::vector<RigidBody<Dim>>     bodies;
	std::vector<Vec<Dim>>           owners;     ///< positions at the end of the step [m]
	std::vector<ContactRecord<Dim>> records {}; ///< last step that was accepted, sorted by body and number
	std::vector<ContactLoad>        loads {};   ///< on the owners, then
	double                          work   = 0; ///< on the soil in that step, with the forces at its end [J]
	double                          weight = 1; ///< weight of forces in the balance of a time step (core/terms/inertia/time_scheme.hpp)
	StepKind                        kind   = StepKind::quasiStatic;
	double                          energy = 0; ///< energy that has come into the system before this time step [J]
	/// Work of contact in that step beyond what it had stored, which is that of no body [J].
	double        energyGain = 0;
	Contact<Dim>* acting {}; ///< the term of the step that is being made
	/// Those of the owners that move within the step as soil and loads make them; of the bodies that they own the
	/// end of the step is a result.
	std::vector<FreeBody<Dim>> free {};
};

/// The penalty on the gap over that on the slip. With 20 a contact point slides after mu p h / (stiffness / 20 E).
/// Blocks that are sheared to and fro by a plate, friction .3 to 4, take 5 solves a step; with 2 it is 8, and with 50
/// 4.5.
constexpr double slipSoftness = 20;

/// Contact points on the surfaces of the bodies against the soil in front of them, which moves with the linear
/// functions of the grid. The penalty on the gap g is a pressure of stiffness * E g / h, with Young's modulus E of the
/// soil there and h of the smallest cells, over the contact point's part of the surface. The gap is that which there
/// was when soil came into sight, and since then what soil and body have moved towards each other, along the normal of
/// the contact point's own face: which neither edges nor domains that come and go let jump. In time steps the
/// contact points on a ball go around it with the soil, as a ball that turns in its place is the same ball: else those
/// before its lowest one would be pressed deeper with all of its way, and lift it. Only prescribed motion of the bodies
/// is known here. What of a surface lies in another body, or on one that came first, does not count. Where points are
/// divided among processes, all know those that are near.
template <int Dim> class Contact : public Term<Dim> {
public:
	/// The records and loads of the system are written in commit(). What add() adds has the weight of the system.
	Contact(ContactSystem<Dim>&, const StepContext<Dim>&);

	void                        mark(NodeMatrix<Dim>&) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;
	void                        addBefore(Eigen::VectorXd& force) override;
	bool                        isSymmetric() const override { return isSymmetric_; }
	std::string                 obstacle() const override { return obstacle_; }
	double                      fromOutside(const Eigen::VectorXd& d) override { return this->sizeOfForce(d); }
	void                        restrain(const typename Term<Dim>::Constrain&) override;
	void                        restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Constrain&) override;
	Refusal                     refusal(const Eigen::VectorXd& d) override;
	void                        commit(const Eigen::VectorXd& d) override;

	/// Adds what free bodies contribute to the Jacobian besides add(): their motion follows that of the soil at all
	/// contact points that they touch.
	void markFree(Couplings&) const;
	void addFree(const Eigen::VectorXd& d, Couplings&);

private:
	/// A material point near a body, whichever process has it. Numbers only.
	struct Near {
		int                     body, side, layer;
		std::array<double, Dim> position, halfSize; ///< at the start of the step
		double                  young;

		Vec<Dim> centre() const { return Eigen::Map<const Vec<Dim>>(position.data()); }
		Vec<Dim> half() const { return Eigen::Map<const Vec<Dim>>(halfSize.data()); }
	};
	/// A contact point on a body with soil in front of it.
	struct ContactPoint {
		int                    body;
		std::int64_t           number;
		Vec<Dim>               soil;                               ///< edge of the soil, at the start of the step
		Vec<Dim>               carried;                            ///< displacement of it with the body by the end
		Vec<Dim>               normal;                             ///< at the end
		double                 away;                               ///< distance of the soil from the body, at the start [m]
		double                 gap;                                ///< distance that counts as that
		double                 areaFraction;                       ///< area fraction of soil in front of it
		double                 area, young;                        ///< area of the surface with soil in front of it [m2]; modulus of the soil [Pa]
		Vec<Dim>               tangentialForce = Vec<Dim>::Zero(); ///< at the start, turned with the body
		ContactLaw<Dim>        law;
		Attachment<Dim>        attached;
		ForceDistribution<Dim> distribution; ///< nodes by which it sees the soil move, and on which it presses
	};

	void             takeSides();
	void             find(const StepContext<Dim>&);
	void             addContactPoints(int body);
	void             addContactPoints(int body, int layer);
	void             addContactPoint(int body, int layer, const SurfacePoint<Dim>&, const SoilNear<Dim>&, const std::vector<int>& around);
	void             recall(ContactPoint&, const ContactRecord<Dim>&, double seen) const;
	std::vector<int> bodiesAround(int body) const;
	bool             isHidden(int body, const Vec<Dim>& position, const Vec<Dim>& normal, const std::vector<int>& around) const;
	std::vector<std::pair<int, double>> screensBefore(const Vec<Dim>& position, const std::vector<int>& around) const;
	bool                                isBehind(const std::vector<std::pair<int, double>>& screens, const Vec<Dim>& position, const Vec<Dim>& soil) const;
	void                                checkOverlap(int body);
	auto                                nearTo(int body) const; // first and last in near_
	const ContactRecord<Dim>*           recordOf(const ContactPoint&) const;
	Approach<Dim>                       approach(const ContactPoint&, const Eigen::VectorXd& d) const;
	template <class F> void             forTouching(const Eigen::VectorXd& d, F&& f); // f(contact point, approach, touch)
	std::string                         entered(const Eigen::VectorXd& d);
	double                              energyGain(const Eigen::VectorXd& d);
	void                                addLoads(const ContactPoint&, const Vec<Dim>& position, const Touch<Dim>&);
	Mat<Dim>                            resistanceOf(const ContactPoint&, const Touch<Dim>&) const;
	void                                findLost();
	std::pair<int, int>                 contactPointsOf(int body) const;
	void                                widen(int body);
	void                                spreadPressure();
	void                                turnContactPoints(const Eigen::VectorXd& d);
	Vec<Dim>                            pointOfForce(const ContactPoint&, const Vec<Dim>& soil, const Vec<Dim>& normal) const;
	ContactLoad                         loadOn(const Vec<Dim>& owner, const ContactPoint&, const Vec<Dim>& position, const Touch<Dim>&) const;

	struct Moved {
		Vec<Dim> carried, normal, tangentialForce;
	};
	Moved                            moved(const ContactPoint&) const;
	void                             solveRigidBodyMotion(const Eigen::VectorXd& d);
	void                             moveBodies(int free, const typename FreeBody<Dim>::Vector& motion);
	std::vector<const ContactPoint*> contactPointsOfFree(int free) const;
	FreeContactPoint<Dim>            seen(const ContactPoint&, const Vec<Dim>& owner, const Eigen::VectorXd& d) const;
	double                           sizeOfFree(int free) const;
	std::string                      unbalanced() const;

	ContactSystem<Dim>&       system_;
	Eigen::VectorXd           solvedAt_;  ///< displacements at which free bodies are in balance, if there are some
	double                    tolerance_; // tolerance of a gap that counts as touching [m]
	bool                      isRing_, isSymmetric_ = true;
	std::vector<Near>         near_;          // points near bodies, by body
	std::vector<ContactPoint> contactPoints_; // sorted by body and number
	std::string               obstacle_;

	std::vector<std::pair<Attachment<Dim>, std::size_t>> lost_; // points with the numbers of their records
	const PointCloud<Dim>&                               cloud_;
	const CloudBasis<Dim>&                               basis_;
	const Grid<Dim>&                                     grid_;
	const FreeDofs&                                      dofs_;
	const Division&                                      division_;
};

} // namespace gimpm
