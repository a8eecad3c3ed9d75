#include "app/model/case_actions.h"

#include <gtest/gtest.h>

#include "app/model/image_store.h"

namespace sinew {
namespace {

TEST(CaseActions, ASightingIsPlacedMovedAndRemoved) {
  Case c;
  setSighting(c, "asis_r", 0, {10, 20}, 2.5);
  setSighting(c, "asis_r", 1, {30, 40}, 2.5);
  setSighting(c, "asis_r", 0, {11, 21}, 9.0);
  ASSERT_EQ(c.sightings.size(), 2u);
  const Sighting* first = findSighting(c, "asis_r", 0);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(first->uv_px, Eigen::Vector2d(11, 21));
  EXPECT_EQ(first->sigma_px, 2.5);  // moving does not change how well the reader places points
  removeSighting(c, "asis_r", 0);
  EXPECT_EQ(findSighting(c, "asis_r", 0), nullptr);
  EXPECT_NE(findSighting(c, "asis_r", 1), nullptr);
  removeSighting(c, "nowhere", 0);
  EXPECT_EQ(c.sightings.size(), 1u);
}

TEST(CaseActions, TypicalSigmaIsTheMedian) {
  Case c;
  EXPECT_EQ(typicalSigma_px(c), 1.0);
  c.sightings = {{"a", 0, {0, 0}, 4}, {"b", 0, {0, 0}, 2}, {"c", 0, {0, 0}, 90}};
  EXPECT_EQ(typicalSigma_px(c), 4.0);
}

TEST(CaseActions, LandmarksOfTheCaseFollowTheProtocols) {
  Case c;
  c.sightings = {{"bead_1", 0, {0, 0}, 1}, {"asis_l", 0, {0, 0}, 1}, {"bead_1", 1, {0, 0}, 1}};
  EXPECT_EQ(landmarkNames(c, {"asis_r", "asis_l"}), (std::vector<std::string>{"asis_r", "asis_l", "bead_1"}));
}

TEST(CaseActions, AnEmptiedLineOfTheFormGoes) {
  Case c;
  setExamNote(c, "staheli", 'l', "pain");
  ASSERT_NE(findExamEntry(c, "staheli", 'l'), nullptr);
  EXPECT_EQ(findExamEntry(c, "staheli", 'r'), nullptr);
  setExamNote(c, "staheli", 'l', "");
  EXPECT_TRUE(c.exam.entries.empty());
}

TEST(CaseActions, AnImpossibleStopTorqueIsRefused) {
  Case c;
  EXPECT_THROW(setThreshold(c, "staheli", 'l', 0.5), InputError);
  EXPECT_THROW(setThreshold(c, "staheli", 'l', 1e9), InputError);
  setThreshold(c, "staheli", 'l', 15.0);
  EXPECT_EQ(findExamEntry(c, "staheli", 'l')->threshold_Nm, 15.0);
}

TEST(CaseActions, OneSourceOfGeometryAtATime) {
  Case c;
  EXPECT_EQ(rigSource(c), RigSource::ImageTags);
  usePhantom(c, {});
  EXPECT_EQ(rigSource(c), RigSource::Phantom);
  useImportedRig(c, {});
  EXPECT_EQ(rigSource(c), RigSource::Imported);
  EXPECT_FALSE(c.phantom);
  useImageTags(c);
  EXPECT_EQ(rigSource(c), RigSource::ImageTags);
}

TEST(HalfSize, AveragesBlocksAndDropsTheOddEdge) {
  Radiograph r;
  r.width_px = 3;
  r.height_px = 2;
  r.pixels = std::make_shared<std::vector<std::uint16_t>>(std::vector<std::uint16_t>{10, 20, 7, 30, 42, 9});
  const Radiograph half = halfSize(r);
  EXPECT_EQ(half.width_px, 1);
  EXPECT_EQ(half.height_px, 1);
  EXPECT_EQ(half.at(0, 0), 26);  // (10 + 20 + 30 + 42 + 2) / 4: rounded, not cut
}

}  // namespace
}  // namespace sinew
