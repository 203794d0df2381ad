// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Types that YADE's interface is made of, in the build of Debian's yade-double (Real = double).

// Eigen comes before the pragma: its symbols keep this library's own (hidden) visibility, so that YADE's differently
// compiled Eigen code and ours never replace one another.
#include <Eigen/Core>
#include <Eigen/Geometry>

// Symbols that are shared with libyade.so must have default visibility: type information, singletons, vtables.
#pragma GCC visibility push(default)
#include <boost/enable_shared_from_this.hpp>
#include <boost/python/class.hpp>
#include <boost/python/def.hpp>
#include <boost/python/dict.hpp>
#include <boost/python/docstring_options.hpp>
#include <boost/python/errors.hpp>
#include <boost/python/extract.hpp>
#include <boost/python/handle.hpp>
#include <boost/python/import.hpp>
#include <boost/python/list.hpp>
#include <boost/python/make_constructor.hpp>
#include <boost/python/make_function.hpp>
#include <boost/python/object.hpp>
#include <boost/python/return_internal_reference.hpp>
#include <boost/python/scope.hpp>
#include <boost/python/slice.hpp>
#include <boost/python/str.hpp>
#include <boost/python/tuple.hpp>
#include <boost/shared_ptr.hpp>
#include <string>
#include <vector>

template <class T> class Singleton { // in the global namespace, as in libyade.so
protected:
	static T* self;

public:
	static T& instance();
};

namespace yade {
namespace py = boost::python;
using boost::shared_ptr;
using std::string;
using std::vector;

using Real        = double;
using Vector2r    = Eigen::Matrix<Real, 2, 1>;
using Vector3r    = Eigen::Matrix<Real, 3, 1>;
using Matrix3r    = Eigen::Matrix<Real, 3, 3>;
using Vector3i    = Eigen::Matrix<int, 3, 1>;
using Quaternionr = Eigen::Quaternion<Real>;

template <class Scalar> struct Se3 {
	Eigen::Matrix<Scalar, 3, 1> position;
	Eigen::Quaternion<Scalar>   orientation;
};
using Se3r = Se3<Real>;

// libyade.so is compiled without alignment requirements beyond those of a double
static_assert(alignof(Quaternionr) == alignof(Real), "compile with EIGEN_MAX_STATIC_ALIGN_BYTES=0: YADE's quaternions are not over-aligned");
} // namespace yade
#pragma GCC visibility pop
