// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/vtkFiles.hpp"
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace yade {

namespace {
	namespace fs = std::filesystem;

	[[noreturn]] void refuse(const string& path, const string& why) { throw std::runtime_error("cannot write file " + path + ": " + why + "."); }

	// VTK's writer does not report all failures, but after one nothing more is written.
	bool isComplete(const string& path)
	{
		const string  end = "</VTKFile>\n";
		string        found(end.size(), ' ');
		std::ifstream file(path, std::ios::binary);
		file.seekg(-std::streamoff(end.size()), std::ios::end);
		return file.read(found.data(), found.size()) && found == end;
	}

	// VTK prints what fails, as long as this does not exist.
	class QuietVtk {
		const int before = vtkObject::GetGlobalWarningDisplay();

	public:
		QuietVtk() { vtkObject::GlobalWarningDisplayOff(); }
		QuietVtk(const QuietVtk&) = delete;
		~QuietVtk() { vtkObject::SetGlobalWarningDisplay(before); }
	};

	// Why a file has not been finished, found by writing more to it: who has failed to may have removed its name,
	// as VTK does, and not say why.
	string whyIncomplete(std::ofstream& file)
	{
		const vector<char> more(1 << 16);
		errno = 0;
		file.seekp(0, std::ios::end).write(more.data(), more.size()).flush();
		return !file && errno ? std::strerror(errno) : "writing failed";
	}

	// Calls write(temporary path). A failure leaves an earlier file of this name as it was.
	template <class Write> void writeWhole(const string& path, Write write)
	{
		const string    temporary = path + ".part";
		std::error_code error;
		if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) fs::create_directories(folder, error);
		if (error) refuse(path, "its folder cannot be created (" + error.message() + ")");
		errno = 0;
		std::ofstream held(temporary);
		if (!held) refuse(path, std::strerror(errno));
		write(temporary);
		if (isComplete(temporary)) {
			fs::rename(temporary, path, error);
			if (!error) return;
		}
		const string why = error ? error.message() : whyIncomplete(held);
		fs::remove(temporary, error);
		refuse(path, why);
	}

	string inXml(const string& text)
	{
		string escaped;
		for (const char c : text) {
			if (c == '&') escaped += "&amp;";
			else if (c == '<')
				escaped += "&lt;";
			else if (c == '"')
				escaped += "&quot;";
			else
				escaped += c;
		}
		return escaped;
	}

	// the shortest text that reads back as the same number
	string exactly(Real number)
	{
		char digits[32];
		return string(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
	}
}

void writeVtu(vtkUnstructuredGrid& cells, Real time, const string& path, VtkFormat format)
{
	vtkNew<vtkDoubleArray> timeValue;
	timeValue->SetName("TimeValue"); // the name by which VTK's reader finds it
	timeValue->InsertNextValue(time);
	cells.GetFieldData()->AddArray(timeValue);

	vtkNew<vtkXMLUnstructuredGridWriter> writer;
	writer->SetInputData(&cells);
	if (format.ascii) writer->SetDataModeToAscii();
	else {
		writer->SetDataModeToAppended();
		writer->EncodeAppendedDataOff();
	}
	if (format.compress) {
		writer->SetCompressorTypeToLZ4();
		writer->SetCompressionLevel(1);
	} else
		writer->SetCompressorTypeToNone();
	writeWhole(path, [&](const string& temporary) {
		writer->SetFileName(temporary.c_str());
		const QuietVtk quiet; // readers of the exception need no words of VTK before it
		writer->Write();
	});
}

string pieceOf(const string& path, int process) { return fs::path(path).replace_extension("").string() + "-" + std::to_string(process) + ".vtu"; }

void writePvtu(vtkUnstructuredGrid& piece, Real time, const string& path, int pieces)
{
	writeWhole(path, [&](const string& temporary) {
		std::ofstream file(temporary);
		file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
		     << "<PUnstructuredGrid GhostLevel=\"0\">\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
		     << exactly(time)
		     << "</DataArray>\n</FieldData>\n<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n"
		     << "<PCellData>\n";
		for (int a = 0; a < piece.GetCellData()->GetNumberOfArrays(); ++a) {
			vtkDataArray& array = *piece.GetCellData()->GetArray(a);
			file << "<PDataArray type=\"" << (array.GetDataType() == VTK_INT ? "Int32" : "Float64") << "\" Name=\"" << array.GetName()
			     << "\" NumberOfComponents=\"" << array.GetNumberOfComponents() << "\"/>\n";
		}
		file << "</PCellData>\n";
		for (int process = 0; process < pieces; ++process)
			file << "<Piece Source=\"" << inXml(fs::path(pieceOf(path, process)).filename()) << "\"/>\n";
		file << "</PUnstructuredGrid>\n</VTKFile>\n";
	});
}

void writePvd(const Series& series, const string& path)
{
	writeWhole(path, [&](const string& temporary) {
		std::ofstream file(temporary);
		file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
		for (const auto& [member, time] : series)
			file << "<DataSet timestep=\"" << exactly(time) << "\" part=\"0\" file=\"" << inXml(fs::path(member).filename()) << "\"/>\n";
		file << "</Collection>\n</VTKFile>\n";
	});
}

} // namespace yade
