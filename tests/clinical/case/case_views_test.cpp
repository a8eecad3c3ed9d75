#include "clinical/case/case_views.h"

#include <gtest/gtest.h>

#include "clinical/synthetic/synthetic_rig.h"

namespace sinew {
namespace {

Case threeViews() {
  Case c;
  for (const char* name : {"a", "b", "c"}) c.images.push_back({{std::string{"images/"} + name, "hash"}, {}});
  c.phantom = PhantomImages{{c.images[0].file, c.images[1].file, c.images[2].file}, {}};
  c.imported_rig = nominalRig(SyntheticRig::ConeBeam, 1, 3);
  for (const int view : {0, 1, 2}) c.sightings.push_back({"knee", view, {double(view), 0}, 1});
  return c;
}

TEST(RemoveView, TakesEverythingOfTheViewAndMovesTheLaterOnesUp) {
  Case c = threeViews();
  removeView(c, 1);
  ASSERT_EQ(c.images.size(), 2u);
  EXPECT_EQ(c.images[1].file.path, "images/c");
  EXPECT_EQ(c.phantom->images[1].path, "images/c");
  EXPECT_EQ(c.imported_rig->views[1].role, ViewRole::Oblique);
  EXPECT_EQ(c.imported_rig->calibration.id, geometryId(c.imported_rig->views));
  ASSERT_EQ(c.sightings.size(), 2u);
  EXPECT_EQ(c.sightings[1], (Sighting{"knee", 1, {2, 0}, 1}));
}

TEST(RemoveView, LeavesTwo) {
  Case c = threeViews();
  removeView(c, 2);
  EXPECT_THROW(removeView(c, 0), InputError);
  EXPECT_THROW(removeView(c, 5), InputError);
  EXPECT_EQ(c.images.size(), 2u);
}

}  // namespace
}  // namespace sinew
