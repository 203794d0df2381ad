// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Files for ParaView. A file is written under another name and then renamed: what has its final name is complete.
// Missing folders are created. std::runtime_error names the file that cannot be written, and says why.
#include "yade_api/types.hpp"
#include <utility>

class vtkUnstructuredGrid;

namespace yade {

// Paths and times [s] of the states of series.
using Series = vector<std::pair<string, Real>>;

struct VtkFormat {
	bool ascii    = false;
	bool compress = true; // with LZ4, in a tenth of the time of zlib; has no effect on ascii
};

// One state of a series as .vtu, with its time [s].
void writeVtu(vtkUnstructuredGrid&, Real time, const string& path, VtkFormat);

// The .pvtu of one state, of which each of so many processes has written a piece with the same fields: path of the
// piece of a process, and one of the pieces.
void   writePvtu(vtkUnstructuredGrid&, Real time, const string& path, int pieces);
string pieceOf(const string& path, int process);

// The .pvd of a series: paths and times of its files, which are in the same folder.
void writePvd(const Series&, const string& path);

} // namespace yade
