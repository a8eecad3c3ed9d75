#include "core/geometry/mesh_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "core/error.h"

namespace sinew {
namespace {

using Index = std::int32_t;
using Edge = std::pair<Index, Index>;

/// A use of an edge by a triangle: along its order (from < to) or against it.
struct EdgeUse {
  Edge edge;  ///< smaller vertex first
  Index triangle;
  bool along;
};

/// All uses, those of one edge beside each other.
std::vector<EdgeUse> edgeUses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      uses.push_back({std::minmax(a, b), static_cast<Index>(t), a < b});
    }
  std::ranges::sort(uses, {}, [](const EdgeUse& use) { return std::tuple{use.edge, use.triangle}; });
  return uses;
}

/// Calls `see` with the uses of every edge.
template <class See>
void forEachEdge(const std::vector<EdgeUse>& uses, See see) {
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last = std::find_if(first, uses.end(), [&](const EdgeUse& use) { return use.edge != first->edge; });
    see(first, last);
    first = last;
  }
}

/// A neighbour across an edge, and whether it runs along that edge the contrary way, as it should.
struct Neighbour {
  Index triangle;
  bool agrees;
};

void turn(std::array<Index, 3>& triangle) {
  std::swap(triangle[1], triangle[2]);
}

/// Turns the triangles connected with `start` to its winding. @return the part.
std::vector<Index> alignPart(TriangleMesh& mesh, Index start, const std::vector<std::vector<Neighbour>>& neighbours,
                             std::vector<int>& turned) {
  std::vector<Index> part{start};
  turned[std::size_t(start)] = 0;
  for (std::size_t i = 0; i < part.size(); ++i)
    for (const auto& [next, agrees] : neighbours[std::size_t(part[i])]) {
      const int wish = agrees ? turned[std::size_t(part[i])] : 1 - turned[std::size_t(part[i])];
      int& state = turned[std::size_t(next)];
      if (state < 0) {
        state = wish;
        part.push_back(next);
        if (wish) turn(mesh.triangles[std::size_t(next)]);
      } else if (state != wish) {
        throw InputError{"the surface has one side only (a Moebius strip)"};
      }
    }
  return part;
}

}  // namespace

TriangleMesh welded(const TriangleMesh& mesh) {
  std::vector<Index> order(mesh.vertices.size()), joined(mesh.vertices.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](Index i) {
    const auto& p = mesh.vertices[std::size_t(i)];
    return std::tuple{p.x(), p.y(), p.z(), i};
  };
  std::ranges::sort(order, {}, key);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool repeats = i > 0 && mesh.vertices[std::size_t(order[i])] == mesh.vertices[std::size_t(order[i - 1])];
    joined[std::size_t(order[i])] = repeats ? joined[std::size_t(order[i - 1])] : order[i];
  }
  TriangleMesh result;
  std::vector<Index> place(mesh.vertices.size(), -1);
  for (auto t : mesh.triangles) {
    for (auto& v : t) v = joined[std::size_t(v)];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (auto& v : t) {
      auto& mine = place[std::size_t(v)];
      if (mine < 0) {
        mine = static_cast<Index>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[std::size_t(v)]);
      }
      v = mine;
    }
    result.triangles.push_back(t);
  }
  return result;
}

MeshDefects meshDefects(const TriangleMesh& mesh) {
  MeshDefects defects;
  forEachEdge(edgeUses(mesh), [&](auto first, auto last) {
    if (last - first == 1) ++defects.open_edges;
    if (last - first > 2) ++defects.shared_edges;
    if (last - first == 2 && first->along == std::next(first)->along) ++defects.contrary_edges;
  });
  defects.turned_inside = defects.closed() && defects.contrary_edges == 0 && signedVolume_m3(mesh) < 0;
  return defects;
}

TriangleMesh turnedOutwards(const TriangleMesh& mesh) {
  const MeshDefects defects = meshDefects(mesh);
  require(defects.closed(), "turnedOutwards: the surface is closed");
  TriangleMesh result = mesh;
  if (defects.contrary_edges == 0) {
    if (defects.turned_inside)
      for (auto& t : result.triangles) turn(t);
    return result;
  }
  std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
  forEachEdge(edgeUses(mesh), [&](auto first, auto last) {
    require(last - first == 2, "a closed surface has two triangles at every edge");
    const auto second = std::next(first);
    const bool agrees = first->along != second->along;
    neighbours[std::size_t(first->triangle)].push_back({second->triangle, agrees});
    neighbours[std::size_t(second->triangle)].push_back({first->triangle, agrees});
  });
  std::vector<int> turned(mesh.triangles.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (turned[t] >= 0) continue;
    const std::vector<Index> part = alignPart(result, static_cast<Index>(t), neighbours, turned);
    TriangleMesh alone{result.vertices, {}};
    for (const Index i : part) alone.triangles.push_back(result.triangles[std::size_t(i)]);
    if (signedVolume_m3(alone) < 0)
      for (const Index i : part) turn(result.triangles[std::size_t(i)]);
  }
  return result;
}

}  // namespace sinew
