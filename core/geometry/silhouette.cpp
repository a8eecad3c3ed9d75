#include "core/geometry/silhouette.h"

#include <cstdint>
#include <optional>
#include <unordered_map>

namespace sinew {
namespace {

using EdgeKey = std::uint64_t;
EdgeKey edgeKey(std::int32_t a, std::int32_t b) {
  if (a > b) std::swap(a, b);
  return EdgeKey(std::uint32_t(a)) << 32 | std::uint32_t(b);
}

/// Crossing of the contour with one mesh edge: where it is, and the one or two crossings it continues to.
struct Crossing {
  Eigen::Vector3d p_W;
  int next[2] = {-1, -1};
  int degree = 0;
  bool used = false;
};

/// The graph of crossings; a triangle whose corners face differently joins two of them.
class ContourGraph {
 public:
  ContourGraph(const std::vector<Eigen::Vector3d>& p_W, const std::vector<double>& facing)
      : p_W_{p_W}, facing_{facing} {}

  void addTriangle(const std::array<std::int32_t, 3>& t) {
    int found[2], count = 0;
    for (int k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      if ((facing_[a] < 0) != (facing_[b] < 0)) found[count++] = crossing(a, b);
    }
    if (count != 2) return;
    join(found[0], found[1]);
    join(found[1], found[0]);
  }

  /// Open chains first (an open mesh has some), then loops.
  std::vector<std::vector<Eigen::Vector3d>> chains() {
    std::vector<std::vector<Eigen::Vector3d>> all;
    for (int wanted_degree : {1, 2})
      for (int i = 0; i < int(crossings_.size()); ++i)
        if (!crossings_[i].used && crossings_[i].degree == wanted_degree) all.push_back(follow(i));
    return all;
  }

 private:
  int crossing(std::int32_t a, std::int32_t b) {
    const auto [it, fresh] = index_.try_emplace(edgeKey(a, b), int(crossings_.size()));
    if (fresh) {
      const double s = facing_[a] / (facing_[a] - facing_[b]);
      crossings_.push_back({.p_W = p_W_[a] + s * (p_W_[b] - p_W_[a])});
    }
    return it->second;
  }
  void join(int from, int to) {
    Crossing& c = crossings_[from];
    if (c.degree < 2) c.next[c.degree++] = to;
  }
  std::vector<Eigen::Vector3d> follow(int start) {
    std::vector<Eigen::Vector3d> line;
    int at = start;
    while (at >= 0 && !crossings_[at].used) {
      Crossing& c = crossings_[at];
      c.used = true;
      line.push_back(c.p_W);
      at = -1;
      for (const int n : c.next)
        if (n >= 0 && !crossings_[n].used) at = n;
    }
    if (crossings_[start].degree == 2 && line.size() > 2) line.push_back(line.front());
    return line;
  }

  const std::vector<Eigen::Vector3d>& p_W_;
  const std::vector<double>& facing_;
  std::vector<Crossing> crossings_;
  std::unordered_map<EdgeKey, int> index_;
};

std::optional<ImageLine> projected(const std::vector<Eigen::Vector3d>& line_W, const View& view) {
  ImageLine line;
  line.reserve(line_W.size());
  for (const auto& p_W : line_W) {
    const auto uv_px = project(view, p_W);
    if (!uv_px) return std::nullopt;
    line.push_back(*uv_px);
  }
  return line;
}

Eigen::Vector3d rayDirection_C(const ConeBeam&, const Eigen::Vector3d& p_C) {
  return p_C;
}
Eigen::Vector3d rayDirection_C(const SlotScan& s, const Eigen::Vector3d& p_C) {
  return {p_C.x(), 0, p_C.z() + s.source_to_isocenter_m};  // the source travels with the slot
}
Eigen::Vector3d rayDirection_C(const Orthographic&, const Eigen::Vector3d&) {
  return Eigen::Vector3d::UnitZ();
}

}  // namespace

Eigen::Vector3d rayDirectionAt(const View& view, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d p_C = view.R_CW * p_W + view.p_CW;
  const Eigen::Vector3d d_C = std::visit([&](const auto& p) { return rayDirection_C(p, p_C); }, view.projection);
  return view.R_CW.transpose() * d_C.normalized();
}

std::vector<ImageLine> silhouette(const TriangleMesh& mesh, const RigidTransform& X_WB, const View& view,
                                  double min_length_px) {
  const auto normals = vertexNormals(mesh);
  std::vector<Eigen::Vector3d> p_W(mesh.vertices.size());
  std::vector<double> facing(mesh.vertices.size());
  for (std::size_t i = 0; i < p_W.size(); ++i) {
    p_W[i] = X_WB * mesh.vertices[i];
    facing[i] = (X_WB.linear() * normals[i]).dot(rayDirectionAt(view, p_W[i]));
  }
  ContourGraph graph{p_W, facing};
  for (const auto& t : mesh.triangles) graph.addTriangle(t);

  std::vector<ImageLine> lines;
  for (const auto& chain : graph.chains())
    if (auto line = projected(chain, view); line && line->size() > 1 && lengthOf(*line) >= min_length_px)
      lines.push_back(std::move(*line));
  return lines;
}

double lengthOf(const ImageLine& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

}  // namespace sinew
