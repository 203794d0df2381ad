// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/from_line.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {

FromLine fromLine(const std::vector<Vec<2>>& line, const Vec<2>& position)
{
	const int  last     = int(line.size()) - 2;
	const bool isClosed = line.front() == line.back();
	FromLine   at;
	for (int i = 0; i <= last; ++i) {
		const Vec<2> along = line[i + 1] - line[i], from = position - line[i];
		const double part = from.dot(along) / along.squaredNorm(), length = along.norm();
		const Vec<2> on   = std::clamp(part, 0., 1.) * along;
		const double away = (from - on).norm(), left = (along[0] * from[1] - along[1] * from[0]) / length, same = 1e-9 * length;
		if (away > at.away + same) continue;
		const bool isNearest = away < at.away - same;
		at.side              = isNearest ? left : at.side + left;
		at.isBeyond          = !isClosed && ((i == 0 && part < 0) || (i == last && part > 1));
		at.away              = std::min(at.away, away);
		if (isNearest) at.foot = line[i] + on, at.normal = Vec<2>(-along[1], along[0]) / length, at.left = left;
	}
	return at;
}

} // namespace gimpm
