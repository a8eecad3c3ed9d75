#include "core/geometry/mesh_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
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
  void include(const Vector3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double squaredDistance(const Vector3d& p) const {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double beyond = std::max({low[i] - p[i], p[i] - high[i], 0.0});
      sum += beyond * beyond;
    }
    return sum;
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

/// Triangles of one connected piece, by its own corners.
struct Patch {
  std::vector<std::int32_t> vertices;  ///< of the mesh, by corner
  std::vector<Triangle> faces;
  std::vector<int> around, first_around;  ///< faces that meet in each corner, in the mesh's order
};

Patch patchOf(const std::vector<Triangle>& triangles, std::vector<std::int32_t>& corner_of) {
  Patch patch;
  for (const Triangle& t : triangles) {
    Triangle& face = patch.faces.emplace_back();
    for (int i = 0; i < 3; ++i) {
      auto& corner = corner_of[static_cast<std::size_t>(t[i])];
      if (corner < 0) {
        corner = static_cast<std::int32_t>(patch.vertices.size());
        patch.vertices.push_back(t[i]);
      }
      face[i] = corner;
    }
  }
  patch.first_around.assign(patch.vertices.size() + 1, 0);
  for (const Triangle& face : patch.faces)
    for (const auto corner : face) ++patch.first_around[static_cast<std::size_t>(corner) + 1];
  std::partial_sum(patch.first_around.begin(), patch.first_around.end(), patch.first_around.begin());
  std::vector<int> next = patch.first_around;
  patch.around.resize(3 * patch.faces.size());
  for (std::size_t f = 0; f < patch.faces.size(); ++f)
    for (const auto corner : patch.faces[f])
      patch.around[static_cast<std::size_t>(next[static_cast<std::size_t>(corner)]++)] = static_cast<int>(f);
  return patch;
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
  /// What does not change when the corners move.
  struct Topology {
    Patch patch;
    std::vector<Triangle> faces;  ///< of the patch, in the order of the tree
  };
  std::shared_ptr<const Topology> topology;
  std::vector<Vector3d> corners;  ///< of the patch
  std::vector<Node> nodes;

  Piece(Patch patch, const std::vector<Vector3d>& vertices) {
    auto made = std::make_shared<Topology>();
    made->patch = std::move(patch);
    std::vector<int> order(made->patch.faces.size());
    std::iota(order.begin(), order.end(), 0);
    nodes.reserve(order.size());
    std::vector<Vector3d> middle;
    for (const Triangle& face : made->patch.faces) {
      const auto at = [&](int i) { return vertices[static_cast<std::size_t>(made->patch.vertices[face[i]])]; };
      middle.push_back(at(0) + at(1) + at(2));
    }
    build(order, middle, 0, static_cast<int>(order.size()));
    for (const int f : order) made->faces.push_back(made->patch.faces[static_cast<std::size_t>(f)]);
    topology = std::move(made);
    moveTo(vertices);
  }

  /// The tree, its boxes still empty.
  int build(std::vector<int>& order, const std::vector<Vector3d>& middle, int begin, int end) {
    const int index = static_cast<int>(nodes.size());
    nodes.push_back({{}, begin, end});
    if (end - begin <= kLeaf) return index;
    Box extent;
    for (int i = begin; i < end; ++i) extent.include(middle[order[i]]);
    int axis = 0;
    (extent.high - extent.low).maxCoeff(&axis);
    const int half = (begin + end) / 2;
    std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end,
                     [&](int a, int b) { return middle[a][axis] < middle[b][axis]; });
    const int left = build(order, middle, begin, half), right = build(order, middle, half, end);
    nodes[index].left = left;
    nodes[index].right = right;
    return index;
  }

  /// Corners and boxes; a node comes before its children.
  void moveTo(const std::vector<Vector3d>& vertices) {
    const std::vector<std::int32_t>& from = topology->patch.vertices;
    corners.resize(from.size());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = vertices[static_cast<std::size_t>(from[i])];
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
      node->box = {};
      if (node->left >= 0) {
        node->box.include(nodes[node->left].box);
        node->box.include(nodes[node->right].box);
      } else {
        for (int i = node->begin; i < node->end; ++i)
          for (const auto corner : topology->faces[i]) node->box.include(corners[corner]);
      }
    }
  }

  Vector3d normalOf(const Triangle& face) const {
    const Vector3d cross = (corners[face[1]] - corners[face[0]]).cross(corners[face[2]] - corners[face[0]]);
    return cross.norm() > 0 ? Vector3d{cross.normalized()} : Vector3d::Zero();
  }

  /// Not normalised; `feature` of the i-th face of the tree.
  Vector3d pseudonormal(int i, int feature) const {
    const Patch& patch = topology->patch;
    const Triangle& face = topology->faces[i];
    if (feature == 6) return normalOf(face);
    const std::int32_t corner = face[feature % 3], other = face[(feature + 1) % 3];
    Vector3d sum = Vector3d::Zero();
    for (int k = patch.first_around[corner]; k < patch.first_around[corner + 1]; ++k) {
      const Triangle& neighbour = patch.faces[patch.around[k]];
      if (feature >= 3) {
        if (std::ranges::count(neighbour, other)) sum += normalOf(neighbour);
        continue;
      }
      const auto c = std::ranges::find(neighbour, corner) - neighbour.begin();
      const Vector3d u = corners[neighbour[(c + 1) % 3]] - corners[corner],
                     v = corners[neighbour[(c + 2) % 3]] - corners[corner];
      sum += std::atan2(u.cross(v).norm(), u.dot(v)) * normalOf(neighbour);
    }
    return sum;
  }

  Nearest nearest(const Vector3d& p) const {
    double best = std::numeric_limits<double>::infinity();
    OnTriangle on{Vector3d::Zero(), 6};
    int face = 0;
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
          const OnTriangle candidate = nearestOnTriangle(
              p, corners[topology->faces[i][0]], corners[topology->faces[i][1]], corners[topology->faces[i][2]]);
          const double squared = (candidate.point - p).squaredNorm();
          if (squared < best) best = squared, on = candidate, face = i;
        }
        continue;
      }
      Waiting near{node.left, nodes[node.left].box.squaredDistance(p)};
      Waiting far{node.right, nodes[node.right].box.squaredDistance(p)};
      if (near.squared > far.squared) std::swap(near, far);
      if (far.squared < best) stack[top++] = far;
      if (near.squared < best) stack[top++] = near;
    }
    const Vector3d outwards = pseudonormal(face, on.feature);
    const double sign = (p - on.point).dot(outwards) < 0 ? -1 : 1;
    return {sign * std::sqrt(best), on.point, outwards.normalized()};
  }
};

MeshDistance::MeshDistance(const TriangleMesh& mesh) {
  require(!mesh.triangles.empty(), "MeshDistance: the mesh has triangles");
  std::vector<std::int32_t> corner_of(mesh.vertices.size(), -1);
  for (const auto& triangles : connectedPieces(mesh))
    (signedVolume_m3({mesh.vertices, triangles}) < 0 ? cavities_ : pieces_)
        .emplace_back(patchOf(triangles, corner_of), mesh.vertices);
}

MeshDistance MeshDistance::movedTo(const std::vector<Vector3d>& vertices) const {
  MeshDistance moved;
  moved.pieces_ = pieces_;
  moved.cavities_ = cavities_;
  for (auto* pieces : {&moved.pieces_, &moved.cavities_})
    for (Piece& piece : *pieces) piece.moveTo(vertices);
  return moved;
}

MeshDistance::MeshDistance() = default;
MeshDistance::~MeshDistance() = default;
MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;

Vector3d MeshDistance::Nearest::outward(const Vector3d& p) const {
  constexpr double kTouching_m = 1e-9;
  return std::abs(distance_m) < kTouching_m ? normal : Vector3d{(p - point) / distance_m};
}

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

double MeshDistance::distanceAtLeast_m(const Vector3d& p) const {
  double squared = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces_) squared = std::min(squared, piece.nodes[0].box.squaredDistance(p));
  return squared > 0 ? std::sqrt(squared) : nearest(p).distance_m;
}

double MeshDistance::depth_m(const Vector3d& p) const {
  return std::max(0.0, -distanceAtLeast_m(p));
}

}  // namespace sinew
