#include "core/io/mjcf.h"

#include <gtest/gtest.h>

#include "app/bench/mujoco_peer.h"
#include "core/muscle/muscle_path.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// What MuJoCo can express exactly: one anchor a point, none on a driven segment.
bool isPlain(const MusculotendonUnit& unit) {
  return std::ranges::all_of(unit.path, [](const PathPoint& p) {
    return p.anchors.size() == 1 && p.anchors.front().segment < reference().skeleton.movingSegmentCount();
  });
}

TEST(Mjcf, HasEveryBodyJointAndUnit) {
  const std::string xml = mjcfText(reference());
  EXPECT_EQ(count(xml, "<body "), 23);
  EXPECT_EQ(count(xml, "type=\"ball\""), 11);   // 13 less the wrists
  EXPECT_EQ(count(xml, "type=\"hinge\""), 13);  // 5 revolute, 2 x 3 of the wrists, 2 patellae
  EXPECT_EQ(count(xml, "<spatial "), 282);
  EXPECT_EQ(count(xml, "<muscle "), 282);
  EXPECT_EQ(count(xml, "<body "), count(xml, "</body>"));
}

TEST(Mjcf, NamesCannotBreakTheDocument) {
  Model model;
  model.skeleton = reference().skeleton;
  model.name = "a\"<b>&c";
  EXPECT_NE(mjcfText(model).find("model=\"a&quot;&lt;b>&amp;c\""), std::string::npos);
}

TEST(Mjcf, ThePatellaIsAQuarticOfTheKneeWithin2Degrees) {
  constexpr double kStated_rad = 2 * std::numbers::pi / 180;  // docs/methods/model_exchange.md
  const Skeleton& s = reference().skeleton;
  const MjcfPatella fit = mjcfPatella(s, s.patellae[0]);
  EXPECT_LT(fit.largest_error_rad, kStated_rad);
  EXPECT_GT(fit.coefficients[1], 0.5);  // it follows the knee
}

TEST(MjcfInMujoco, LengthsOfPlainUnitsAgreeAndTheOthersStayNear) {
  const auto mujoco = MujocoPeer::make(reference());
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  constexpr double kSame_m = 1e-4;
  const Skeleton& s = reference().skeleton;
  std::mt19937_64 random{41};
  double plain_m = 0, hand_m = 0;
  std::map<std::string, double> deviation_m;
  int plain = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Posture q = postureFromClinical(s, test::randomClinical(s, random));
    const auto X_WB = segmentPoses(s, q);
    mujoco->setPositions(mujoco->positions(q));
    mujoco->lengthsAndGradients();
    plain = 0;
    for (std::size_t u = 0; u < reference().musculature.units.size(); ++u) {
      const MusculotendonUnit& unit = reference().musculature.units[u];
      const double off_m = std::abs(mujoco->length_m(int(u)) - pathLength(unit, X_WB));
      if (isPlain(unit))
        plain_m = std::max(plain_m, off_m), ++plain;
      else
        deviation_m[unit.name] = std::max(deviation_m[unit.name], off_m);
    }
    for (const char* name : {"hand_r", "patella_l", "radius_r", "head"}) {
      const int segment = s.segmentIndex(name);
      hand_m = std::max(hand_m, (mujoco->p_WB(segment) - X_WB[segment].translation()).norm());
    }
  }
  EXPECT_LT(plain_m, kSame_m);
  EXPECT_LT(hand_m, kSame_m);
  EXPECT_GT(plain, 150);
  double worst_m = 0;
  std::string worst;
  for (const auto& [name, off_m] : deviation_m)
    if (off_m > worst_m) worst_m = off_m, worst = name;
  std::printf("plain units: %d, within %.2g m; the %zu others: up to %.1f mm (%s)\n", plain, plain_m,
              deviation_m.size(), 1000 * worst_m, worst.c_str());
  // The radius turns by pronation, not by twist: millimetres at the ends of the wrist's motion.
  EXPECT_LT(worst_m, 0.03) << worst;
}

TEST(MjcfInMujoco, TheBodyFallsWithoutBreaking) {
  const auto mujoco = MujocoPeer::make(reference());
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  mujoco->setPositions(mujoco->positions(zeroPosture(reference().skeleton)));
  EXPECT_TRUE(mujoco->simulate(500));  // half a second
}

}  // namespace
}  // namespace sinew
