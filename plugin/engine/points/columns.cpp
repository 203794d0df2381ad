// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/columns.hpp"
#include "core/materials/kinematics.hpp"
#include "engine/materials/laws.hpp"
#include "engine/points/parallel.hpp"
#include <algorithm>
#include <set>

namespace yade {

namespace {
	using Point    = const MaterialPoint&;
	using First    = const MaterialPoint*;
	using RowByRow = Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>;

	constexpr auto arrays = PointColumn::inArrays, vtk = PointColumn::inVtk, derived = PointColumn::derived, ofMotion = PointColumn::ofMotion,
	               ofWater = PointColumn::ofWater, ofSplits = PointColumn::ofSplits, ofPores = PointColumn::ofPores, ofFlow = PointColumn::ofFlow,
	               ofBodies = PointColumn::ofBodies, ofAir = PointColumn::ofAir;

	// Column of integers; of(point, scene) is the number.
	template <class Of> PointColumn integer(const char* name, unsigned uses, Of of)
	{
		const auto get = [of](First p, First last, const Scene& scene, Real* to) {
			for (; p != last; ++p)
				*to++ = of(*p, scene);
		};
		return { name, "-", name, 1, true, uses, get, nullptr };
	}
	// Column of a result; of(point) is the value, or the address of the value where it can be set.
	template <class Of> PointColumn result(const char* name, const char* unit, const char* label, unsigned uses, Of of)
	{
		using T             = std::decay_t<decltype(of(std::declval<Point>()))>;
		constexpr int width = sizeof(T) / sizeof(Real);
		const auto    get   = [of](First p, First last, const Scene&, Real* to) {
                        for (; p != last; ++p) {
                                if constexpr (std::is_same_v<T, Real>) *to = of(*p);
                                else if constexpr (std::is_same_v<T, Vector3r>)
                                        Eigen::Map<Vector3r> { to } = of(*p);
                                else
                                        Eigen::Map<RowByRow> { to } = of(*p);
                                to += width;
                        }
		};
		return { name, unit, label, width, false, uses, get, nullptr };
	}
	// `member`, or a function of the object, is a reference to the value in the state, or in the shape.
	template <class Member> PointColumn given(const char* name, const char* unit, const char* label, unsigned uses, Member member)
	{
		const auto of = [member](auto& state, auto& shape) -> auto&
		{
			if constexpr (std::is_invocable_v<Member, MpmState&>) return std::invoke(member, state);
			else
				return std::invoke(member, shape);
		};
		PointColumn column = result(name, unit, label, uses, [of](Point p) { return of(*p.state, *p.shape); });
		column.set         = [of](Point p, const Real* from) {
                        const PointWriter writer;
                        auto&             to = of(writer.state(p), writer.shape(p));
                        if constexpr (std::is_same_v<decltype(to), Vector3r&>) to = Eigen::Map<const Vector3r>(from);
                        else
                                to = Eigen::Map<const RowByRow>(from);
		};
		return column;
	}

	Vector3r& position(const MpmState& state) { return state.pos; } // no member to point to: State has it by reference

	// Velocity, which begins a motion if it is given: the next step finds the acceleration that goes with it.
	PointColumn velocity()
	{
		PointColumn column = result("velocity", "m/s", "velocity", arrays | vtk | ofMotion, [](Point p) { return p.state->vel; });
		column.set         = [](Point p, const Real* from) {
                        MpmState& state = PointWriter().state(p);
                        state.vel       = Eigen::Map<const Vector3r>(from);
                        state.acceleration.setZero();
		};
		return column;
	}

	PointColumn excessPressure()
	{
		PointColumn column
		        = result("excessPressure", "Pa", "excess pore pressure", arrays | vtk | ofPores, [](Point p) { return p.state->excessPressure; });
		column.set = [](Point p, const Real* from) {
			MpmState& state      = PointWriter().state(p);
			state.excessPressure = *from;
			state.saturation     = std::numeric_limits<Real>::quiet_NaN(); // that of the pressure
		};
		return column;
	}

	// Initial value for a point that nobody has given the variable and that has made no step.
	Real initialValue(Point p, const gimpm::InternalVariable& variable)
	{
		for (const auto& [known, value] : initialInternalsOf(*p.material))
			if (known == &variable) return value;
		return std::numeric_limits<Real>::quiet_NaN(); // its law has none
	}
	PointColumn internal(const gimpm::InternalVariable& variable)
	{
		const auto get = [&variable](First p, First last, const Scene&, Real* to) {
			for (; p != last; ++p) {
				const Real* value = p->state->internal(variable.name);
				*to++             = value ? *value : initialValue(*p, variable);
			}
		};
		const auto set = [&variable](Point p, const Real* from) { PointWriter().state(p).setInternal(variable.name, *from); };
		return { variable.name, variable.unit, variable.description, 1, false, arrays | vtk, get, set, &variable };
	}

	// Parameter of the point, or of its material where the point has none of its own.
	Real parameterOf(Point p, const char* name)
	{
		if (const Real* own = p.state->parameter(name)) return *own;
		const ParameterOfClass* found = findParameter(*p.material, name);
		return found ? found->valueIn(*p.material) : std::numeric_limits<Real>::quiet_NaN();
	}
	PointColumn parameter(const Parameter& of)
	{
		const char* name = of.name;
		const auto  get  = [name](First p, First last, const Scene&, Real* to) {
                        for (; p != last; ++p)
                                *to++ = parameterOf(*p, name);
		};
		const auto set = [name](Point p, const Real* from) { PointWriter().state(p).setParameter(name, *from); };
		return { name, of.unit, of.label, 1, false, arrays | vtk, get, set, nullptr, true };
	}

	// Half the logarithm of the left Cauchy-Green tensor, for F = 1 + d.
	template <int Dim> Matrix3r strainOf(const gimpm::Mat<Dim>& d, Real across)
	{
		const auto b1 = gimpm::SymTensor<Dim>::from(gimpm::Mat<Dim>(d + d.transpose() + d * d.transpose()), across);
		const auto p  = gimpm::principal(b1);
		return gimpm::assemble<double, Dim>(gimpm::logStrain(p.value), p.axes).full();
	}
	Matrix3r strain(Point p)
	{
		const Matrix3r& F         = p.state->defGrad;
		const Matrix3r  d         = F - Matrix3r::Identity();
		const bool      isInPlane = F(0, 2) == 0 && F(1, 2) == 0 && F(2, 0) == 0 && F(2, 1) == 0;
		return isInPlane ? strainOf<2>(d.topLeftCorner<2, 2>(), d(2, 2) * (2 + d(2, 2))) : strainOf<3>(d, 0);
	}

	Matrix3r totalStress(Point p)
	{
		const Real push = std::isnan(p.state->pressureOnGrains) ? p.state->porePressure : p.state->pressureOnGrains;
		return p.state->stress - push * Matrix3r::Identity();
	}

	Real meanStress(Point p) { return p.state->stress.trace() / 3; }

	vector<PointColumn> makeColumns()
	{
		vector<PointColumn> columns {
			integer("id", arrays | vtk, [](Point p, const Scene&) { return p.id; }),
			given("pos", "m", "position", arrays, &position),
			given("pos0", "m", "initial position", arrays, &MpmState::refPos),
			result("halfSize", "m", "half size", arrays, [](Point p) { return p.shape->halfSize; }),
			result("halfSize0", "m", "initial half size", arrays, [](Point p) { return p.shape->halfSize0; }),
			velocity(),
			result("acceleration", "m/s²", "acceleration", arrays | vtk | ofMotion, [](Point p) { return p.state->acceleration; }),
			given("force", "N", "point load", arrays, &MpmState::force),
			given("stress", "Pa", "stress $\\sigma$", arrays | vtk, &MpmState::stress),
			given("defGrad", "-", "deformation gradient $F$", arrays | vtk, &MpmState::defGrad),
			given("elasticStrain", "-", "elastic strain $\\varepsilon$", arrays | vtk, &MpmState::elasticStrain),
			result("volume", "m³", "volume", arrays | vtk, [](Point p) { return p.state->volume; }),
		};
		columns.push_back(result("porePressure", "Pa", "pore pressure", arrays | vtk | ofWater, [](Point p) { return p.state->porePressure; }));
		columns.push_back(excessPressure());
		columns.push_back(result("waterFlux", "m/s", "flux of water", arrays | vtk | ofFlow, [](Point p) { return p.state->waterFlux; }));
		columns.push_back(result("saturation", "-", "degree of saturation", arrays | vtk | ofAir, [](Point p) { return p.state->saturation; }));
		columns.push_back(
		        result("pressureOnGrains", "Pa", "pressure on the grains", arrays | vtk | ofAir, [](Point p) { return p.state->pressureOnGrains; }));
		for (const gimpm::InternalVariable& variable : gimpm::internalVariables)
			columns.push_back(internal(variable));
		for (const Parameter& of : allParameters())
			columns.push_back(parameter(of));
		columns.push_back(integer("material", arrays | vtk, [](Point p, const Scene& scene) { return p.materialIndex(scene); }));
		columns.push_back(integer("body", arrays | vtk | ofBodies, [](Point p, const Scene&) { return p.state->body; }));
		columns.push_back(integer("splits", arrays | vtk | ofSplits, [](Point p, const Scene&) { return p.state->splits; }));
		columns.push_back(integer("parent", arrays | vtk | ofSplits, [](Point p, const Scene&) { return p.state->parent; }));
		columns.push_back(result("displacement", "m", "displacement", derived | vtk, [](Point p) { return Vector3r(p.state->pos - p.state->refPos); }));
		columns.push_back(result("strain", "-", "logarithmic strain", derived | vtk, &strain));
		columns.push_back(result("meanStress", "Pa", "mean stress", derived | vtk, &meanStress));
		columns.push_back(result("sqrt2J2", "Pa", "$\\sqrt{2J_2}$", derived | vtk, [](Point p) {
			return (p.state->stress - meanStress(p) * Matrix3r::Identity()).norm();
		}));
		columns.push_back(result("totalStress", "Pa", "total stress", derived | vtk | ofWater, &totalStress));
		columns.push_back(given("color", "-", "colour", 0, &MpmPoint::color));
		return columns;
	}
}

vector<const PointColumn*> columnsOf(const vector<MaterialPoint>& points)
{
	std::set<string>   names { gimpm::equivalentPlasticStrain.name };
	const MpmMaterial* last     = nullptr; // points of one material follow each other
	bool               hasWater = false, hasSplits = false, hasPores = false, hasFlow = false, hasBodies = false, hasAir = false;
	for (const MaterialPoint& point : points) {
		hasWater  = hasWater || !std::isnan(point.state->porePressure);
		hasSplits = hasSplits || point.state->splits > 0;
		hasBodies = hasBodies || point.state->body >= 0;
		hasFlow   = hasFlow || !std::isnan(point.state->waterFlux[0]);
		hasAir    = hasAir || !std::isnan(point.state->saturation);
		hasPores  = hasPores || hasFlow || point.state->excessPressure != 0 || point.material->undrained;
		for (const auto& own : point.state->parameters)
			names.insert(own.first);
		if (point.material.get() == last) continue;
		last = point.material.get();
		for (const auto& [variable, first] : initialInternalsOf(*last))
			names.insert(variable->name);
	}
	vector<const PointColumn*> columns;
	const auto                 isThere = [&](const PointColumn& column) {
                if (column.variable || column.isParameter) return names.count(column.name) > 0;
                return (hasWater || !column.is(ofWater)) && (hasSplits || !column.is(ofSplits)) && (hasPores || !column.is(ofPores))
                        && (hasFlow || !column.is(ofFlow)) && (hasBodies || !column.is(ofBodies)) && (hasAir || !column.is(ofAir));
	};
	for (const PointColumn& column : pointColumns())
		if (isThere(column)) columns.push_back(&column);
	return columns;
}

const vector<PointColumn>& pointColumns()
{
	static const vector<PointColumn> columns = makeColumns();
	return columns;
}

// The parts of a body lie in many places: all columns of a few bodies are filled while these are at hand.
void fillRows(const vector<ColumnRows>& table, const vector<MaterialPoint>& points, const Scene& scene)
{
	constexpr size_t few = 64;
	inRanges(points.size(), [&](size_t begin, size_t end) {
		for (size_t p = begin; p < end; p += few)
			for (const ColumnRows& rows : table)
				rows.column->get(&points[p], points.data() + std::min(p + few, end), scene, rows.to + p * rows.column->width);
	});
}

const PointColumn* findColumn(const string& name)
{
	for (const PointColumn& column : pointColumns())
		if (column.name == name) return &column;
	return nullptr;
}

py::list pointColumnsForPython()
{
	py::list list;
	for (const PointColumn& column : pointColumns()) {
		if (!column.is(PointColumn::inArrays) && !column.is(PointColumn::derived)) continue;
		py::dict entry;
		entry["name"]        = column.name;
		entry["unit"]        = column.unit;
		entry["label"]       = column.label;
		entry["width"]       = column.width;
		entry["isInteger"]   = column.isInteger;
		entry["isGiven"]     = bool(column.set);
		entry["derived"]     = column.is(PointColumn::derived);
		entry["isInternal"]  = bool(column.variable);
		entry["isParameter"] = column.isParameter;
		list.append(entry);
	}
	return list;
}

} // namespace yade
