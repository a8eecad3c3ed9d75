#include "tests/benchmarks/deformities.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angle.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

double quintic(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10 + t * (-15 + 6 * t));
}

std::string suffixOf(int side) {
  return side == 0 ? "_r" : "_l";
}

/// A map of the points of one bone, right side, with the turn of what lies there.
struct Moved {
  Vector3d p;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};
using Map = std::function<Moved(const Vector3d&)>;

/// Moves all landmarks of the segment and the joints that hang on it.
void move(Skeleton& body, const std::string& segment, int side, const Map& map) {
  const int index = body.segmentIndex(segment);
  const Eigen::DiagonalMatrix<double, 3> flip{1, 1, side == 0 ? 1.0 : -1.0};
  for (Landmark& landmark : body.landmarks)
    if (landmark.segment == index) landmark.p_BL = flip * map(flip * landmark.p_BL).p;
  for (Joint& joint : body.joints) {
    if (joint.parent != index) continue;
    const Moved moved = map(flip * joint.X_PJ.translation());
    joint.X_PJ.translation() = flip * moved.p;
    joint.X_PJ.linear() = (flip * moved.turn * flip) * joint.X_PJ.linear();
  }
}

double lengthOf(const Skeleton& body, const std::string& segment) {
  const int index = body.segmentIndex(segment);
  for (const Joint& joint : body.joints)
    if (joint.parent == index) return joint.X_PJ.translation().norm();
  return 0;
}

/// A bend about `axis` whose angle grows from 0 to the whole between two levels (shares of the bone's length from its
/// upper joint), each piece turned about the point of the line of the joints that it stands at.
void bend(Skeleton& body, const std::string& bone, int side, const Vector3d& axis, double angle_rad, double begin,
          double end) {
  const std::string segment = bone + suffixOf(side);
  const double length = lengthOf(body, segment);
  // The bent line of the joints, by small steps: direction turned by the share of the angle at each level.
  const auto share = [&](double u) { return quintic((u / length - begin) / (end - begin)); };
  move(body, segment, side, [&](const Vector3d& p) {
    const double u = -p.y();
    constexpr int kSteps = 400;
    Vector3d line = Vector3d::Zero();
    for (int i = 0; i < kSteps; ++i) {
      const double middle = u * (i + 0.5) / kSteps;
      line += Eigen::AngleAxisd{angle_rad * share(middle), axis} * Vector3d{0, -u / kSteps, 0};
    }
    const Eigen::Matrix3d turn = Eigen::AngleAxisd{angle_rad * share(u), axis}.toRotationMatrix();
    return Moved{line + turn * Vector3d{p.x(), 0, p.z()}, turn};
  });
}

void twist(Skeleton& body, const std::string& bone, int side, double outwards_rad, double begin, double end) {
  const std::string segment = bone + suffixOf(side);
  const double length = lengthOf(body, segment);
  move(body, segment, side, [&](const Vector3d& p) {
    const double share = quintic((-p.y() / length - begin) / (end - begin));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd{-outwards_rad * share, Vector3d::UnitY()}.toRotationMatrix();
    return Moved{turn * p, turn};
  });
}

void lengthen(Skeleton& body, const std::string& bone, int side, double by_m, double begin, double end) {
  const std::string segment = bone + suffixOf(side);
  const double length = lengthOf(body, segment);
  move(body, segment, side, [&](const Vector3d& p) {
    return Moved{p - Vector3d{0, by_m * quintic((-p.y() / length - begin) / (end - begin)), 0}};
  });
}

/// The head of the femur, and the hip with it, at another place of its own bone: everything else moves the other way.
void moveHead(Skeleton& body, int side, const Vector3d& by) {
  move(body, "femur" + suffixOf(side), side, [&](const Vector3d& p) {
    return Moved{p.norm() < 0.012 ? p : Vector3d{p - by}};  // its centre; nothing else is that near
  });
}

Vector3d neckOf(const Skeleton& body, int side) {
  Vector3d p = body.landmark("femoral_neck_base" + suffixOf(side)).p_BL;
  if (side == 1) p.z() = -p.z();
  return p;
}

/// The hip's centre against the pelvis: outwards, upwards, forwards.
void moveHip(Skeleton& body, int side, const Vector3d& forward_up_out_m) {
  Joint& hip = body.joints[std::size_t(body.jointIndex("hip" + suffixOf(side)))];
  hip.X_PJ.translation() +=
      Vector3d{forward_up_out_m.x(), forward_up_out_m.y(), side == 0 ? forward_up_out_m.z() : -forward_up_out_m.z()};
}

const Vector3d kVarus = Vector3d::UnitX(), kApexInFront = -Vector3d::UnitZ();

std::vector<Deformity> all() {
  std::vector<Deformity> list;
  const std::vector<double> usual = {10, -10, 15, -15};
  const auto add = [&](const char* name, const char* unit, const std::vector<double>& amounts, auto apply,
                       bool used = true, bool both = false) {
    list.push_back({name, unit, amounts, apply, both, used});
  };
  // ---- looked at while the model was designed
  add("hip subluxated upwards and outwards", "mm", usual, [](Skeleton& b, double mm, int s) {
    moveHip(b, s, 1e-3 * mm * Vector3d{-0.2, 0.6, 0.77}.normalized());
  });
  add("tibia vara (+), valga (-), 60 mm below the knee", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "tibia", s, kVarus, deg * kRadPerDeg, 0.10, 0.20); });
  add("tibial procurvatum (+), recurvatum (-), 60 mm below the knee", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "tibia", s, kApexInFront, deg * kRadPerDeg, 0.10, 0.20); });
  add("femoral neck longer (+), shorter (-)", "mm", usual,
      [](Skeleton& b, double mm, int s) { moveHead(b, s, -1e-3 * mm * neckOf(b, s).normalized()); });
  add("sagittal bow of the femur", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "femur", s, kApexInFront, deg * kRadPerDeg, 0.15, 0.85); });
  add("frontal bow of the femur", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "femur", s, kVarus, deg * kRadPerDeg, 0.15, 0.85); });
  // ---- kept aside
  add(
      "coxa vara (+), valga (-), in the neck", "deg", usual,
      [](Skeleton& b, double deg, int s) {
        const Vector3d n = neckOf(b, s);
        const Eigen::AngleAxisd turn{deg * kRadPerDeg, Vector3d::UnitX()};
        moveHead(b, s, n - turn.inverse() * n);
      },
      false);
  add(
      "slipped epiphysis: head behind and below", "mm", {10, 15},
      [](Skeleton& b, double mm, int s) {
        moveHead(b, s, 1e-3 * mm * Vector3d{-0.8, -0.5, -0.33}.normalized());
      },
      false);
  add(
      "hip subluxated backwards", "mm", usual,
      [](Skeleton& b, double mm, int s) {
        moveHip(b, s, 1e-3 * mm * Vector3d{-0.9, 0.44, 0});
      },
      false);
  add(
      "high dislocation of both hips", "mm", {40},
      [](Skeleton& b, double mm, int s) {
        moveHip(b, s, 1e-3 * mm * Vector3d{-0.25, 0.9, 0.36});
      },
      false, true);
  add(
      "femur in varus (+), valgus (-), in the middle", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "femur", s, kVarus, deg * kRadPerDeg, 0.47, 0.55); }, false);
  add(
      "subtrochanteric varus (+), valgus (-)", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "femur", s, kVarus, deg * kRadPerDeg, 0.17, 0.25); }, false);
  add(
      "supracondylar procurvatum (+), recurvatum (-)", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "femur", s, kApexInFront, deg * kRadPerDeg, 0.80, 0.90); }, false);
  add(
      "tibia bent in its middle, oblique plane", "deg", usual,
      [](Skeleton& b, double deg, int s) {
        bend(b, "tibia", s, (kVarus + kApexInFront).normalized(), deg * kRadPerDeg, 0.45, 0.55);
      },
      false);
  add(
      "supramalleolar varus (+), valgus (-)", "deg", usual,
      [](Skeleton& b, double deg, int s) { bend(b, "tibia", s, kVarus, deg * kRadPerDeg, 0.80, 0.90); }, false);
  add(
      "genu recurvatum from the tibial slope", "deg", {20},
      [](Skeleton& b, double deg, int s) { bend(b, "tibia", s, kApexInFront, -deg * kRadPerDeg, 0.09, 0.15); }, false,
      true);
  add(
      "tibial torsion", "deg", {40, -40},
      [](Skeleton& b, double deg, int s) { twist(b, "tibia", s, deg * kRadPerDeg, 0.2, 0.8); }, false);
  add(
      "femoral torsion below the trochanters", "deg", {30, -30},
      [](Skeleton& b, double deg, int s) { twist(b, "femur", s, deg * kRadPerDeg, 0.18, 0.30); }, false);
  add(
      "short femur", "mm", {-60},
      [](Skeleton& b, double mm, int s) { lengthen(b, "femur", s, 1e-3 * mm, 0.25, 0.75); }, false);
  add(
      "small hemipelvis", "%", {-10, -15},
      [](Skeleton& b, double percent, int s) {
        move(b, "pelvis", 0, [&](const Vector3d& p) {  // towards the middle of the sacrum, on one side only
          const Vector3d centre{-0.08, 0.05, 0};
          const double out = s == 0 ? p.z() : -p.z();
          return Moved{out > 0 ? Vector3d{centre + (1 + percent / 100 * quintic(out / 0.03)) * (p - centre)} : p};
        });
      },
      false);
  add(
      "Blount: varus, procurvatum and inward torsion of both tibiae", "deg", {10, 15},
      [](Skeleton& b, double deg, int s) {
        bend(b, "tibia", s, kVarus, deg * kRadPerDeg, 0.10, 0.17);
        bend(b, "tibia", s, kApexInFront, 0.6 * deg * kRadPerDeg, 0.10, 0.17);
        twist(b, "tibia", s, -deg * kRadPerDeg, 0.2, 0.5);
      },
      false, true);
  add(
      "dysplastic leg: subluxated hip, short neck in varus, bowed femur, valgus tibia", "deg and mm", {10, 15},
      [](Skeleton& b, double amount, int s) {
        const Vector3d n = neckOf(b, s);
        moveHip(b, s, 1e-3 * amount * Vector3d{0, 0.7, 0.71});
        moveHead(b, s, n - Eigen::AngleAxisd{-0.7 * amount * kRadPerDeg, Vector3d::UnitX()} * (0.85 * n));
        bend(b, "femur", s, kApexInFront, amount * kRadPerDeg, 0.2, 0.8);
        bend(b, "tibia", s, kVarus, -amount * kRadPerDeg, 0.3, 0.6);
      },
      false);
  return list;
}

}  // namespace

const std::vector<Deformity>& deformities() {
  static const std::vector<Deformity> list = all();
  return list;
}

}  // namespace sinew
