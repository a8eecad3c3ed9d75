#include "clinical/synthetic/bone_tissue.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "imaging/xray/xray_attenuation.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

/// Thickness of the compact shell [mm] and share of bone in the spongy inside.
struct Build {
  const char* bone;  ///< beginning of the bone's name
  double shell_at_ends, shell_in_shaft;
  double bone_share;
  bool long_bone;  ///< has a shaft along Y with a marrow cavity
};
// Shafts: cortical thickness at mid-shaft of adults, 6-8 mm femur, 4-6 mm tibia, 3-4 mm fibula and humerus, 2.5-3 mm
// forearm; ends, pelvis, tarsus and vertebrae 0.7-1.5 mm. Bone volume share of the spongy bone 10-30 %.
constexpr Build kBuilds[] = {
    {"femur", 1.3, 6.8, 0.17, true},    {"tibia", 1.2, 5.2, 0.17, true},   {"fibula", 0.9, 3.2, 0.14, true},
    {"humerus", 1.1, 4.0, 0.14, true},  {"ulna", 0.9, 2.8, 0.16, true},    {"radius", 0.9, 2.8, 0.16, true},
    {"patella", 1.3, 1.3, 0.22, false}, {"sacrum", 0.9, 0.9, 0.09, false}, {"vertebra", 0.7, 0.7, 0.13, false},
    {"skull", 2.6, 2.6, 0.30, false},   {"rib", 0.7, 0.7, 0.10, false},    {"", 1.2, 1.2, 0.17, false},
};
const Build& buildOf(std::string_view bone) {
  return *std::find_if(std::begin(kBuilds), std::end(kBuilds),
                       [&](const Build& b) { return bone.starts_with(b.bone); });
}

double smoothStep(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}
/// 0 at the ends, 1 in the middle of the shaft; x runs from the proximal end (0) to the distal one (1).
double shaftWeight(double x) {
  return smoothStep(x, 0.13, 0.42) * (1 - smoothStep(x, 0.62, 0.90));
}

struct Extent {
  double top, bottom;
  double fraction(double y) const { return (top - y) / (top - bottom); }
};
Extent extentOf(const TriangleMesh& mesh) {
  Extent e{-1e9, 1e9};
  for (const auto& p : mesh.vertices) {
    e.top = std::max(e.top, p.y());
    e.bottom = std::min(e.bottom, p.y());
  }
  return e;
}

TriangleMesh innerSurface(const TriangleMesh& mesh, const Build& build) {
  TriangleMesh inner = mesh;
  const auto normals = vertexNormals(mesh);
  const Extent extent = extentOf(mesh);
  for (std::size_t i = 0; i < inner.vertices.size(); ++i) {
    const double shaft = build.long_bone ? shaftWeight(extent.fraction(mesh.vertices[i].y())) : 0;
    const double thickness_mm = build.shell_at_ends + shaft * (build.shell_in_shaft - build.shell_at_ends);
    inner.vertices[i] -= 1e-3 * thickness_mm * normals[i];
  }
  return inner;
}

/// Cross-section of a surface at a fraction of its height: middle and mean radius of the vertices near it.
struct CrossSection {
  Vector3d center = Vector3d::Zero();
  double radius_m = 0;
};
std::optional<CrossSection> crossSection(const TriangleMesh& mesh, const Extent& extent, double fraction) {
  constexpr int kEnough = 10;
  for (double reach = 0.015; reach < 0.1; reach *= 1.5) {
    std::vector<Vector3d> near;
    for (const auto& p : mesh.vertices)
      if (std::abs(extent.fraction(p.y()) - fraction) < reach) near.push_back(p);
    if (int(near.size()) < kEnough) continue;
    CrossSection section;
    for (const auto& p : near) section.center += p / double(near.size());
    for (const auto& p : near)
      section.radius_m += std::hypot(p.x() - section.center.x(), p.z() - section.center.z()) / double(near.size());
    section.center.y() = extent.top - fraction * (extent.top - extent.bottom);
    return section;
  }
  return std::nullopt;
}

/// Closed tube of marrow through the middle of the spongy space, pointed at both ends; nullopt where a shaft has too
/// few vertices. Its axis and radii follow the inner surface.
std::optional<TriangleMesh> marrowCavity(const TriangleMesh& inner) {
  constexpr int kSlices = 30, kAround = 24;
  constexpr double kFrom = 0.20, kTo = 0.82, kShare = 0.9;
  const Extent extent = extentOf(inner);
  std::vector<CrossSection> sections;
  for (int s = 0; s < kSlices; ++s) {
    const auto section = crossSection(inner, extent, kFrom + (kTo - kFrom) * (s + 0.5) / kSlices);
    if (!section) return std::nullopt;
    sections.push_back(*section);
  }
  TriangleMesh tube;
  for (int s = 0; s < kSlices; ++s) {
    const auto& [center, radius_m] = sections[std::size_t(s)];
    const double along = (s + 0.5) / kSlices;
    const double taper = std::sqrt(smoothStep(along, 0, 0.25) * (1 - smoothStep(along, 0.75, 1)));
    for (int k = 0; k < kAround; ++k) {
      const double turn = 2 * std::numbers::pi * k / kAround;
      tube.vertices.push_back(center + std::max(kShare * taper * radius_m, 1e-5) *
                                           Vector3d{std::sin(turn), 0, std::cos(turn)});
    }
  }
  const auto ends = std::int32_t(tube.vertices.size());
  tube.vertices.push_back(sections.front().center + 1e-5 * Vector3d::UnitY());
  tube.vertices.push_back(sections.back().center - 1e-5 * Vector3d::UnitY());
  for (std::int32_t k = 0; k < kAround; ++k) {
    const std::int32_t next = (k + 1) % kAround, last = (kSlices - 1) * kAround;
    tube.triangles.push_back({ends, k, next});
    tube.triangles.push_back({ends + 1, last + next, last + k});
    for (std::int32_t ring = 0; ring < last; ring += kAround) {
      tube.triangles.push_back({ring + k, ring + kAround + k, ring + kAround + next});
      tube.triangles.push_back({ring + k, ring + kAround + next, ring + next});
    }
  }
  return tube;
}

void transform(TriangleMesh& mesh, const RigidTransform& X) {
  for (auto& p : mesh.vertices) p = X * p;
}

}  // namespace

TriangleMesh smoothlySubdivided(const TriangleMesh& mesh) {
  TriangleMesh fine{mesh.vertices, {}};
  const auto normals = vertexNormals(mesh);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle_of;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [entry, is_new] = middle_of.try_emplace(std::minmax(a, b), std::int32_t(fine.vertices.size()));
    if (is_new) {
      const Vector3d &p = mesh.vertices[std::size_t(a)], &q = mesh.vertices[std::size_t(b)];
      const Vector3d &m = normals[std::size_t(a)], &n = normals[std::size_t(b)];
      const double limit_m = 0.07 * (q - p).norm();  // at creases the normals say little
      const double sagitta_m = std::clamp((q - p).dot(n - m) / 8, -limit_m, limit_m);
      const Vector3d across = m + n;
      fine.vertices.push_back((p + q) / 2 + sagitta_m * across / std::max(across.norm(), 1e-6));
    }
    return entry->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.push_back({a, ab, ca});
    fine.triangles.push_back({ab, b, bc});
    fine.triangles.push_back({ca, bc, c});
    fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

BoneTissue boneTissue(const BoneMesh& bone, const RigidTransform& X_WB) {
  if (bone.bone.starts_with("costal_cartilage")) return {};  // as dense as muscle
  const Build& build = buildOf(bone.bone);
  TriangleMesh outer = smoothlySubdivided(bone.mesh);
  TriangleMesh inner = innerSurface(outer, build);
  std::optional<TriangleMesh> cavity;
  if (build.long_bone) cavity = marrowCavity(inner);
  transform(outer, X_WB);
  transform(inner, X_WB);

  const double spongy_per_m = spongyAttenuation_per_m(build.bone_share);
  BoneTissue tissue;
  tissue.volumes.push_back({std::move(outer), kCorticalBoneAttenuation_per_m - kMuscleAttenuation_per_m});
  tissue.volumes.push_back({inner, spongy_per_m - kCorticalBoneAttenuation_per_m});
  if (cavity) {
    transform(*cavity, X_WB);
    tissue.volumes.push_back({std::move(*cavity), kFatAttenuation_per_m - spongy_per_m});
  }
  tissue.spongy_W = std::move(inner);
  return tissue;
}

}  // namespace sinew
