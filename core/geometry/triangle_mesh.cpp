#include "core/geometry/triangle_mesh.h"

#include <Eigen/Geometry>
#include <map>

namespace sinew {

double signedVolume_m3(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  return volume;
}

std::vector<Eigen::Vector3d> vertexNormals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d n = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    for (const auto i : {a, b, c}) normals[i] += n;
  }
  for (auto& n : normals) n.normalize();
  return normals;
}

bool isWatertight(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> count;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++count[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, n] : count) {
    const auto opposite = count.find({edge.second, edge.first});
    if (n != 1 || opposite == count.end()) return false;
  }
  return !mesh.triangles.empty();
}

}  // namespace sinew
