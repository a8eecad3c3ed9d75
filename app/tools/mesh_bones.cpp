// Build step: turns the implicit bones of skeleton/bones/ into closed triangle meshes, one file for all.
//   mesh_bones RESOURCE_DIR OUTPUT_FILE [BONE...]
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkSmartPointer.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "core/error.h"
#include "core/geometry/bone_shapes.h"
#include "core/geometry/mesh_io.h"
#include "core/parallel.h"

namespace sinew {
namespace {

constexpr int kBlock = 6;  // voxels; blocks that the surface does not reach are filled with one value

/// Distance sampled on a grid with a margin of three voxels, exact only near the surface.
vtkNew<vtkImageData> sampled(const ImplicitSurface& surface, double voxel_m) {
  const Eigen::Vector3d lower = (surface.lower().array() - 3 * voxel_m).matrix();
  int n[3];
  for (int i = 0; i < 3; ++i)
    n[i] = 7 + static_cast<int>(std::ceil((surface.upper()[i] - surface.lower()[i]) / voxel_m));
  vtkNew<vtkImageData> image;
  image->SetDimensions(n);
  image->SetSpacing(voxel_m, voxel_m, voxel_m);
  image->SetOrigin(lower.data());
  image->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(image->GetScalarPointer());
  const auto position = [&](double x, double y, double z) -> Eigen::Vector3d {
    return lower + voxel_m * Eigen::Vector3d{x, y, z};
  };
  // Elliptic distances may overestimate away from the surface: a safety factor of 2 on the block's half diagonal.
  const double reach_m = 2.0 * kBlock / 2 * std::sqrt(3.0) * voxel_m;
  const auto fillBlock = [&](int i0, int j0, int k0) {
    const double half = (kBlock - 1) / 2.0;
    const double middle = surface.distance(position(i0 + half, j0 + half, k0 + half));
    for (int k = k0; k < std::min(k0 + kBlock, n[2]); ++k)
      for (int j = j0; j < std::min(j0 + kBlock, n[1]); ++j)
        for (int i = i0; i < std::min(i0 + kBlock, n[0]); ++i) {
          double d = std::abs(middle) > reach_m ? middle : surface.distance(position(i, j, k));
          if (std::abs(d) < 1e-3 * voxel_m)
            d = 1e-3 * voxel_m;  // a surface through a grid point makes needle triangles
          values[(static_cast<std::size_t>(k) * n[1] + j) * n[0] + i] = static_cast<float>(d);
        }
  };
  for (int k = 0; k < n[2]; k += kBlock)
    for (int j = 0; j < n[1]; j += kBlock)
      for (int i = 0; i < n[0]; i += kBlock) fillBlock(i, j, k);
  return image;
}

TriangleMesh fromVtk(vtkPolyData& data) {
  TriangleMesh mesh;
  std::vector<std::int32_t> index(static_cast<std::size_t>(data.GetNumberOfPoints()), -1);
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
    vtkNew<vtkIdList> ids;
    data.GetCellPoints(c, ids);
    if (ids->GetNumberOfIds() != 3) continue;
    std::array<std::int32_t, 3> t{};
    for (int i = 0; i < 3; ++i) {  // points that no triangle uses are left behind
      auto& mine = index[static_cast<std::size_t>(ids->GetId(i))];
      if (mine < 0) {
        mine = static_cast<std::int32_t>(mesh.vertices.size());
        double p[3];
        data.GetPoint(ids->GetId(i), p);
        mesh.vertices.emplace_back(p[0], p[1], p[2]);
      }
      t[static_cast<std::size_t>(i)] = mine;
    }
    mesh.triangles.push_back(t);
  }
  if (signedVolume_m3(mesh) < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Closed mesh of one piece with at most about `triangles` triangles.
TriangleMesh meshPiece(const ImplicitSurface& surface, double voxel_m, int triangles) {
  const auto image = sampled(surface, voxel_m);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;  // evens the triangles out; the projection below restores the place
  smooth->SetInputConnection(contour->GetOutputPort());
  smooth->SetNumberOfIterations(12);
  smooth->SetPassBand(0.2);
  smooth->NormalizeCoordinatesOn();
  smooth->Update();
  const auto fine_count = smooth->GetOutput()->GetNumberOfCells();
  vtkNew<vtkQuadricDecimation> decimate;
  decimate->SetInputConnection(smooth->GetOutputPort());
  // Decimation now and then folds a thin blade; a little less of it does not.
  TriangleMesh mesh;
  for (double keep = double(triangles) / double(fine_count); keep < 2; keep *= 1.3) {
    if (keep < 1) {
      decimate->SetTargetReduction(1 - keep);
      decimate->Update();
      mesh = fromVtk(*decimate->GetOutput());
    } else {
      mesh = fromVtk(*smooth->GetOutput());
    }
    if (isWatertight(mesh) || keep >= 1) break;
  }
  for (auto& v : mesh.vertices) {
    const Eigen::Vector3d on_surface = surface.nearestSurfacePoint(v);
    const Eigen::Vector3d step = on_surface - v;
    if (step.norm() < voxel_m) v += 0.8 * step;  // further only at ridges, where the projection is not unique
  }
  return mesh;
}

NamedMesh meshBone(const BoneShape& bone) {
  double total_extent = 0;
  const auto extent = [](const ImplicitSurface& s) {
    const Eigen::Vector3d e = s.upper() - s.lower();
    return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
  };
  for (const auto& piece : bone.pieces) total_extent += extent(piece);
  NamedMesh named{bone.name, bone.segment, {}};
  for (const auto& piece : bone.pieces) {
    const TriangleMesh mesh =
        meshPiece(piece, bone.voxel_m, static_cast<int>(bone.triangles * extent(piece) / total_extent));
    const auto offset = static_cast<std::int32_t>(named.mesh.vertices.size());
    named.mesh.vertices.insert(named.mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& [a, b, c] : mesh.triangles) named.mesh.triangles.push_back({a + offset, b + offset, c + offset});
  }
  if (!isWatertight(named.mesh)) throw InputError{bone.name + ": its mesh is not closed; refine voxel_mm"};
  return named;
}

int run(const std::filesystem::path& resource_dir, const std::filesystem::path& output,
        const std::set<std::string>& only) {
  auto shapes = loadBoneShapes(resource_dir);
  if (!only.empty()) std::erase_if(shapes, [&](const BoneShape& s) { return !only.contains(s.name); });
  std::vector<NamedMesh> meshes(shapes.size());
  forEachInParallel(shapes.size(), {}, "bones", [&](std::size_t i) { meshes[i] = meshBone(shapes[i]); });
  writeMeshes(meshes, output);
  std::size_t triangles = 0;
  for (const auto& mesh : meshes) triangles += mesh.mesh.triangles.size();
  std::printf("%zu bones, %zu triangles\n", meshes.size(), triangles);
  return 0;
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: mesh_bones RESOURCE_DIR OUTPUT_FILE [BONE...]\n");
    return 2;
  }
  try {
    return sinew::run(argv[1], argv[2], {argv + 3, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mesh_bones: %s\n", error.what());
    return 1;
  }
}
