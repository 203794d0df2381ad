// SPDX-License-Identifier: GPL-2.0-or-later
// Turns of free bodies in space do not add.
#pragma once
#include "core/terms/contact/contact_free.hpp"

namespace gimpm {

/// Matrix that makes a change of the motion a small displacement and turn of the body as it is.
template <int Dim> typename FreeBody<Dim>::Matrix incrementsOf(const typename FreeBody<Dim>::Vector& motion);
template <> FreeBody<2>::Matrix                   incrementsOf<2>(const FreeBody<2>::Vector& motion);
template <> FreeBody<3>::Matrix                   incrementsOf<3>(const FreeBody<3>::Vector& motion);

} // namespace gimpm
