#include <gtest/gtest.h>

#include <random>

#include "app/experiments/experiment_shapes.h"
#include "core/angle.h"
#include "core/muscle/muscle_path.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/routing/unit_problem_internal.h"
#include "tests/support/retarget_reference.h"

namespace sinew {
namespace {

const RetargetReference& reference() {
  return *test::retargetReference();
}

constexpr std::uint64_t kBodies = 5;  // random ones

ShapeParameters shortTurnedLeg() {
  ShapeParameters shape;
  shape.sides[0].femur = {.elongation = 0.85, .torsion_rad = 20 * kRadPerDeg};
  shape.sides[0].tibia = {.elongation = 1.2, .torsion_rad = -15 * kRadPerDeg};
  return shape;
}

Routing routed(const ShapeParameters& shape, RetargetMethod method, Model& model) {
  model = deformedModel(reference().model(), shape);
  return route(reference().model(), reference().routing(), model, {.method = method});
}

/// One unit of a deformed body, all of whose points may go anywhere.
struct FreeUnit {
  Model model;
  MotionPoses poses;
  std::vector<std::vector<Anchor>> anchors;
  std::vector<UnitProblem::Point> points;
  UnitProblem problem;

  FreeUnit(const std::string& name, const ShapeParameters& shape)
      : model{deformedModel(reference().model(), shape)},
        poses{model.skeleton, reference().routing().motions()},
        anchors{anchorsOf(model.musculature.unit(name))},
        points(anchors.size()),
        problem{anchors,
                reference().routing().curves(index(name)),
                reference().routing().poses(),
                poses,
                freed(points),
                pathLength(model.musculature.unit(name), poses.atZero()),
                reference().routing().motions(),
                {}} {}

  static std::size_t index(const std::string& name) {
    return static_cast<std::size_t>(reference().model().musculature.unitIndex(name));
  }
  static std::vector<std::vector<Anchor>> anchorsOf(const MusculotendonUnit& unit) {
    std::vector<std::vector<Anchor>> anchors;
    for (const PathPoint& point : unit.path) anchors.push_back(point.anchors);
    return anchors;
  }
  static const std::vector<UnitProblem::Point>& freed(std::vector<UnitProblem::Point>& points) {
    for (UnitProblem::Point& point : points) {
      point.basis_W = point.basis_B = Eigen::Matrix3d::Identity();
      point.price_1_m2 = 100;
      point.slides = true;
      point.outward_W = Eigen::Vector3d::UnitX();  // guarded: some displacements go inside
    }
    return points;
  }
};

TEST(RetargetRouting, TheGradientOfTheEnergyIsThatOfCentralDifferences) {
  FreeUnit unit{"sartorius_r", shortTurnedLeg()};
  std::mt19937 random{7};
  std::uniform_real_distribution<double> displacement_m{-0.004, 0.004};
  Eigen::VectorXd x(unit.problem.unknowns());
  for (double& value : x) value = displacement_m(random);

  UnitProblem::Expansion expansion;
  const Objective objective{.slide_1_m2 = 300};
  unit.problem.expand(x, objective, expansion);
  EXPECT_NEAR(expansion.energy, unit.problem.energy(x, objective), 1e-9 * expansion.energy);
  constexpr double kStep_m = 1e-6;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Eigen::VectorXd more = x, less = x;
    more[i] += kStep_m;
    less[i] -= kStep_m;
    const double slope =
        (unit.problem.energy(more, objective) - unit.problem.energy(less, objective)) / (2 * kStep_m);
    EXPECT_NEAR(expansion.gradient[i], slope, 1e-4 * expansion.gradient.norm()) << i;  // rounding over the step
  }
  Eigen::VectorXd gradient;
  unit.problem.energy(x, gradient);
  unit.problem.expand(x, {}, expansion);
  EXPECT_LT((gradient - expansion.gradient).norm(), 1e-9 * gradient.norm());
}

TEST(RetargetRouting, TheGradientOfAWatchedStepIsThatOfCentralDifferences) {
  FreeUnit unit{"sartorius_r", shortTurnedLeg()};
  // A step that would have to be far longer than it is.
  unit.problem.watch({{.motion = 0, .step = 17, .direction = -1, .least = 0.05, .weight = 1e4}}, unit.anchors);
  EXPECT_GT(unit.problem.watchedPrice(), 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(unit.problem.unknowns()), gradient;
  unit.problem.energy(x, gradient);
  UnitProblem::Expansion expansion;
  unit.problem.expand(x, {}, expansion);
  EXPECT_LT((gradient - expansion.gradient).norm(), 1e-9 * gradient.norm());
  constexpr double kStep_m = 1e-6;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Eigen::VectorXd more = x, less = x;
    more[i] += kStep_m;
    less[i] -= kStep_m;
    const double slope = (unit.problem.energy(more) - unit.problem.energy(less)) / (2 * kStep_m);
    EXPECT_NEAR(gradient[i], slope, 1e-4 * gradient.norm()) << i;  // rounding over the step
  }
}

TEST(RetargetRouting, TheReferenceItselfHasNothingToImprove) {
  Model model;
  const Routing routing = routed({}, RetargetMethod::Sinew, model);
  for (std::size_t u = 0; u < routing.units.size(); ++u) {
    EXPECT_EQ(routing.units[u].iterations, 0) << routing.units[u].unit;
    EXPECT_LT(routing.units[u].largest_move_m, 1e-12);
  }
}

TEST(RetargetRouting, NoMuscleEndsHigherThanWithGradientDescent) {
  Model model;
  const Routing sinew = routed(shortTurnedLeg(), RetargetMethod::Sinew, model);
  const Routing paper = routed(shortTurnedLeg(), RetargetMethod::Paper, model);
  const RoutingWeights weights;
  int lower = 0, changed = 0;
  for (std::size_t u = 0; u < sinew.units.size(); ++u) {
    const double ours = sinew.units[u].end.total(weights), theirs = paper.units[u].end.total(weights);
    EXPECT_LE(ours, 1.01 * theirs + 1e-9) << sinew.units[u].unit;
    EXPECT_LE(ours, sinew.units[u].start.total(weights)) << sinew.units[u].unit;
    changed += paper.units[u].iterations > 0;
    lower += ours < theirs * (1 - 1e-9);
  }
  EXPECT_GT(changed, 30);            // the muscles of one leg
  EXPECT_GE(lower, 0.97 * changed);  // measured: all of them
}

TEST(RetargetRouting, EveryMuscleThatCanBeImprovedIs) {
  constexpr double kNothing = 1e-9, kRounding = 1e-6;
  Model model;
  const Routing routing = routed(randomShapes(1, {}, kBodies).front(), RetargetMethod::Sinew, model);
  int improved = 0;
  for (const UnitRouting& unit : routing.units) {
    const double start = unit.start.total({}), end = unit.end.total({});
    if (start < kNothing) continue;
    EXPECT_LT(end, start * (1 - kRounding)) << unit.unit;
    ++improved;
  }
  EXPECT_GT(improved, 200);  // of 282; the others do not feel any bone that differs
}

TEST(RetargetRouting, NoPieceOfAPathIsTurnedAround) {
  constexpr double kPiece_m = 0.001;  // shorter ones have no direction to speak of
  for (const ShapeParameters& shape : randomShapes(4, {}, kBodies)) {
    Model model;
    routed(shape, RetargetMethod::Sinew, model);
    const Model naive = deformedModel(reference().model(), shape);
    const auto X_WB = segmentPoses(naive.skeleton, zeroPosture(naive.skeleton));
    for (std::size_t u = 0; u < naive.musculature.units.size(); ++u) {
      const auto before = pathPoints(naive.musculature.units[u], X_WB),
                 after = pathPoints(model.musculature.units[u], X_WB);
      for (std::size_t p = 0; p + 1 < before.size(); ++p)
        if ((before[p + 1] - before[p]).norm() > kPiece_m) {
          EXPECT_GT((before[p + 1] - before[p]).dot(after[p + 1] - after[p]), 0)
              << naive.musculature.units[u].name << ", piece " << p;
        }
    }
  }
}

TEST(RetargetRouting, AttachmentsStayOnTheirBonesAndViaPointsOutside) {
  constexpr double kOnBone_m = 0.0005, kRounding_m = 1e-6;
  const auto before = measureAttachments(reference().model(), reference().routing().bones());
  ShapeParameters wide_trunk = shortTurnedLeg();
  wide_trunk.trunk_elongation = 1.6;
  wide_trunk.trunk_expansion = 0.7;
  for (const ShapeParameters& shape : {shortTurnedLeg(), wide_trunk}) {
    Model model;
    routed(shape, RetargetMethod::Sinew, model);
    const BoneDistances bones{model};
    const auto after = measureAttachments(model, bones);
    const auto X_WB = segmentPoses(model.skeleton, zeroPosture(model.skeleton));
    for (std::size_t u = 0; u < after.size(); ++u) {
      const MusculotendonUnit& unit = model.musculature.units[u];
      const auto allowed_m = [&](double was_m) { return std::max(kOnBone_m, std::abs(was_m)) + kRounding_m; };
      EXPECT_LE(std::abs(after[u].origin_m), allowed_m(before[u].origin_m)) << unit.name;
      EXPECT_LE(std::abs(after[u].insertion_m), allowed_m(before[u].insertion_m)) << unit.name;
      const auto spanned = spannedSegments(model.skeleton, unit);
      const auto points = pathPoints(unit, X_WB);
      for (std::size_t p = 1; p + 1 < points.size(); ++p)
        for (std::size_t s = 0; s < spanned.size(); ++s)
          if (spanned[s]) {
            EXPECT_GE(bones.nearest(int(s), X_WB[s].inverse() * points[p]).nearest.distance_m, 0)
                << unit.name << ", point " << p;
          }
    }
  }
}

TEST(RetargetRouting, AMirroredShapeGivesMirroredMuscles) {
  ShapeParameters right = shortTurnedLeg(), left = right;
  std::swap(left.sides[0], left.sides[1]);
  Model a, b;
  routed(right, RetargetMethod::Sinew, a);
  routed(left, RetargetMethod::Sinew, b);
  // Both search alike, but round differently on the way.
  constexpr double kAlike_m = 1e-4;
  int alike = 0, compared = 0;
  for (std::size_t u = 0; u < a.musculature.units.size(); ++u) {
    const int mirror = reference().routing().mirrorOf()[u];
    if (mirror < 0) continue;
    const auto& one = a.musculature.units[u].path;
    const auto& other = b.musculature.units[static_cast<std::size_t>(mirror)].path;
    double farthest_m = 0;
    for (std::size_t p = 0; p < one.size(); ++p)
      for (std::size_t k = 0; k < one[p].anchors.size(); ++k)
        farthest_m = std::max(farthest_m, (one[p].anchors[k].p_B - mirrored(other[p].anchors[k].p_B)).norm());
    ++compared;
    alike += farthest_m < kAlike_m;
  }
  EXPECT_GT(compared, 250);
  EXPECT_GE(alike, 0.97 * compared);
}

TEST(RetargetRouting, AUniformlyLargerLegNeedsNothing) {
  constexpr double kLarger = 1.2;
  ShapeParameters shape;
  shape.pelvis_width = shape.pelvis_height = shape.pelvis_depth = kLarger;
  for (SideShape& side : shape.sides) {
    side.foot_scale = kLarger;
    for (LimbBoneShape* bone : {&side.femur, &side.tibia})
      bone->elongation = bone->proximal_scale = bone->distal_scale = kLarger;
  }
  Model model;
  const Routing routing = routed(shape, RetargetMethod::Sinew, model);
  for (const char* name :
       {"gluteus_medius_anterior_r", "vastus_lateralis_superior_r", "soleus_medial_r", "semimembranosus_l"}) {
    const auto u = FreeUnit::index(name);
    EXPECT_LT(routing.units[u].start.total({}), 1e-9) << name;
    EXPECT_EQ(routing.units[u].iterations, 0) << name;
  }
}

TEST(RetargetRouting, UnitsThatFeelNothingOfAChangeAreKnown) {
  const ShapeParameters before = shortTurnedLeg();
  ShapeParameters after = before;
  after.sides[0].femur.elongation = 0.9;
  const auto unchanged = unchangedUnits(reference().routing(), before, after);
  const auto of = [&](const char* name) { return unchanged[FreeUnit::index(name)]; };
  EXPECT_FALSE(of("vastus_lateralis_superior_r"));
  EXPECT_FALSE(of("soleus_medial_r"));  // lies elsewhere
  EXPECT_TRUE(of("vastus_lateralis_superior_l"));
  EXPECT_TRUE(of("soleus_medial_l"));
  EXPECT_TRUE(of("biceps_brachii_long_head_r"));
}

}  // namespace
}  // namespace sinew
