// SPDX-License-Identifier: GPL-2.0-or-later
// Laws that need more than the principal values of the trial strain: that remember vectors or tensors, as a back stress
// or a fabric, that depend on the step of time, or whose stress has other axes than the strain. They answer one point
// at a time, and cost many times as much as principal laws.
//
// Such a law is a class from TensorLaw, which is in no table. It has the members of
// core/materials/required_members.hpp and of hasTensorMembers(). Everything it is given, and answers, is seen by
// somebody who turns with the material in the step, so that there are no rotations in it: with the deformation gradient
// F = R U of the step, of which R is a rotation, strains, stresses and tensors are those turned back by R. What it
// remembers is turned by R after the step. Its stress is Kirchhoff's, and its strain logarithmic, as of all laws.
#pragma once
#include "core/materials/kinematics.hpp"
#include "core/materials/law_of.hpp"
#include <string>

namespace gimpm {

/// The mark of a tensor law.
struct TensorLaw { };

/// A scalar, a vector or a symmetric tensor that a law remembers of a point, as 1, 3 or 6 internal variables: their
/// names end in X, Y, Z or in XX, YY, ZZ, XY, YZ, ZX.
struct TensorVariable {
	enum class Kind { scalar = 1, vector = 3, tensor = 6 };
	InternalVariable variable;
	Kind             kind = Kind::scalar;

	constexpr TensorVariable() = default;
	constexpr TensorVariable(const InternalVariable& scalar) : variable(scalar) { }
	static constexpr TensorVariable vector(const char* name, const char* unit, const char* description)
	{
		return { name, unit, description, Kind::vector };
	}
	static constexpr TensorVariable tensor(const char* name, const char* unit, const char* description)
	{
		return { name, unit, description, Kind::tensor };
	}

	constexpr int count() const { return int(kind); } ///< number of numbers

	/// Adds them to those that there are, and returns their columns.
	std::vector<int> columns() const;

private:
	constexpr TensorVariable(const char* name, const char* unit, const char* description, Kind kind)
	        : variable { name, unit, description, -anyNumber, anyNumber }, kind(kind)
	{
	}
};

/// The variables of a law with their values. Number k is that of the law's `variables`.
class TensorState {
public:
	static constexpr int most = 54; ///< numbers of one law

	TensorState() = default;
	template <std::size_t Count> explicit TensorState(const std::array<TensorVariable, Count>& variables) : variables_(variables.data()), count_(Count) { }

	double& scalar(int k) { return number_[begin(k)]; }
	double  scalar(int k) const { return number_[begin(k)]; }
	Vec3    vector(int k) const { return Eigen::Map<const Vec3>(&number_[begin(k)]); }
	Mat3    tensor(int k) const
	{
		SymTensor<3> t;
		std::copy_n(&number_[begin(k)], 6, t.c.data());
		return t.full();
	}
	void setVector(int k, const Vec3& v) { std::copy_n(v.data(), 3, &number_[begin(k)]); }
	void setTensor(int k, const Mat3& symmetric) { std::copy_n(SymTensor<3>::from(symmetric).c.data(), 6, &number_[begin(k)]); }

	/// Vectors and tensors turn with the material.
	void turn(const Mat3& R);

	double*       numbers() { return number_.data(); }
	const double* numbers() const { return number_.data(); }
	int           size() const { return begin(count_); }

private:
	const TensorVariable*    variables_ = nullptr;
	int                      count_     = 0;
	std::array<double, most> number_ {};

	int begin(int k) const
	{
		int first = 0;
		for (int i = 0; i < k; ++i)
			first += variables_[i].count();
		return first;
	}
};

/// Derivatives of six numbers by six. The numbers of a symmetric tensor are xx, yy, zz, and sqrt(2) times xy, yz, zx
/// (Mandel), so that products of vectors are those of tensors, and the derivative is symmetric if the tensor of fourth
/// order is.
using Mandel = Eigen::Matrix<double, 6, 6>;
using Vec6   = Eigen::Matrix<double, 6, 1>;

inline Vec6 toMandel(const Mat3& m)
{
	const double root = std::sqrt(.5);
	Vec6         v;
	v << m(0, 0), m(1, 1), m(2, 2), root * (m(0, 1) + m(1, 0)), root * (m(1, 2) + m(2, 1)), root * (m(2, 0) + m(0, 2));
	return v;
}
inline Mat3 fromMandel(const Vec6& v)
{
	const double root = std::sqrt(.5);
	Mat3         m;
	m << v[0], root * v[3], root * v[5], root * v[3], v[1], root * v[4], root * v[5], root * v[4], v[2];
	return m;
}

/// Input of a tensor law.
struct TensorStep {
	Mat3        trialStrain;       ///< elastic logarithmic strain if nothing flows in the step
	Mat3        stretch;           ///< U of the step
	double      duration     = 0;  ///< duration of the step, in the time of the loads; 0: none goes by
	TensorState state        = {}; ///< state as the step begins
	bool        wantsTangent = true;
	bool        isBeginning  = false; ///< nothing has strained yet and no time has gone by: the stress that there is, is wanted alone
};

/// Response of a tensor law.
struct TensorAnswer {
	Mat3        stress        = Mat3::Zero();   ///< Kirchhoff stress [Pa]
	Mat3        elasticStrain = Mat3::Zero();   ///< after the step
	Mandel      tangent       = Mandel::Zero(); ///< consistent: d stress / d trialStrain [Pa], where it is wanted
	TensorState state;                          ///< after the step
	bool        failed = false;                 ///< there is no answer, as a law says that mayFail is true

	explicit TensorAnswer(const TensorState& before) : state(before) { }
};

/// A law that takes time, or whose answer to no strain and no time is not defined, has `Mat3 present(const TensorStep&)
/// const`: the Kirchhoff stress as the step begins.
template <class L> constexpr auto hasPresent(int) -> decltype(&L::present, true) { return true; }
template <class L> constexpr bool hasPresent(long) { return false; }

template <class L> constexpr bool hasTensorMembers()
{
	static_assert(
	        GIMPM_HAS(law.young(law.initialInternals())),
	        "the tensor law has no `double young(const TensorState&) const`: Young's modulus of unloading, as it is now");
	static_assert(
	        GIMPM_HAS(law.respond(std::declval<const TensorStep&>()).stress), "the tensor law has no `TensorAnswer respond(const TensorStep&) const`");
	if constexpr (hasRequiredMembers<L>()) {
		int numbers = 0;
		for (const TensorVariable& variable : L::variables)
			numbers += variable.count();
		return numbers <= TensorState::most;
	}
}

/// The columns of a law's variables. They are added when the library with the law is opened.
template <class L> std::vector<int> columnsOfTensorLaw()
{
	std::vector<int> columns;
	for (const TensorVariable& variable : L::variables)
		for (const int column : variable.columns())
			columns.push_back(column);
	return columns;
}

/// Interface of laws whose history follows from a stress [Pa], as hardening that the soil must have had to bear it.
/// Such a law has `TensorState bearing(const Mat3& stress, TensorState) const`, the state that bears it at least, and
/// `Mat3 strainOf(const Mat3& stress, const TensorState&) const`, the elastic strain that has it then.
struct BearsStress {
	virtual ~BearsStress()                                                                               = default;
	virtual std::vector<double> bearing(const Mat3& stress, const std::vector<double>& internals) const  = 0;
	virtual Mat3                strainOf(const Mat3& stress, const std::vector<double>& internals) const = 0;
};
template <class L> constexpr auto bears(int) -> decltype(&L::bearing, &L::strainOf, true) { return true; }
template <class L> constexpr bool bears(long) { return false; }

/// The part of a handle for such laws; of the others it is empty.
template <class L, bool = bears<L>(0)> struct BearingOf {
	explicit BearingOf(const L&) { }
};
template <class L> struct BearingOf<L, true> : BearsStress {
	explicit BearingOf(const L& law) : law_(law) { }
	std::vector<double> bearing(const Mat3& stress, const std::vector<double>& internals) const override
	{
		const TensorState state = law_.bearing(stress, stateOf(internals));
		return { state.numbers(), state.numbers() + state.size() };
	}
	Mat3 strainOf(const Mat3& stress, const std::vector<double>& internals) const override { return law_.strainOf(stress, stateOf(internals)); }

private:
	const L law_;

	TensorState stateOf(const std::vector<double>& internals) const
	{
		TensorState state = law_.initialInternals();
		std::copy(internals.begin(), internals.end(), state.numbers());
		return state;
	}
};

/// In kernels a law without meaning stands for a tensor law.
const PrincipalLaw& placeholder();

template <class L> class HandleOfTensorLaw : public LawOf<L>, public BearingOf<L> {
	static_assert(hasTensorMembers<L>(), "the law remembers more numbers than TensorState::most");
	static const std::vector<int> knownColumns;

public:
	explicit HandleOfTensorLaw(const L& law) : LawOf<L>(law), BearingOf<L>(law)
	{
		this->isTensorLaw       = true;
		this->principal         = &placeholder();
		this->columns           = knownColumns.empty() ? columnsOfTensorLaw<L>() : knownColumns;
		const TensorState first = law.initialInternals();
		this->initialInternals.assign(first.numbers(), first.numbers() + first.size());
	}
	double young(const PointOfLaw& p, const VolumetricStrain&) const override
	{
		return withParameters(this->own_, p.parameters, p.point, [&](const auto& law) { return law.young(stateOf(p)); });
	}
	WaveModuli waveModuli(const PointOfLaw& p, const VolumetricStrain& volumetricStrain) const override
	{
		const auto answer = respond(p, { volumetricStrain() / 3 * Mat3::Identity(), Mat3::Identity() });
		return { answer.tangent(0, 0), answer.tangent(3, 3) / 2 };
	}
	void copyInternals(const InternalColumns& from, std::size_t p, InternalColumns& to, std::size_t i) const override
	{
		const TensorState state = stateOf({ {}, from, p });
		for (std::size_t k = 0; k < this->columns.size(); ++k)
			to[this->columns[k]][i] = state.numbers()[k];
	}

	// It is asked as a tensor law: in principal axes it has no answer.
	std::optional<Vec3> strainNear(const Vec3&) const override { return std::nullopt; }
	PrincipalAnswer     respond(const Vec3&, const std::vector<double>& internals) const override
	{
		PrincipalAnswer none { {}, internals };
		none.failed = true;
		return none;
	}

	TensorAnswer respond(const PointOfLaw& p, const TensorStep& step) const override
	{
		TensorStep own = step;
		if (step.state.size() == 0) own.state = stateOf(p);
		return withParameters(this->own_, p.parameters, p.point, [&](const auto& law) {
			if constexpr (hasPresent<L>(0))
				if (own.isBeginning) {
					TensorAnswer answer(own.state);
					answer.stress = law.present(own);
					return answer;
				}
			return law.respond(own);
		});
	}

private:
	TensorState stateOf(const PointOfLaw& p) const
	{
		TensorState state = this->own_.initialInternals();
		for (std::size_t k = 0; k < this->columns.size(); ++k)
			if (const std::size_t c = this->columns[k]; c < p.internals.size() && !p.internals[c].empty())
				state.numbers()[k] = p.internals[c][p.point];
		return state;
	}
};
template <class L> const std::vector<int> HandleOfTensorLaw<L>::knownColumns = columnsOfTensorLaw<L>();

template <class L, class = std::enable_if_t<std::is_base_of_v<TensorLaw, L>>> std::shared_ptr<const AnyLaw> handleOf(const L& law)
{
	return std::make_shared<const HandleOfTensorLaw<L>>(law);
}

/// State of a point after a step, by a tensor law; and the derivatives of its Kirchhoff stress.
struct TensorPoint {
	/// Column 3 k + l: by the velocity gradient that has a one in row k and column l, in space.
	using Rates = Eigen::Matrix<double, 9, 9>;

	Mat3        stress, elasticStrain; ///< in space
	TensorState state;
	bool        failed;
	Rates       rates; ///< rates of the stress, row by row; where they are asked for
};

/// `b1`: elastic left Cauchy-Green tensor less 1 as the step begins. `gradient`: F - 1 of the step. Of the velocity
/// gradients only those in the first `dim` axes, and that along the third, if `axes` says so.
struct TensorQuestion {
	SymTensor<3> b1;
	Mat3         gradient;
	double       duration;
	bool         wantsRates;
	int          dim         = 3;
	int          axes        = 3;
	bool         isBeginning = false;
};
TensorPoint respondInSpace(const Law&, const PointOfLaw&, const TensorQuestion&);

} // namespace gimpm
