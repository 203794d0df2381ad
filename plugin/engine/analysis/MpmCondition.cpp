// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/MpmCondition.hpp"
#include "engine/analysis/analysis.hpp"
#include "yade_api/registration.hpp"
#include <typeindex>

namespace yade {

namespace {
	[[noreturn]] void refuseBase(const MpmCondition::Group& group)
	{
		const string kind = group.front().condition->getClassName();
		throw std::invalid_argument(
		        group.front().name() + " is an " + kind + ", which does not say how it acts: use a class derived from it, such as MpmTraction.");
	}
}

std::shared_ptr<Condition<2>> MpmCondition::make(InPlane, const Group& group, const Analysis&) const { refuseBase(group); }
std::shared_ptr<Condition<3>> MpmCondition::make(InSpace, const Group& group, const Analysis&) const { refuseBase(group); }

// Each class where its first object is.
template <int Dim> Conditions<Dim> conditionsOf(const Analysis& analysis)
{
	vector<MpmCondition::Group>       groups;
	std::map<std::type_index, size_t> known;
	for (const Listed& listed : analysis.conditions()) {
		const MpmCondition& condition = *listed.condition;
		const auto [found, isNew]     = known.try_emplace(typeid(condition), groups.size());
		if (isNew) groups.emplace_back();
		groups[found->second].push_back(listed);
	}
	Conditions<Dim> made;
	for (const auto& group : groups)
		made.push_back(group.front().condition->make(std::integral_constant<int, Dim>(), group, analysis));
	return made;
}

template <int Dim> std::unique_ptr<Question> nextQuestion(const vector<Listed>& all, const gimpm::Grid<Dim>& grid, const vector<gimpm::Key>& cells)
{
	for (const Listed& listed : all)
		if (auto question = listed.condition->question(grid, cells, listed.name(), all)) return question;
	return nullptr;
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template Conditions<Dim>           conditionsOf(const Analysis&);                                                                                      \
	template std::unique_ptr<Question> nextQuestion(const vector<Listed>&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmCondition)
static const yade::PluginClasses<yade::MpmCondition> registeredMpmCondition(__FILE__);
