#include <gmock/gmock.h>

#include <limits>
#include <numbers>
#include <random>

#include "core/error.h"
#include "core/model/model.h"
#include "core/skeleton/shape/body_description.h"
#include "core/skeleton/shape/field_derivatives.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

/// A shape that is mild everywhere and different everywhere.
std::vector<double> mildShape(unsigned seed) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> uniform{-1, 1};
  auto values = toVector(ShapeParameters{});
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ShapeUnit unit = shapeUnit(shapeParameterNames()[k]);
    const double u = uniform(random);
    values[k] = unit == ShapeUnit::Angle ? 12 * kDeg * u : unit == ShapeUnit::Length ? 0.012 * u : 1 + 0.25 * u;
  }
  return values;
}

/// Every 7th bone vertex with its segment.
template <class Visit>
void forVertices(std::size_t stride, const Visit& visit) {
  for (const BoneMesh& bone : *reference().bones)
    for (std::size_t i = 0; i < bone.mesh.vertices.size(); i += stride) visit(bone, bone.mesh.vertices[i]);
}

TEST(FieldDerivatives, AreThoseOfCentralDifferences) {
  const Skeleton& skeleton = reference().skeleton;
  const auto parameters = mildShape(1);
  constexpr double h = 1e-5;  // truncation h^2 f''' / 6, rounding 1e-16 / h: together below 1e-8 here
  constexpr double kTolerance = 1e-7;
  forVertices(401, [&](const BoneMesh& bone, const Eigen::Vector3d& p) {
    const FieldDerivatives d = fieldDerivatives(skeleton, parameters, bone.segment, p);
    EXPECT_LT((d.p_B - deform(skeleton, parameters, bone.segment, p)).norm(), 1e-15);
    EXPECT_EQ(d.d_point, fieldJacobian(skeleton, parameters, bone.segment, p));
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d difference = (deform(skeleton, parameters, bone.segment, Eigen::Vector3d{p + step}) -
                                          deform(skeleton, parameters, bone.segment, Eigen::Vector3d{p - step})) /
                                         (2 * h);
      EXPECT_LT((difference - d.d_point.col(i)).norm(), 10 * kTolerance)
          << bone.bone;  // third derivatives to 1e4 / m2
    }
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      auto more = parameters, less = parameters;
      more[k] += h, less[k] -= h;
      const Eigen::Vector3d difference =
          (deform(skeleton, more, bone.segment, p) - deform(skeleton, less, bone.segment, p)) / (2 * h);
      EXPECT_LT((difference - d.d_parameters.col(Eigen::Index(k))).norm(), kTolerance)
          << bone.bone << " " << shapeParameterNames()[k];
    }
  });
}

/// Smallest determinant of the field's Jacobian over the bones' vertices.
double smallestDeterminant(const std::vector<double>& parameters, std::size_t stride, std::string* where = nullptr) {
  double smallest = std::numeric_limits<double>::infinity();
  forVertices(stride, [&](const BoneMesh& bone, const Eigen::Vector3d& p) {
    const double det = fieldJacobian(reference().skeleton, parameters, bone.segment, p).determinant();
    if (det < smallest && where) *where = bone.bone;
    smallest = std::min(smallest, det);
  });
  return smallest;
}

/// Largest error of the way there and back over the bones' vertices.
double largestReturnError_m(const std::vector<double>& parameters, std::size_t stride) {
  double largest_m = 0;
  forVertices(stride, [&](const BoneMesh& bone, const Eigen::Vector3d& p) {
    const Eigen::Vector3d image = deform(reference().skeleton, parameters, bone.segment, p);
    largest_m = std::max(largest_m, (undeform(reference().skeleton, parameters, bone.segment, image) - p).norm());
  });
  return largest_m;
}

constexpr double kReturn_m = 1e-9;

TEST(Undeform, GoesBackFromEveryPresetAndMildShape) {
  double largest_m = 0;
  const auto check = [&](const std::vector<double>& parameters, const std::string& name) {
    const double error_m = largestReturnError_m(parameters, 23);
    EXPECT_LT(error_m, kReturn_m) << name;
    largest_m = std::max(largest_m, error_m);
  };
  for (const auto& name : shapePresetNames()) check(toVector(loadShapePreset(test::resourceDir(), name).shape), name);
  for (unsigned seed = 1; seed <= 5; ++seed) check(mildShape(seed), "mild shape " + std::to_string(seed));
  std::printf("largest return error %.1e m\n", largest_m);
}

TEST(Undeform, GoesBackFromANearlyStraightTrunk) {  // where the arc's centre is far away
  for (const double bend_deg : {0.0, 1e-9, 1e-6, 1e-4, 1e-2, 0.2, 1.0, 40.0}) {
    ShapeParameters shape;
    shape.trunk_bend_rad = bend_deg * kDeg;
    shape.trunk_elongation = 1.3;
    EXPECT_LT(largestReturnError_m(toVector(shape), 101), kReturn_m) << bend_deg;
  }
}

TEST(Undeform, RefusesWhatHasNoOrigin) {
  ShapeParameters bent;
  bent.trunk_bend_rad = 40 * kDeg;
  const int thorax = reference().skeleton.segmentIndex("thorax");
  const double radius_m = 2 * 0.270 / bent.trunk_bend_rad;  // half of the bend over 270 mm
  EXPECT_THROW(undeform(reference().skeleton, toVector(bent), thorax, {radius_m, 0, 0}), InputError);
  EXPECT_THROW(
      undeform(reference().skeleton, toVector(bent), thorax, {std::numeric_limits<double>::quiet_NaN(), 0, 0}),
      InputError);
  ShapeParameters nothing;
  nothing.trunk_elongation = 0;
  EXPECT_THROW(undeform(reference().skeleton, toVector(nothing), thorax, {0, 0, 0}), InputError);
}

/// What deformity clinics see, one by one and together, on one side.
TEST(Undeform, GoesBackFromDeformedLegs) {
  ShapeParameters all;
  const std::pair<double LimbBoneShape::*, double> femoral[] = {
      {&LimbBoneShape::varus_rad, 20 * kDeg},        {&LimbBoneShape::procurvatum_rad, -20 * kDeg},
      {&LimbBoneShape::neck_shaft_rad, -15 * kDeg},  {&LimbBoneShape::neck_length_m, -0.015},
      {&LimbBoneShape::neck_varus_rad, 15 * kDeg},   {&LimbBoneShape::neck_retroversion_rad, 15 * kDeg},
      {&LimbBoneShape::bow_frontal_rad, -15 * kDeg}, {&LimbBoneShape::bow_sagittal_rad, 20 * kDeg},
      {&LimbBoneShape::torsion_rad, 30 * kDeg}};
  const std::pair<double LimbBoneShape::*, double> tibial[] = {{&LimbBoneShape::varus_rad, 20 * kDeg},
                                                               {&LimbBoneShape::procurvatum_rad, 15 * kDeg},
                                                               {&LimbBoneShape::distal_varus_rad, -15 * kDeg},
                                                               {&LimbBoneShape::distal_procurvatum_rad, 15 * kDeg},
                                                               {&LimbBoneShape::torsion_rad, -40 * kDeg}};
  const auto check = [](const ShapeParameters& shape, const char* what) {
    EXPECT_NO_THROW(deformedSkeleton(reference().skeleton, shape)) << what;
    EXPECT_GT(smallestDeterminant(toVector(shape), 41), 0) << what;
    EXPECT_LT(largestReturnError_m(toVector(shape), 101), kReturn_m) << what;
  };
  for (const auto& [parameter, value] : femoral) {
    ShapeParameters one;
    one.sides[0].femur.*parameter = all.sides[0].femur.*parameter = value;
    check(one, "femur");
  }
  for (const auto& [parameter, value] : tibial) {
    ShapeParameters one;
    one.sides[1].tibia.*parameter = all.sides[1].tibia.*parameter = value;
    check(one, "tibia");
  }
  all.sides[0].hip = {0.02, 0.03, -0.01};
  check(all, "all");
}

// ---- extreme shapes
// --------------------------------------------------------------------------------------------------

/// What a parameter may be at the extremes that the model is made for.
std::pair<double, double> extremesOf(const std::string& name) {
  if (name.ends_with(".torsion")) return {-60 * kDeg, 60 * kDeg};
  if (name.ends_with(".bend")) return {-40 * kDeg, 40 * kDeg};
  if (shapeUnit(name) == ShapeUnit::Angle) return {-10 * kDeg, 10 * kDeg};
  if (name.ends_with(".neck_length")) return {-0.005, 0.005};  // 10 mm of a neck of 0.4 of its size are half of it
  if (shapeUnit(name) == ShapeUnit::Length) return {-0.1, 0.1};
  return {0.4, 3};
}

TEST(ExtremeShapes, EveryParameterAloneAndAllTogetherKeepTheBonesRightSideOut) {
  std::vector<std::vector<double>> shapes;
  const auto identity = toVector(ShapeParameters{});
  const auto& names = shapeParameterNames();
  auto lowest = identity, highest = identity;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto [low, high] = extremesOf(names[k]);
    lowest[k] = low, highest[k] = high;
    if (names[k].find("_l.") != std::string::npos) continue;  // the mirror image
    for (const double value : {low, high}) {
      shapes.push_back(identity);
      shapes.back()[k] = value;
    }
  }
  shapes.push_back(lowest);
  shapes.push_back(highest);
  for (const auto& shape : shapes) {
    EXPECT_NO_THROW(deformedSkeleton(reference().skeleton, shapeFromVector(shape)));
    std::string where;
    EXPECT_GT(smallestDeterminant(shape, 29, &where), 0) << where;
  }
}

/// What can fold a bone of the leg: its angles but for torsion, and the length of its neck.
bool isBend(const std::string& name) {
  const bool leg = name.starts_with("femur_") || name.starts_with("tibia_");
  return leg && shapeUnit(name) != ShapeUnit::Ratio && !name.ends_with(".torsion");
}

/// A shape anywhere within the extremes; the bends of the legs only if `with_bends`.
std::vector<double> extremeShape(std::mt19937_64& random, bool with_bends) {
  auto values = toVector(ShapeParameters{});
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string& name = shapeParameterNames()[k];
    const auto [low, high] = extremesOf(name);
    const double value = std::uniform_real_distribution<double>{low, high}(random);
    if (with_bends || !isBend(name)) values[k] = value;
  }
  return values;
}

TEST(ExtremeShapes, TwoHundredAtRandomKeepTheBonesRightSideOut) {
  std::mt19937_64 random{20};
  double smallest = 1e9, largest_return_m = 0;
  for (int i = 0; i < 200; ++i) {
    const auto values = extremeShape(random, false);
    EXPECT_NO_THROW(deformedSkeleton(reference().skeleton, shapeFromVector(values))) << "shape " << i;
    std::string where;
    smallest = std::min(smallest, smallestDeterminant(values, 211, &where));
    EXPECT_GT(smallest, 0) << "shape " << i << " " << where;
    if (i % 20 == 0) largest_return_m = std::max(largest_return_m, largestReturnError_m(values, 997));
  }
  EXPECT_LT(largest_return_m, kReturn_m);
  std::printf("smallest determinant %.4f, largest return error %.1e m\n", smallest, largest_return_m);
}

TEST(ExtremeShapes, BendsThatFoldTheBoneAreRefusedByName) {
  std::mt19937_64 random{21};
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    const auto values = extremeShape(random, true);
    try {
      deformedSkeleton(reference().skeleton, shapeFromVector(values));
    } catch (const InputError& error) {
      EXPECT_TRUE(isBend(error.detail().field)) << error.detail().field;
      ++refused;
      continue;
    }
    EXPECT_GT(smallestDeterminant(values, 211), 0) << "shape " << i;
  }
  std::printf("%d of 100 refused\n", refused);
  // 10 deg is much for a femur of a third of its length with heads of three times their size.
  EXPECT_LE(refused, 40);
}

TEST(ExtremeShapes, ShortBonesKeepTheirJointDistanceAndShrinkMonotonically) {
  for (const char* bone : {"femur_r", "tibia_r", "humerus_r", "ulna_r"}) {
    const int segment = reference().skeleton.segmentIndex(bone);
    const auto& names = shapeParameterNames();
    const auto at = std::size_t(std::ranges::find(names, std::string{bone} + ".elongation") - names.begin());
    double length_m = 0;
    for (const Joint& joint : reference().skeleton.joints)
      if (joint.parent == segment) length_m = -joint.X_PJ.translation().y();
    double before_head = 0, before_middle = 0;
    for (double e = 0.4; e < 1.2; e += 0.02) {
      auto values = toVector(ShapeParameters{});
      values[at] = e;
      const auto y = [&](double u) {
        return -deform(reference().skeleton, values, segment, Eigen::Vector3d{0, -u * length_m, 0}).y();
      };
      EXPECT_NEAR(y(1), e * length_m, 1e-12) << bone << " " << e;
      EXPECT_GE(y(0.1), before_head - 1e-15)
          << bone << " " << e;  // the head is pressed together only when it must be
      EXPECT_GT(y(0.5), before_middle) << bone << " " << e;
      before_head = y(0.1), before_middle = y(0.5);
    }
    EXPECT_NEAR(before_head, 0.1 * length_m, 1e-12) << bone;
  }
}

TEST(ExtremeShapes, WhatIsNoShapeIsRefusedByName) {
  const auto refusal = [](const std::function<void(ShapeParameters&)>& change) -> std::string {
    ShapeParameters shape;
    change(shape);
    try {
      deformedSkeleton(reference().skeleton, shape);
    } catch (const InputError& error) {
      return error.detail().field;
    }
    return "accepted";
  };
  EXPECT_EQ(refusal([](auto& s) { s.trunk_bend_rad = std::numeric_limits<double>::quiet_NaN(); }), "trunk.bend");
  EXPECT_EQ(refusal([](auto& s) { s.sides[1].tibia.elongation = 0; }), "tibia_l.elongation");
  EXPECT_EQ(refusal([](auto& s) { s.head_scale = -1; }), "head.scale");
  EXPECT_EQ(refusal([](auto& s) { s.sides[0].ulna.elongation = 0.3; }), "ulna_r.elongation");
  EXPECT_EQ(refusal([](auto& s) { s.sides[0].ulna = {0.3, 0.3, 0.3}; }), "accepted");  // a small bone is a bone
  EXPECT_EQ(refusal([](auto& s) { s.sides[1].femur.neck_shaft_rad = 60 * kDeg; }), "femur_l.neck_shaft");
  EXPECT_EQ(refusal([](auto& s) { s.sides[0].femur.varus_rad = 80 * kDeg; }), "femur_r.varus");
  EXPECT_EQ(refusal([](auto& s) { s.sides[0].femur.neck_length_m = -0.05; }), "femur_r.neck_length");
  EXPECT_EQ(refusal([](auto& s) { s.sides[1].tibia.varus_rad = 85 * kDeg; }), "tibia_l.varus");
  EXPECT_EQ(refusal([](auto& s) { s.sides[1].hip.lateral_m = 0.2; }), "hip_l.lateral");
}

}  // namespace
}  // namespace sinew
