#include "imaging/rig/biplanar_rig_json.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/imaging/rigs.h"

namespace sinew {
namespace {

using ::testing::HasSubstr;

BiplanarRig mixedRig() {
  BiplanarRig rig;
  rig.views[0].projection = ConeBeam{6167.35, 6165.63, 803.74, 865.7, 0.01, -0.002, 1e-4, -1e-4, 3e-5};
  rig.views[0].R_CW = rotationFromVector<double>({0.1, -0.7, std::numbers::pi / 7});
  rig.views[0].p_CW = {0.0166, -0.0778, 0.9014};
  rig.views[1].projection = SlotScan{0.987, 0.000179, 0.00018, 860.5, 12.25};
  for (auto& view : rig.views) view.width_px = 1760, view.height_px = 4001;
  rig.patient_aligned = false;
  rig.calibration = {"autoscoper", "ab12cd", 0.31, std::nan(""), {{"no_accuracy", "calibration states none"}}};
  return rig;
}

std::string complaintAbout(const Json& json) {
  try {
    rigFromJson({json, "rig.json"});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BiplanarRigJson, RoundTripIsExact) {
  BiplanarRig rig = mixedRig();
  for (int i = 0; i < 2; ++i) {
    const Json json = parseJson(jsonText(rigToJson(rig)), "rig.json");
    const BiplanarRig back = rigFromJson({json, "rig.json"});
    EXPECT_EQ(back, rig);
    EXPECT_EQ(back.calibration.rms_px, 0.31);
    EXPECT_TRUE(std::isnan(back.calibration.accuracy_mm));
    rig.views[0].projection = Orthographic{0.0002, 0.00025, 1, 2};
  }
}

TEST(BiplanarRigJson, HoldsAnyNumberOfViewsWithTheirRoles) {
  BiplanarRig rig = mixedRig();
  rig.views.push_back(rig.views[0]);
  rig.views[0].role = ViewRole::FrontalPA;
  rig.views[1].role = ViewRole::LateralRight;
  rig.views[2].role = ViewRole::Oblique;
  rig.views[2].exposure = 1;
  const Json json = parseJson(jsonText(rigToJson(rig)), "rig.json");
  EXPECT_EQ(rigFromJson({json, "rig.json"}), rig);
  EXPECT_EQ(viewTitle(rig.views, 2), "Oblique");
  rig.views[2].role = ViewRole::FrontalAP;  // a stitched pair
  EXPECT_EQ(viewTitle(rig.views, 0), "Frontal 1");
  EXPECT_EQ(viewTitle(rig.views, 2), "Frontal 2");
}

TEST(BiplanarRigJson, ReadsFilesFromBeforeRoles) {
  for (const bool slot_scan : {false, true}) {
    BiplanarRig rig = slot_scan ? test::slotScanRig() : test::coneBeamRig();
    Json json = rigToJson(rig);
    for (auto& view : json["views"]) {
      view.erase("role");
      view.erase("exposure");
    }
    EXPECT_EQ(rigFromJson({json, "rig.json"}), rig);  // AP and left lateral by their beams; a cone beam shot by shot
  }
  // The id of a geometry is what it was before roles.
  EXPECT_EQ(geometryId(test::coneBeamRig().views), "cccacaca30c7");
}

TEST(BiplanarRigJson, RefusesGeometryThatCannotBe) {
  Json json = rigToJson(mixedRig());
  json["views"][0]["fx_px"] = -5;
  EXPECT_THAT(complaintAbout(json), HasSubstr("views[0].fx_px: expected a number > 0, found -5"));

  json = rigToJson(mixedRig());
  for (auto& entry : json["views"][0]["R_CW"][1]) entry = -entry.get<double>();
  EXPECT_EQ(complaintAbout(json), "accepted");  // mirrored film

  json = rigToJson(mixedRig());
  json["views"][1]["R_CW"][0][0] = 0.9;
  EXPECT_THAT(complaintAbout(json), HasSubstr("views[1].R_CW: expected an orthonormal matrix"));

  json = rigToJson(mixedRig());
  json["views"].push_back(json["views"][0]);
  EXPECT_EQ(complaintAbout(json), "accepted");
  json["views"] = Json::array({json["views"][0]});
  EXPECT_THAT(complaintAbout(json), HasSubstr("views: expected a list of 2 to 32 views"));

  json = rigToJson(mixedRig());
  json["views"][1]["role"] = "sagittal";
  EXPECT_THAT(complaintAbout(json), HasSubstr("views[1].role: expected one of"));
}

}  // namespace
}  // namespace sinew
