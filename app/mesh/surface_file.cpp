#include "app/mesh/surface_file.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/error.h"

namespace sinew {
namespace {

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

/// Collects what VTK complains about instead of letting it print.
class Complaints {
 public:
  explicit Complaints(vtkObject& source) {
    command_->SetClientData(&text_);
    command_->SetCallback([](vtkObject*, unsigned long, void* client, void* data) {
      auto& text = *static_cast<std::string*>(client);
      if (text.empty() && data) text = static_cast<const char*>(data);
    });
    source.AddObserver(vtkCommand::ErrorEvent, command_);
  }
  bool none() const { return text_.empty(); }

 private:
  vtkNew<vtkCallbackCommand> command_;
  std::string text_;
};

template <class Reader>
vtkSmartPointer<vtkPolyData> readWith(const std::filesystem::path& file) {
  vtkNew<Reader> reader;
  const Complaints complaints{*reader};
  reader->SetFileName(file.c_str());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  reader->Update();
  if (!complaints.none() || !reader->GetOutput() || reader->GetOutput()->GetNumberOfCells() == 0)
    throw InputError{{file.filename().string(), "", "a readable " + endingOf(file) + " surface",
                      complaints.none() ? "no polygons" : "damaged content"}};
  triangles->SetInputConnection(reader->GetOutputPort());
  triangles->Update();
  return triangles->GetOutput();
}

vtkSmartPointer<vtkPolyData> readPolygons(const std::filesystem::path& file) {
  const std::string ending = endingOf(file);
  if (ending == ".stl") return readWith<vtkSTLReader>(file);
  if (ending == ".ply") return readWith<vtkPLYReader>(file);
  if (ending == ".obj") return readWith<vtkOBJReader>(file);
  if (ending == ".vtp") return readWith<vtkXMLPolyDataReader>(file);
  throw InputError{
      {file.filename().string(), "", "a name that ends in .stl, .ply, .obj or .vtp", "'" + ending + "'"}};
}

}  // namespace

const std::vector<std::string>& surfaceFileEndings() {
  static const std::vector<std::string> endings{".stl", ".ply", ".obj", ".vtp"};
  return endings;
}

bool isSurfaceFile(const std::filesystem::path& file) {
  return std::ranges::count(surfaceFileEndings(), endingOf(file)) > 0;
}

TriangleMesh readSurfaceFile(const std::filesystem::path& file, double unit_m) {
  require(unit_m > 0, "readSurfaceFile: a positive unit");
  if (!std::filesystem::is_regular_file(file))
    throw InputError{{file.string(), "", "a surface file", "no such file"}};
  const auto data = readPolygons(file);
  TriangleMesh mesh;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    const double* p = data->GetPoint(i);
    mesh.vertices.push_back(unit_m * Eigen::Vector3d{p[0], p[1], p[2]});
    if (!mesh.vertices.back().allFinite())
      throw InputError{{file.filename().string(), "point " + std::to_string(i), "finite coordinates", "others"}};
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    data->GetCellPoints(c, ids);
    if (ids->GetNumberOfIds() != 3) continue;
    mesh.triangles.push_back({std::int32_t(ids->GetId(0)), std::int32_t(ids->GetId(1)), std::int32_t(ids->GetId(2))});
  }
  if (mesh.triangles.empty()) throw InputError{{file.filename().string(), "", "triangles", "none"}};
  return mesh;
}

}  // namespace sinew
