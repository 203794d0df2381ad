// SPDX-License-Identifier: GPL-2.0-or-later
// Contact of the body with rigid bodies: penalty, friction, and what is remembered of both.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/terms/contact_law.hpp"
#include "core/terms/contact_search.hpp"
#include "core/terms/term.hpp"

namespace gimpm {

/// A corner of a point's domain that touches a body at the end of a step that was accepted, or overlapped it when the
/// body came.
template <int Dim> struct ContactRecord {
	/// Number in the cloud, or id where points are divided; bit a of the corner set: upper along axis a.
	int point, corner, body;
	/// How much farther the corner is from the body than the soil that it stands for [m].
	double offset  = 0;
	bool   touches = false, slips = false;
	/// The offset taken off, < 0 by the penalty [m].
	double   gap      = 0;
	double   pressure = 0;                                           ///< normal force [N]
	Vec<Dim> friction = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero(); ///< on the soil [N]; of the body
	Vec<Dim> place = Vec<Dim>::Zero();                               ///< of the corner at the end of the step [m]
};

/// What the soil does to whoever owns bodies.
struct ContactLoad {
	using Stiffness = Eigen::Matrix<double, 6, 6>;
	Vec3      force = Vec3::Zero(), torque = Vec3::Zero(); ///< about the owner's position [N], [N m]
	Stiffness stiffness = Stiffness::Zero();               ///< in 3D, an upper bound: of the penalties alone, for a translation and a rotation of the owner
};

/// The rigid bodies beside the soil, and what is between them.
template <int Dim> struct ContactSystem {
	std::vector<RigidBody<Dim>>     bodies;
	std::vector<Vec<Dim>>           owners;     ///< positions at the end of the step [m]
	std::vector<ContactRecord<Dim>> records {}; ///< of the last step that was accepted, sorted by point, corner and body
	std::vector<ContactLoad>        loads {};   ///< on the owners, then
	double                          work   = 0; ///< on the soil in that step, with the forces at its end [J]
	double                          weight = 1; ///< with which forces enter the balance of a step in time (core/terms/time_scheme.hpp)
	/// Of a step in time: energy that has come into the system before it [J]; infinite: nobody asks for what
	/// contact gives.
	double energy = std::numeric_limits<double>::infinity();
	/// Work of contact in that step beyond what it had stored, which is that of no body [J].
	double                   given = 0;
	std::vector<std::string> warnings {}; ///< sentences about bodies near the soil, of the step that is being made
	const Term<Dim>*         acting {};   ///< the term of the step that is being made
};

/// Of a material point. Numbers only, to be told to other processes.
template <int Dim> struct PointDomain {
	std::array<double, Dim> position, halfSize;

	PointDomain() = default;
	PointDomain(const PointCloud<Dim>& cloud, int p)
	{
		std::copy_n(cloud.position[p].data(), Dim, position.data());
		std::copy_n(cloud.halfSize[p].data(), Dim, halfSize.data());
	}
	Vec<Dim> centre() const { return Eigen::Map<const Vec<Dim>>(position.data()); }
	Vec<Dim> half() const { return Eigen::Map<const Vec<Dim>>(halfSize.data()); }
	Vec<Dim> corner(int bits) const
	{
		Vec<Dim> x = centre();
		for (int a = 0; a < Dim; ++a)
			x[a] += (bits >> a & 1 ? 1 : -1) * halfSize[a];
		return x;
	}
};

/// The penalty on the gap over that on the slip. With 20 a place slides after mu p h / (stiffness / 20 E). Blocks that
/// are sheared to and fro by a plate, friction .3 to 4, take 5 solves a step; with 2 it is 8, and with 50 4.5.
constexpr double slipSoftness = 20;

/// Corners of the domains against the surfaces of the bodies. Corners move with the linear functions of the grid. The
/// penalty on the gap g is a pressure of stiffness * E g / h, with Young's modulus E of the point and h of the smallest
/// cells, over the corner's share of the domain's surface; Only prescribed motion of the bodies is known here. Of
/// bodies that overlap, with surfaces that face alike, one acts on a corner: the one that it is deepest in. Where
/// points are divided among processes, each finds those of its own that are near, and all know the corners of all of
/// them.
template <int Dim> class Contact : public Term<Dim> {
public:
	/// The records and loads of the system are written in commit(). What add() adds has the weight of the system.
	Contact(ContactSystem<Dim>&, const Beginning<Dim>&);

	void                        mark(NodeMatrix<Dim>&) const override;
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const TermSum<Dim>&) const override;
	void                        addBefore(Eigen::VectorXd& force) const override;
	bool                        isSymmetric() const override { return isSymmetric_; }
	std::string                 obstacle() const override { return obstacle_; }
	double                      fromOutside(const Eigen::VectorXd& d) const override { return this->sizeOfForce(d); }
	void                        restrain(const typename Term<Dim>::Hold&) const override;
	void                        restrainAt(const Eigen::VectorXd& d, const typename Term<Dim>::Hold&) const override;
	Refusal                     refusal(const Eigen::VectorXd& d) const override;
	void                        commit(const Eigen::VectorXd& d) override;

private:
	/// A point near a body, whichever process has it.
	struct Near {
		int              body, point, side; ///< `point` as in the records
		PointDomain<Dim> domain;            ///< at the start of the step
		double           volume, young;
	};
	/// A corner near a body.
	struct Corner {
		int             point, corner, body, side, near; ///< near: number in near_
		Vec<Dim>        place;                           ///< at the start of the step
		double          offset;
		Vec<Dim>        friction;
		bool            turns; // its friction, with the body
		ContactLaw<Dim> law;
		Attachment<Dim> attached;
	};

	void                    find(const Beginning<Dim>&);
	void                    addCorners(int near);
	ContactLaw<Dim>         lawOf(const RigidBody<Dim>&, const Near&, const Vec<Dim>& place, const Vec<Dim>& normal) const;
	Approach<Dim>           approach(const Corner&, const Vec<Dim>& x) const;
	template <class F> void forTouching(const Eigen::VectorXd& d, F&& f) const; // f(corner, its place, gap, touch)
	struct Acting;
	void                          choose(std::vector<Acting>&, const Corner&, const Approach<Dim>&) const;
	void                          look(const Near&);
	std::string                   missed(const Eigen::VectorXd& d) const;
	std::string                   missed(const NearPoint&, const Eigen::VectorXd& d) const;
	double                        given(const Eigen::VectorXd& d) const;
	std::string                   refusalOfGift(const Eigen::VectorXd& d) const;
	std::vector<PointDomain<Dim>> domainsNow() const; // by number in near_
	ContactLoad                   loadOn(const Vec<Dim>& owner, const Corner&, const Vec<Dim>& place, const Touch<Dim>&) const;

	ContactSystem<Dim>&    system_;
	double                 tolerance_; // of a gap that counts as touching [m]
	bool                   isRing_, isSymmetric_ = true;
	std::vector<int>       own_;     // points of the cloud that are near, of this process
	std::vector<Near>      near_;    // in the order of own_, one process after the other
	std::vector<Corner>    corners_; // by point, corner and body
	std::vector<Vec<Dim>>  spins_;   // of the bodies
	std::string            obstacle_;
	const PointCloud<Dim>& cloud_;
	const CloudBasis<Dim>& basis_;
	const Grid<Dim>&       grid_;
	const Division&        division_;
};

} // namespace gimpm
