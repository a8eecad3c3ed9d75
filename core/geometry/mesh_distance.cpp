#include "core/geometry/mesh_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <vector>

#include "core/error.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

/// Nearest point of a triangle and the feature it lies on: 0..2 a corner, 3..5 the edge after corner i - 3, 6 the
/// face (Ericson, Real-Time Collision Detection, 5.1.5).
struct OnTriangle {
  Vector3d point;
  int feature;
};

OnTriangle nearestOnTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, 0};
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {a + d1 / (d1 - d3) * ab, 3};
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {a + d2 / (d2 - d6) * ac, 5};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), 4};
  const double scale = 1 / (va + vb + vc);
  return {a + ab * (vb * scale) + ac * (vc * scale), 6};
}

struct Box {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void include(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  double squaredDistance(const Vector3d& p) const { return (low - p).cwiseMax(p - high).cwiseMax(0).squaredNorm(); }
  bool contains(const Vector3d& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};

struct Face {
  std::array<Vector3d, 3> corner;
  std::array<Vector3d, 7> pseudonormal;  ///< by feature, not normalised
  Box box() const {
    return {corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]), corner[0].cwiseMax(corner[1]).cwiseMax(corner[2])};
  }
};

using Triangle = std::array<std::int32_t, 3>;

/// Triangles of each connected piece.
std::vector<std::vector<Triangle>> connectedPieces(const TriangleMesh& mesh) {
  std::vector<std::int32_t> root(mesh.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    root[find(b)] = find(a);
    root[find(c)] = find(a);
  }
  std::map<std::int32_t, std::vector<Triangle>> by_root;
  for (const auto& t : mesh.triangles) by_root[find(t[0])].push_back(t);
  std::vector<std::vector<Triangle>> pieces;
  for (auto& [key, triangles] : by_root) pieces.push_back(std::move(triangles));
  return pieces;
}

std::vector<Face> facesOf(const std::vector<Vector3d>& vertices, const std::vector<Triangle>& triangles) {
  std::map<std::int32_t, Vector3d> at_corner;
  std::map<std::pair<std::int32_t, std::int32_t>, Vector3d> at_edge;
  const auto edge = [](std::int32_t a, std::int32_t b) { return std::pair{std::min(a, b), std::max(a, b)}; };
  std::vector<Face> faces;
  for (const auto& t : triangles) {
    Face face{{vertices[t[0]], vertices[t[1]], vertices[t[2]]}, {}};
    const Vector3d cross = (face.corner[1] - face.corner[0]).cross(face.corner[2] - face.corner[0]);
    const Vector3d normal = cross.norm() > 0 ? Vector3d{cross.normalized()} : Vector3d::Zero();
    face.pseudonormal[6] = normal;
    for (int i = 0; i < 3; ++i) {
      const Vector3d u = face.corner[(i + 1) % 3] - face.corner[i], v = face.corner[(i + 2) % 3] - face.corner[i];
      const double angle_rad = std::atan2(u.cross(v).norm(), u.dot(v));
      at_corner.try_emplace(t[i], Vector3d::Zero()).first->second += angle_rad * normal;
      at_edge.try_emplace(edge(t[i], t[(i + 1) % 3]), Vector3d::Zero()).first->second += normal;
    }
    faces.push_back(face);
  }
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      const auto& t = triangles[f];
      faces[f].pseudonormal[i] = at_corner[t[i]];
      faces[f].pseudonormal[3 + i] = at_edge[edge(t[i], t[(i + 1) % 3])];
    }
  return faces;
}

}  // namespace

/// Faces ordered so that every node of the implicit binary tree is a contiguous run.
struct MeshDistance::Piece {
  struct Node {
    Box box;
    int begin, end;             ///< faces
    int left = -1, right = -1;  ///< nodes; leaf if -1
  };
  static constexpr int kLeaf = 4;
  std::vector<Face> faces;
  std::vector<std::array<Vector3d, 3>> corners;  ///< of the faces once more, close together
  std::vector<Node> nodes;

  int build(int begin, int end) {
    const int index = static_cast<int>(nodes.size());
    nodes.push_back({{}, begin, end});
    for (int i = begin; i < end; ++i) nodes[index].box.include(faces[i].box());
    if (end - begin <= kLeaf) return index;
    const Vector3d extent = nodes[index].box.high - nodes[index].box.low;
    int axis = 0;
    extent.maxCoeff(&axis);
    const auto center = [axis](const Face& f) { return f.corner[0][axis] + f.corner[1][axis] + f.corner[2][axis]; };
    const int middle = (begin + end) / 2;
    std::nth_element(faces.begin() + begin, faces.begin() + middle, faces.begin() + end,
                     [&](const Face& a, const Face& b) { return center(a) < center(b); });
    const int left = build(begin, middle), right = build(middle, end);
    nodes[index].left = left;
    nodes[index].right = right;
    return index;
  }

  Nearest nearest(const Vector3d& p) const {
    double best = std::numeric_limits<double>::infinity();
    OnTriangle on{Vector3d::Zero(), 6};
    const Face* face = nullptr;
    struct Waiting {
      int node;
      double squared;  // distance of its box
    };
    std::array<Waiting, 64> stack;
    int top = 0;
    stack[top++] = {0, 0};
    while (top > 0) {
      const Waiting next = stack[--top];
      if (next.squared >= best) continue;
      const Node& node = nodes[next.node];
      if (node.left < 0) {
        for (int i = node.begin; i < node.end; ++i) {
          const OnTriangle candidate = nearestOnTriangle(p, corners[i][0], corners[i][1], corners[i][2]);
          const double squared = (candidate.point - p).squaredNorm();
          if (squared < best) best = squared, on = candidate, face = &faces[i];
        }
        continue;
      }
      Waiting near{node.left, nodes[node.left].box.squaredDistance(p)};
      Waiting far{node.right, nodes[node.right].box.squaredDistance(p)};
      if (near.squared > far.squared) std::swap(near, far);
      if (far.squared < best) stack[top++] = far;
      if (near.squared < best) stack[top++] = near;
    }
    const Vector3d normal = face->pseudonormal[on.feature].normalized();
    const double sign = (p - on.point).dot(face->pseudonormal[on.feature]) < 0 ? -1 : 1;
    return {sign * std::sqrt(best), on.point, normal};
  }
};

MeshDistance::MeshDistance(const TriangleMesh& mesh) {
  require(!mesh.triangles.empty(), "MeshDistance: the mesh has triangles");
  for (const auto& triangles : connectedPieces(mesh)) {
    Piece piece{facesOf(mesh.vertices, triangles), {}, {}};
    piece.nodes.reserve(piece.faces.size());
    piece.build(0, static_cast<int>(piece.faces.size()));
    for (const Face& face : piece.faces) piece.corners.push_back(face.corner);
    (signedVolume_m3({mesh.vertices, triangles}) < 0 ? cavities_ : pieces_).push_back(std::move(piece));
  }
}
MeshDistance::~MeshDistance() = default;
MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;

MeshDistance::Nearest MeshDistance::nearest(const Vector3d& p) const {
  Nearest best;
  for (const Piece& piece : pieces_) {
    const double gap = std::sqrt(piece.nodes[0].box.squaredDistance(p));
    if (gap > 0 && gap >= best.distance_m) continue;  // neither inside it nor closer
    const Nearest candidate = piece.nearest(p);
    if (candidate.distance_m < best.distance_m) best = candidate;
  }
  for (const Piece& cavity : cavities_) {  // what is solid lies outside all of them
    const double gap = std::sqrt(cavity.nodes[0].box.squaredDistance(p));
    if (gap > 0 && -gap <= best.distance_m) continue;
    const Nearest candidate = cavity.nearest(p);
    if (candidate.distance_m > best.distance_m) best = candidate;
  }
  return best;
}

double MeshDistance::depth_m(const Vector3d& p) const {
  const bool near = std::ranges::any_of(pieces_, [&](const Piece& piece) { return piece.nodes[0].box.contains(p); });
  return near ? std::max(0.0, -nearest(p).distance_m) : 0;
}

}  // namespace sinew
