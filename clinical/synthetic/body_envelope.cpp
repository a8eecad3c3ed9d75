#include "clinical/synthetic/body_envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "core/geometry/isosurface.h"
#include "imaging/xray/xray_attenuation.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

/// One section of a tube: an ellipse across the segment's axis, right side of the reference body [mm].
struct Station {
  const char* segment;                 ///< without side
  double forward, up, right;           ///< centre in the segment's frame
  double half_depth, half_width, fat;  ///< radii of the skin; thickness of the fat below it
  bool across_foot = false;            ///< the section stands upright across the foot; depth is its height
};

// Girths: thigh 56 / 50 cm, knee 37, calf 37, ankle 22, hips 96, waist 82, arm 30, forearm 26, neck 37 (adult men and
// women of normal weight, rounded means of anthropometric surveys); centres so that the bones of the reference
// skeleton lie where palpation finds them: shin, malleoli, patella, trochanter and iliac crest close to the skin.
constexpr Station kLeg[] = {
    {"femur", -8, 40, -2, 90, 82, 18},  {"femur", -8, -20, -2, 92, 84, 16}, {"femur", -6, -100, -4, 88, 82, 13},
    {"femur", 0, -200, 0, 77, 74, 10},  {"femur", 2, -300, 0, 66, 64, 8},   {"femur", 3, -380, 0, 61, 59, 7},
    {"tibia", 5, 2, 0, 63, 57, 6},      {"tibia", -8, -60, 0, 55, 54, 5},   {"tibia", -20, -130, 0, 57, 55, 6},
    {"tibia", -17, -210, 0, 49, 49, 5}, {"tibia", -9, -310, -1, 36, 36, 4}, {"tibia", -7, -380, -1, 37, 34, 3},
    {"tibia", -7, -430, 0, 46, 39, 3},  {"foot", -8, -30, 0, 48, 36, 4},
};
constexpr Station kTrunk[] = {
    {"pelvis", -12, -45, 0, 92, 120, 18}, {"pelvis", -16, 15, 0, 112, 164, 22}, {"pelvis", -8, 85, 0, 113, 163, 20},
    {"lumbar", 32, 45, 0, 112, 148, 20},  {"lumbar", 30, 120, 0, 108, 140, 17}, {"thorax", 14, 10, 0, 112, 146, 12},
    {"thorax", 6, 100, 0, 120, 156, 9},   {"thorax", 0, 180, 0, 106, 150, 8},   {"thorax", -6, 235, 0, 68, 100, 7},
    {"neck", 2, 20, 0, 60, 62, 5},        {"neck", 10, 90, 0, 60, 58, 4},
};
constexpr Station kHead[] = {
    {"head", 20, -20, 0, 75, 64, 4}, {"head", 2, 45, 0, 104, 80, 4}, {"head", -2, 75, 0, 86, 72, 4}};
constexpr Station kArm[] = {
    {"scapula", -45, 0, 90, 55, 50, 8}, {"humerus", 2, -5, 0, 58, 54, 7},   {"humerus", 2, -60, 4, 54, 46, 7},
    {"humerus", 3, -170, 2, 48, 42, 6}, {"humerus", 2, -270, 0, 42, 42, 4}, {"ulna", 0, -20, 4, 44, 44, 4},
    {"ulna", 2, -80, 4, 42, 42, 4},     {"ulna", 2, -180, 2, 32, 34, 3},    {"ulna", 0, -255, 0, 24, 30, 2},
};
constexpr Station kHand[] = {{"hand", 2, 0, 0, 20, 30, 2},
                             {"hand", 4, -60, 0, 19, 42, 2},
                             {"hand", 2, -110, 0, 13, 40, 2},
                             {"hand", 0, -175, 0, 9, 26, 2}};
constexpr Station kFoot[] = {{"foot", -38, -43, 0, 31, 32, 8, true}, {"foot", 5, -32, 0, 43, 36, 4, true},
                             {"foot", 60, -44, 2, 32, 42, 4, true},  {"foot", 115, -57, 2, 19, 48, 4, true},
                             {"foot", 165, -64, 0, 12, 44, 3, true}, {"foot", 190, -66, -4, 9, 34, 2, true}};

/// A section in the world, metres.
struct Section {
  Vector3d center, forward, right;  ///< unit directions of the radii
  double half_depth = 0, half_width = 0;
};

struct Chain {
  std::vector<Section> sections;
  Vector3d lower, upper;  ///< box around the tube
};

/// How much longer the segments of this body are than the reference's.
struct BodySize {
  double femur = 1, tibia = 1, pelvis = 1, lumbar = 1, thorax = 1, neck = 1, humerus = 1, ulna = 1, leg = 1, arm = 1;
};

double offsetOf(const Skeleton& s, const char* joint) {
  return s.joints[std::size_t(s.jointIndex(joint))].X_PJ.translation().norm();
}

BodySize sizeOf(const Skeleton& s, char side) {
  const auto ratio = [&](const std::string& joint, double reference_m) {
    return offsetOf(s, (joint + "_" + side).c_str()) / reference_m;
  };
  BodySize size;
  size.femur = ratio("knee", 0.422);
  size.tibia = ratio("ankle", 0.430);
  size.pelvis = ratio("hip", 0.086);
  size.lumbar = offsetOf(s, "thoracolumbar") / 0.186;
  size.thorax = offsetOf(s, "cervicothoracic") / 0.270;
  size.neck = offsetOf(s, "atlantooccipital") / 0.119;
  size.humerus = ratio("elbow", 0.290);
  size.ulna = ratio("wrist", 0.258);
  size.leg = (size.femur + size.tibia) / 2;
  size.arm = (size.humerus + size.ulna) / 2;
  return size;
}

/// Growth of a station: along its segment, and of its girth.
std::pair<double, double> growth(const BodySize& size, std::string_view segment) {
  if (segment == "femur") return {size.femur, size.leg};
  if (segment == "tibia") return {size.tibia, size.leg};
  if (segment == "foot") return {size.leg, size.leg};
  if (segment == "pelvis") return {size.pelvis, size.pelvis};
  if (segment == "lumbar") return {size.lumbar, size.pelvis};
  if (segment == "thorax") return {size.thorax, size.thorax};
  if (segment == "scapula") return {size.thorax, size.thorax};
  if (segment == "humerus") return {size.humerus, size.arm};
  if (segment == "ulna") return {size.ulna, size.arm};
  if (segment == "hand") return {size.arm, size.arm};
  return {size.neck, size.neck};
}

Section lerp(const Section& a, const Section& b, double t) {
  const double s = t * t * (3 - 2 * t);  // radii without kinks
  return {a.center + t * (b.center - a.center), (a.forward + t * (b.forward - a.forward)).normalized(),
          (a.right + t * (b.right - a.right)).normalized(), a.half_depth + s * (b.half_depth - a.half_depth),
          a.half_width + s * (b.half_width - a.half_width)};
}

class BodyBuilder {
 public:
  BodyBuilder(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB)
      : skeleton_{skeleton}, X_WB_{X_WB}, sizes_{sizeOf(skeleton, 'r'), sizeOf(skeleton, 'l')} {}

  /// Tube through the stations, skin or (`below_fat`) fascia.
  Chain chain(std::span<const Station> stations, char side, bool below_fat) const {
    std::vector<Section> coarse;
    for (const auto& s : stations) coarse.push_back(section(s, side, below_fat));
    Chain chain{{}, Vector3d::Constant(1e9), Vector3d::Constant(-1e9)};
    constexpr int kSteps = 3;
    for (std::size_t i = 0; i + 1 < coarse.size(); ++i)
      for (int k = 0; k < kSteps; ++k) chain.sections.push_back(lerp(coarse[i], coarse[i + 1], double(k) / kSteps));
    chain.sections.push_back(coarse.back());
    for (const auto& s : chain.sections) {
      const Vector3d reach = Vector3d::Constant(std::max(s.half_depth, s.half_width));
      chain.lower = chain.lower.cwiseMin(s.center - reach);
      chain.upper = chain.upper.cwiseMax(s.center + reach);
    }
    return chain;
  }

  RigidTransform pose(const std::string& segment) const {
    return X_WB_[std::size_t(skeleton_.segmentIndex(segment))];
  }

  /// A place given for the right side of the reference body [mm], in the world.
  Vector3d place(const char* segment, char side, const Vector3d& reference_mm) const {
    return section({segment, reference_mm.x(), reference_mm.y(), reference_mm.z(), 1, 1, 0}, side, false).center;
  }

 private:
  Section section(const Station& s, char side, bool below_fat) const {
    const bool midline = s.segment == std::string_view{"pelvis"} || s.segment == std::string_view{"lumbar"} ||
                         s.segment == std::string_view{"thorax"} || s.segment == std::string_view{"neck"} ||
                         s.segment == std::string_view{"head"};
    const auto [along, around] = growth(sizes_[side == 'l'], s.segment);
    const RigidTransform X = pose(midline ? s.segment : std::string{s.segment} + "_" + side);
    const double mirror = side == 'l' ? -1 : 1, fat = below_fat ? s.fat : 0;
    Section out;
    out.center = X * (1e-3 * Vector3d{around * s.forward, along * s.up, mirror * around * s.right});
    out.forward = X.linear().col(s.across_foot ? 1 : 0);
    out.right = X.linear().col(2);
    out.half_depth = 1e-3 * around * (s.half_depth - std::min(fat, 0.6 * s.half_depth));
    out.half_width = 1e-3 * around * (s.half_width - std::min(fat, 0.6 * s.half_width));
    return out;
  }

  const Skeleton& skeleton_;
  const std::vector<RigidTransform>& X_WB_;
  std::array<BodySize, 2> sizes_;  ///< right, left
};

double distanceToBox(const Vector3d& p, const Chain& chain) {
  return (chain.lower - p).cwiseMax(p - chain.upper).cwiseMax(0.0).norm();
}

/// Signed distance to a tube: exact in sign and on the skin, to first order near it.
double distance(const Chain& chain, const Vector3d& p) {
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < chain.sections.size(); ++i) {
    const Section &a = chain.sections[i], &b = chain.sections[i + 1];
    const Vector3d axis = b.center - a.center;
    const double t = std::clamp((p - a.center).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    const Vector3d q = p - a.center - t * axis;
    const double depth = a.half_depth + t * (b.half_depth - a.half_depth);
    const double width = a.half_width + t * (b.half_width - a.half_width);
    const double u = q.dot(a.forward), w = q.dot(a.right), least = std::min(depth, width);
    // What is left over lies past the ends, or off the plane of a section that a bent joint has tilted.
    const double rest2 = std::max(0.0, q.squaredNorm() - u * u - w * w);
    const double k = std::sqrt(u * u / (depth * depth) + w * w / (width * width) + rest2 / (least * least));
    nearest = std::min(nearest, (k - 1) * least);
  }
  return nearest;
}

/// Union with a fillet where the two come closer than `blend_m` (polynomial smooth minimum).
double blended(double a, double b, double blend_m) {
  const double h = std::max(blend_m - std::abs(a - b), 0.0) / blend_m;
  return std::min(a, b) - h * h * blend_m / 4;
}

TriangleMesh skin(const BodyBuilder& builder, bool below_fat, double cell_m) {
  const Chain trunk = builder.chain(kTrunk, 'r', below_fat);
  std::vector<std::vector<Chain>> limbs;  // chains of one limb blend with each other and with the trunk
  limbs.push_back({builder.chain(kHead, 'r', below_fat)});
  for (const char side : {'r', 'l'}) {
    limbs.push_back({builder.chain(kLeg, side, below_fat), builder.chain(kFoot, side, below_fat)});
    limbs.push_back({builder.chain(kArm, side, below_fat), builder.chain(kHand, side, below_fat)});
  }
  Vector3d lower = trunk.lower, upper = trunk.upper;
  for (const auto& limb : limbs)
    for (const auto& chain : limb) {
      lower = lower.cwiseMin(chain.lower);
      upper = upper.cwiseMax(chain.upper);
    }
  constexpr double kBlend_m = 0.03;
  const auto near = [&](const Chain& chain, const Vector3d& p) {
    const double bound = distanceToBox(p, chain);
    return bound > 2 * kBlend_m ? bound : distance(chain, p);
  };
  const auto field = [&](const Vector3d& p) {
    const double body = near(trunk, p);
    double nearest = body;
    for (const auto& limb : limbs) {
      double d = body;
      for (const auto& chain : limb) d = blended(d, near(chain, p), kBlend_m);
      nearest = std::min(nearest, d);
    }
    return nearest;
  };
  return isosurface(field, lower - Vector3d::Constant(0.01), upper + Vector3d::Constant(0.01), cell_m);
}

}  // namespace

TriangleMesh ellipsoidMesh(const RigidTransform& X_WE, const Vector3d& radii_m) {
  constexpr int kRings = 24;
  TriangleMesh mesh;
  const auto add = [&](const Vector3d& unit) {
    mesh.vertices.push_back(X_WE * (unit.array() * radii_m.array()).matrix());
  };
  for (int i = 1; i < kRings; ++i)
    for (int k = 0; k < 2 * kRings; ++k) {
      const double polar = std::numbers::pi * i / kRings, turn = std::numbers::pi * k / kRings;
      add({std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn)});
    }
  add(Vector3d::UnitY());
  add(-Vector3d::UnitY());
  constexpr std::int32_t kAround = 2 * kRings, kTop = (kRings - 1) * kAround, kBottom = kTop + 1;
  for (std::int32_t k = 0; k < kAround; ++k) {
    const std::int32_t next = (k + 1) % kAround, last = (kRings - 2) * kAround;
    mesh.triangles.push_back({kTop, k, next});
    mesh.triangles.push_back({kBottom, last + next, last + k});
    for (std::int32_t ring = 0; ring < last; ring += kAround) {
      mesh.triangles.push_back({ring + k, ring + kAround + k, ring + kAround + next});
      mesh.triangles.push_back({ring + k, ring + kAround + next, ring + next});
    }
  }
  return mesh;
}

std::vector<XrayVolume> softTissues(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB) {
  const BodyBuilder builder{skeleton, X_WB};
  constexpr double kCell_m = 0.009;
  std::vector<XrayVolume> tissues;
  tissues.push_back({skin(builder, false, kCell_m), kFatAttenuation_per_m});
  tissues.push_back({skin(builder, true, kCell_m), kMuscleAttenuation_per_m - kFatAttenuation_per_m});
  const auto addEllipsoid = [&](const char* segment, char side, const Vector3d& center_mm, const Vector3d& radii_mm,
                                double contrast_per_m) {
    RigidTransform X = builder.pose(segment);
    X.translation() = builder.place(segment, side, center_mm);
    tissues.push_back({ellipsoidMesh(X, 1e-3 * radii_mm), contrast_per_m});
  };
  for (const char side : {'r', 'l'})
    addEllipsoid("thorax", side, {-8, 112, 78}, {82, 118, 50}, kLungAttenuation_per_m - kMuscleAttenuation_per_m);
  // Gas in the gut, where the colon runs: bubbles with soft rims, a small one inside a larger.
  const auto addBubble = [&](const char* segment, char side, const Vector3d& center_mm, const Vector3d& radii_mm) {
    addEllipsoid(segment, side, center_mm, radii_mm, -0.3 * kMuscleAttenuation_per_m);
    addEllipsoid(segment, side, center_mm + Vector3d{1, 2, -1}, 0.8 * radii_mm, -0.3 * kMuscleAttenuation_per_m);
  };
  addBubble("lumbar", 'r', {60, 6, 92}, {13, 19, 15});
  addBubble("lumbar", 'r', {66, 34, 84}, {11, 10, 13});
  addBubble("lumbar", 'r', {58, 52, 95}, {9, 11, 9});
  addBubble("lumbar", 'l', {52, 62, 88}, {12, 20, 11});
  addBubble("lumbar", 'l', {50, 30, 98}, {9, 11, 10});
  addBubble("pelvis", 'l', {8, 92, 46}, {10, 8, 15});
  addBubble("pelvis", 'r', {-52, 42, 6}, {10, 14, 9});
  return tissues;
}

}  // namespace sinew
