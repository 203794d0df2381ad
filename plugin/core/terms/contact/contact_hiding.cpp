// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a body that others hide: contact points inside of them, and soil behind them.
#include "core/terms/contact/contact.hpp"
#include <algorithm>

namespace gimpm {

/// Bodies in or on which a contact point of the body may be.
template <int Dim> std::vector<int> Contact<Dim>::bodiesAround(int number) const
{
	const auto [low, high] = system_.bodies[number].bounds(system_.bodies[number].begin);
	std::vector<int> found;
	for (int b = 0; b < int(system_.bodies.size()); ++b) {
		const auto [otherLow, otherHigh] = system_.bodies[b].bounds(system_.bodies[b].begin);
		const bool isApart               = (otherLow.array() > high.array() + tolerance_).any() || (otherHigh.array() < low.array() - tolerance_).any();
		if (b != number && !isApart) found.push_back(b);
	}
	return found;
}

/// True if the contact point is in another body, in a joint with it, or on the surface of one that came first and faces
/// alike.
template <int Dim> bool Contact<Dim>::isHidden(int number, const Vec<Dim>& position, const Vec<Dim>& normal, const std::vector<int>& around) const
{
	for (const int b : around) {
		const auto& other    = system_.bodies[b];
		const auto  at       = other.proximity(other.begin, position, other.sideOf(other.begin, position + grid_.cellSize * normal));
		const bool  isAlike  = at.normal.dot(normal) > 1 - 1e-6 && std::abs(at.gap) <= tolerance_ && at.beside < 0;
		const bool  isInside = !other.shape.isTwoSided && at.gap < -tolerance_;
		const bool  isJoint  = !other.shape.isTwoSided && at.normal.dot(normal) < -1 + 1e-6 && at.gap <= tolerance_;
		if (isInside || isJoint || (isAlike && b < number)) return true;
	}
	return false;
}

/// Sheets around that may be between a contact point and soil, and how far the contact point is from their planes.
template <int Dim> std::vector<std::pair<int, double>> Contact<Dim>::screensBefore(const Vec<Dim>& position, const std::vector<int>& around) const
{
	std::vector<std::pair<int, double>> found;
	for (const int b : around) {
		const auto& sheet = system_.bodies[b];
		if (sheet.shape.kind != RigidKind::sheet) continue;
		const double away = sheet.proximity(sheet.begin, position, 1).gap + sheet.halfThickness();
		if (std::abs(away) > tolerance_) found.emplace_back(b, away);
	}
	return found;
}

/// True if a screen is between the two. At the edge that it shares with the sheet of the contact point, as below a pile
/// that is made of sheets, soil outside is beside the contact points inside. Soil that is a little behind the screen
/// counts as before it.
template <int Dim> bool Contact<Dim>::isBehind(const std::vector<std::pair<int, double>>& screens, const Vec<Dim>& position, const Vec<Dim>& soil) const
{
	return std::any_of(screens.begin(), screens.end(), [&](const auto& screen) {
		const auto&  sheet = system_.bodies[screen.first];
		const double here  = screen.second;
		if (here * sheet.sideOf(sheet.begin, soil) > 0) return false;
		const double   there    = sheet.proximity(sheet.begin, soil, 1).gap + sheet.halfThickness();
		const Vec<Dim> crossing = here * there < 0 ? Vec<Dim>(position + here / (here - there) * (soil - position)) : soil;
		return sheet.proximity(sheet.begin, crossing, 1).beside < 0;
	});
}

template std::vector<int>                    Contact<2>::bodiesAround(int) const;
template bool                                Contact<2>::isHidden(int, const Vec<2>&, const Vec<2>&, const std::vector<int>&) const;
template std::vector<std::pair<int, double>> Contact<2>::screensBefore(const Vec<2>&, const std::vector<int>&) const;
template bool                                Contact<2>::isBehind(const std::vector<std::pair<int, double>>&, const Vec<2>&, const Vec<2>&) const;
template std::vector<int>                    Contact<3>::bodiesAround(int) const;
template bool                                Contact<3>::isHidden(int, const Vec<3>&, const Vec<3>&, const std::vector<int>&) const;
template std::vector<std::pair<int, double>> Contact<3>::screensBefore(const Vec<3>&, const std::vector<int>&) const;
template bool                                Contact<3>::isBehind(const std::vector<std::pair<int, double>>&, const Vec<3>&, const Vec<3>&) const;

} // namespace gimpm
