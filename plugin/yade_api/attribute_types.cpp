// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/attribute.hpp"

namespace yade {

template class AttributeOf<bool>;
template class AttributeOf<int>;
template class AttributeOf<Real>;
template class AttributeOf<string>;
template class AttributeOf<Vector3r>;
template class AttributeOf<vector<Real>>;
template class AttributeOf<vector<string>>;
template class AttributeOf<vector<Vector3r>>;
template class AttributeOf<vector<vector<int>>>;
template class AttributeOf<vector<std::pair<Real, Real>>>;
template class AttributeOf<vector<std::pair<string, Real>>>;

} // namespace yade
