// Anatomy in new bodies: rows of the table of functions that hold in the reference hold in mild shapes.
#include <gtest/gtest.h>

#include "app/experiments/experiment_shapes.h"
#include "core/muscle/moment_references.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/rom/poses/pose_sampler.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

TEST(RetargetedFunctions, RowsThatHoldInTheReferenceHoldInMildShapes) {
  Model model = loadReferenceModel(test::resourceDir());
  auto motions = loadJointMotions(test::resourceDir(), model.skeleton);
  auto poses = std::make_shared<PoseSet>(model.skeleton, "resting postures");  // lengths do not matter here
  for (const Posture& q : restingPostures(model.skeleton)) poses->add(q);
  const RetargetReference reference{std::move(model), std::move(motions), std::move(poses)};
  const auto rows = loadFunctionReferences(test::testDataDir() / "muscle_functions.csv", reference.model().skeleton,
                                           reference.model().musculature);
  const auto before = judgeFunctions(reference.model().skeleton, reference.model().musculature, rows);
  int asked = 0, kept = 0;
  for (const ShapeParameters& shape : randomShapes(4, kMildShapes, 11)) {
    const Retargeted body = retarget(reference, shape, {.peak_torque = false});
    ASSERT_EQ(body.outcome, Outcome::Converged);
    const auto now = judgeFunctions(body.model.skeleton, body.model.musculature, rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      asked += before[i].right;
      kept += before[i].right && now[i].right;
      if (before[i].right && !now[i].right) std::printf("lost: %s\n", rows[i].where.c_str());
    }
  }
  std::printf("%d of %d rows kept\n", kept, asked);
  EXPECT_GE(double(kept) / asked, 0.995);  // what the product is held to
}

}  // namespace
}  // namespace sinew
