// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/MpmState.hpp"

namespace yade {

bool MpmState::isSymmetric(const Matrix3r& m) { return m.allFinite() && (m - m.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * m.cwiseAbs().maxCoeff(); }

bool MpmState::preservesOrientation(const Matrix3r& m) { return m.allFinite() && m.determinant() > 0; }

void MpmState::requireAdmissible() const
{
	for (const auto& [name, position] : { std::pair { "pos", pos }, std::pair { "refPos", refPos } })
		if (!position.allFinite()) {
			std::ostringstream text;
			text << "MpmState." << name << " = (" << position[0] << ", " << position[1] << ", " << position[2]
			     << ") is not admitted: expected three finite numbers [m].";
			throw std::invalid_argument(text.str());
		}
	ExposedIndexed<MpmState, State>::requireAdmissible();
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmState)
static const yade::PluginClasses<yade::MpmState> registered(__FILE__);
