// SPDX-License-Identifier: GPL-2.0-or-later
// Points of other processes that a step needs.
#pragma once
#include "core/stepping/model.hpp"

namespace gimpm {

/// Copies of them behind the own ones of the cloud, as long as this lives; none where points are not divided.
template <int Dim> class Halo {
public:
	Halo(PointCloud<Dim>&, const Model<Dim>&);
	~Halo();
	Halo(const Halo&)            = delete;
	Halo& operator=(const Halo&) = delete;

private:
	PointCloud<Dim>& cloud_;
	Division*        division_;
};

} // namespace gimpm
