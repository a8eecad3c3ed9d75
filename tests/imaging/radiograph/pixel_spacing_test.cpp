#include "imaging/radiograph/pixel_spacing.h"

#include <gmock/gmock.h>

namespace sinew {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Choice {
  std::optional<PixelSpacing> spacing;
  std::vector<std::string> codes;
};

Choice choose(const PixelSpacingFacts& facts) {
  Warnings warnings;
  Choice choice{choosePixelSpacing(facts, warnings), {}};
  for (const auto& w : warnings) choice.codes.push_back(w.code);
  return choice;
}

PixelSpacingFacts everything() {
  PixelSpacingFacts f;
  f.pixel_spacing = {{0.19, 0.18}};
  f.calibration_type = "FIDUCIAL";
  f.imager_spacing = {{0.25, 0.24}};
  f.magnification = 1.25;
  f.source_to_detector_mm = 1200;
  f.source_to_patient_mm = 1000;
  f.declared_mm = 0.2;
  return f;
}

TEST(PixelSpacing, FollowsTheOrderOfTrust) {
  PixelSpacingFacts f = everything();
  EXPECT_EQ(choose(f).spacing, (PixelSpacing{0.18, 0.19, PixelScaleSource::Fiducial}));
  f.calibration_type = "GEOMETRY";
  EXPECT_EQ(choose(f).spacing, (PixelSpacing{0.18, 0.19, PixelScaleSource::Geometry}));
  f.calibration_type = "";
  EXPECT_EQ(choose(f).spacing, (PixelSpacing{0.2, 0.2, PixelScaleSource::Declared}));
  f.declared_mm.reset();
  f.pixel_spacing.reset();
  EXPECT_EQ(choose(f).spacing, (PixelSpacing{0.24 / 1.25, 0.25 / 1.25, PixelScaleSource::ImagerMagnified}));
  f.magnification.reset();
  EXPECT_EQ(choose(f).spacing->source, PixelScaleSource::ImagerMagnified);
  EXPECT_DOUBLE_EQ(choose(f).spacing->row_mm, 0.25 * 1000 / 1200);
  EXPECT_THAT(choose(f).codes, IsEmpty());
}

TEST(PixelSpacing, SaysWhenOnlyTheDetectorIsKnown) {
  PixelSpacingFacts f;
  f.imager_spacing = {{0.25, 0.24}};
  EXPECT_EQ(choose(f).spacing, (PixelSpacing{0.24, 0.25, PixelScaleSource::ImagerAtDetector}));
  EXPECT_THAT(choose(f).codes, ElementsAre("pixel_spacing_at_detector"));
  f.pixel_spacing = f.imager_spacing;  // a copy says nothing new
  EXPECT_EQ(choose(f).spacing->source, PixelScaleSource::ImagerAtDetector);
  f.pixel_spacing = {{0.19, 0.18}};  // a correction that the file does not explain
  EXPECT_EQ(choose(f).spacing, (PixelSpacing{0.18, 0.19, PixelScaleSource::Geometry}));
  EXPECT_THAT(choose(f).codes, ElementsAre("pixel_spacing_unexplained"));
}

TEST(PixelSpacing, InventsNothing) {
  EXPECT_FALSE(choose({}).spacing);
  EXPECT_THAT(choose({}).codes, ElementsAre("pixel_spacing_missing"));
  PixelSpacingFacts f;
  f.source_to_detector_mm = 1200;
  f.source_to_patient_mm = 1000;
  f.imager_spacing = {{0.0, 0.0}};  // seen in the wild
  EXPECT_FALSE(choose(f).spacing);
  EXPECT_THAT(choose(f).codes, ElementsAre("pixel_spacing_zero", "pixel_spacing_missing"));
}

TEST(PixelSpacing, DoubtsAnImpossibleMagnification) {
  PixelSpacingFacts f;
  f.imager_spacing = {{0.25, 0.25}};
  f.source_to_detector_mm = 1000;  // patient behind the detector
  f.source_to_patient_mm = 1200;
  EXPECT_EQ(choose(f).spacing->source, PixelScaleSource::ImagerAtDetector);
  EXPECT_THAT(choose(f).codes, ElementsAre("magnification_odd", "pixel_spacing_at_detector"));
}

}  // namespace
}  // namespace sinew
