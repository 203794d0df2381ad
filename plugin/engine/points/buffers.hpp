// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Memory shared with Python.
#include "yade_api/yade_api.hpp"

namespace yade {

// Read access to the memory of a NumPy array, or of any contiguous buffer, for the time of this object's life.
template <class T> class Column {
public:
	Column(const py::object& array, const char* name)
	{
		if (PyObject_GetBuffer(array.ptr(), &buffer, PyBUF_C_CONTIGUOUS) != 0) py::throw_error_already_set();
		if (buffer.itemsize == sizeof(T)) return;
		PyBuffer_Release(&buffer);
		throw std::invalid_argument(string(name) + ": items of " + std::to_string(sizeof(T)) + " bytes are needed");
	}
	Column(const Column&) = delete;
	~Column() { PyBuffer_Release(&buffer); }
	size_t   size() const { return buffer.len / sizeof(T); }
	const T* data() const { return static_cast<const T*>(buffer.buf); }

private:
	Py_buffer buffer;
};

} // namespace yade
