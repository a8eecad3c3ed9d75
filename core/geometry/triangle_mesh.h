#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace sinew {

/// Closed surface of one bone in the frame of its segment, metres; triangles counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Enclosed volume by the divergence theorem [m^3]; positive if the triangles face outwards.
double signedVolume_m3(const TriangleMesh& mesh);

/// Area-weighted vertex normals, outwards, unit length.
std::vector<Eigen::Vector3d> vertexNormals(const TriangleMesh& mesh);

/// Every edge belongs to exactly two triangles, which run along it in opposite directions.
bool isWatertight(const TriangleMesh& mesh);

}  // namespace sinew
