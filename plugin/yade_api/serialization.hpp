// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Saving and loading in YADE's own format: Eigen types element by element with YADE's XML names, raw in binary
// archives; base classes by the functions compiled into YADE's libraries.
#include "yade_api/yade_api.hpp"

#pragma GCC visibility push(default)
#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>
#include <boost/serialization/export.hpp> // must follow the archives
#include <boost/serialization/is_bitwise_serializable.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector2r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Matrix3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Quaternionr)

namespace boost::serialization {
template <class Archive> void serialize(Archive& archive, yade::Vector3r& vector, unsigned)
{
	archive& make_nvp("x", vector[0]);
	archive& make_nvp("y", vector[1]);
	archive& make_nvp("z", vector[2]);
}
template <class Archive> void serialize(Archive& archive, yade::Matrix3r& matrix, unsigned)
{
	static constexpr const char* names[3][3] = { { "m00", "m01", "m02" }, { "m10", "m11", "m12" }, { "m20", "m21", "m22" } };
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			archive& make_nvp(names[i][j], matrix(i, j));
}
} // namespace boost::serialization

// Only the functions that name the members of a class; the rest of boost's machinery is the same for all.
#define YADE_API_EXTERN_LOAD(Archive, Class)                                                                                                                   \
	extern template void boost::archive::detail::iserializer<boost::archive::Archive, Class>::load_object_data(                                            \
	        boost::archive::detail::basic_iarchive&, void*, unsigned) const;
#define YADE_API_EXTERN_SAVE(Archive, Class)                                                                                                                   \
	extern template void boost::archive::detail::oserializer<boost::archive::Archive, Class>::save_object_data(                                            \
	        boost::archive::detail::basic_oarchive&, const void*) const;
#define YADE_API_EXTERN_SERIALIZERS(Class)                                                                                                                     \
	BOOST_CLASS_EXPORT_KEY(Class)                                                                                                                          \
	YADE_API_EXTERN_LOAD(xml_iarchive, Class)                                                                                                              \
	YADE_API_EXTERN_LOAD(binary_iarchive, Class)                                                                                                           \
	YADE_API_EXTERN_SAVE(xml_oarchive, Class)                                                                                                              \
	YADE_API_EXTERN_SAVE(binary_oarchive, Class)
YADE_API_EXTERN_SERIALIZERS(yade::Serializable)
YADE_API_EXTERN_SERIALIZERS(yade::GlobalEngine)
YADE_API_EXTERN_SERIALIZERS(yade::PeriodicEngine)
YADE_API_EXTERN_SERIALIZERS(yade::Material)
YADE_API_EXTERN_SERIALIZERS(yade::State)
YADE_API_EXTERN_SERIALIZERS(yade::Shape)
YADE_API_EXTERN_SERIALIZERS(yade::Sphere)
#undef YADE_API_EXTERN_SERIALIZERS
#undef YADE_API_EXTERN_SAVE
#undef YADE_API_EXTERN_LOAD
#pragma GCC visibility pop
