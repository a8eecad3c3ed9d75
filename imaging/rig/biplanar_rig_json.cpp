#include "imaging/rig/biplanar_rig_json.h"

#include "imaging/radiograph/radiograph.h"
#include "imaging/rig/rig_uncertainty.h"

namespace sinew {
namespace {

constexpr double kRotationTolerance = 1e-6;  // text calibrations carry about ten digits

void write(const ConeBeam& c, Json& json) {
  json["fx_px"] = c.fx_px;
  json["fy_px"] = c.fy_px;
  json["cx_px"] = c.cx_px;
  json["cy_px"] = c.cy_px;
  json["distortion_k1_k2_p1_p2_k3"] = {c.k1, c.k2, c.p1, c.p2, c.k3};
}

void write(const SlotScan& s, Json& json) {
  json["source_to_isocenter_m"] = s.source_to_isocenter_m;
  json["column_spacing_m"] = s.column_spacing_m;
  json["row_spacing_m"] = s.row_spacing_m;
  json["u0_px"] = s.u0_px;
  json["v0_px"] = s.v0_px;
}

void write(const Orthographic& o, Json& json) {
  json["column_spacing_m"] = o.column_spacing_m;
  json["row_spacing_m"] = o.row_spacing_m;
  json["u0_px"] = o.u0_px;
  json["v0_px"] = o.v0_px;
}

Json viewToJson(const RigView& view) {
  Json json = projectionToJson(view);
  json["role"] = nameOf(view.role);
  json["exposure"] = view.exposure;
  return json;
}

ConeBeam coneBeamFromJson(const JsonReader& json) {
  json.allowOnly({"projection", "role", "exposure", "width_px", "height_px", "R_CW", "p_CW_m", "fx_px", "fy_px",
                  "cx_px", "cy_px", "distortion_k1_k2_p1_p2_k3"});
  ConeBeam c{.fx_px = json["fx_px"].positive(),
             .fy_px = json["fy_px"].positive(),
             .cx_px = json["cx_px"].number(),
             .cy_px = json["cy_px"].number()};
  if (const auto distortion = json.find("distortion_k1_k2_p1_p2_k3")) {
    const auto d = distortion->numbers(5);
    c.k1 = d[0], c.k2 = d[1], c.p1 = d[2], c.p2 = d[3], c.k3 = d[4];
  }
  return c;
}

SlotScan slotScanFromJson(const JsonReader& json) {
  json.allowOnly({"projection", "role", "exposure", "width_px", "height_px", "R_CW", "p_CW_m",
                  "source_to_isocenter_m", "column_spacing_m", "row_spacing_m", "u0_px", "v0_px"});
  return {json["source_to_isocenter_m"].positive(), json["column_spacing_m"].positive(),
          json["row_spacing_m"].positive(), json["u0_px"].number(), json["v0_px"].number()};
}

Orthographic orthographicFromJson(const JsonReader& json) {
  json.allowOnly({"projection", "role", "exposure", "width_px", "height_px", "R_CW", "p_CW_m", "column_spacing_m",
                  "row_spacing_m", "u0_px", "v0_px"});
  return {json["column_spacing_m"].positive(), json["row_spacing_m"].positive(), json["u0_px"].number(),
          json["v0_px"].number()};
}

Eigen::Matrix3d rotationFromJson(const JsonReader& json) {
  Eigen::Matrix3d R;
  const auto rows = json.items(3);
  for (int i = 0; i < 3; ++i) {
    const auto row = rows[static_cast<std::size_t>(i)].numbers(3);
    R.row(i) << row[0], row[1], row[2];
  }
  const double error = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationTolerance)) json.fail("an orthonormal matrix", "rows off by " + std::to_string(error));
  // A left-handed view frame is a film that is mirrored against the view from its source: legal.
  return R;
}

View projectionFromJson(const JsonReader& json) {
  View view;
  const std::string projection = json["projection"].oneOf({"cone_beam", "slot_scan", "orthographic"});
  if (projection == "cone_beam") view.projection = coneBeamFromJson(json);
  if (projection == "slot_scan") view.projection = slotScanFromJson(json);
  if (projection == "orthographic") view.projection = orthographicFromJson(json);
  view.width_px = json["width_px"].integer(1, kMaxImageSide_px);
  view.height_px = json["height_px"].integer(1, kMaxImageSide_px);
  view.R_CW = rotationFromJson(json["R_CW"]);
  const auto p = json["p_CW_m"].numbers(3);
  view.p_CW << p[0], p[1], p[2];
  return view;
}

RigView viewFromJson(const JsonReader& json, const BiplanarRig& rig, int index) {
  RigView view{projectionFromJson(json), ViewRole::Other, isSimultaneous(rig.calibration) ? 0 : index};
  if (const auto role = json.find("role"))
    view.role =
        roleFromName(role->oneOf({"frontal_ap", "frontal_pa", "lateral_left", "lateral_right", "oblique", "other"}));
  else if (rig.patient_aligned)
    view.role = roleOfBeam(view);
  if (const auto exposure = json.find("exposure")) view.exposure = exposure->integer(0, kMaxViews);
  return view;
}

CalibrationRecord calibrationFromJson(const JsonReader& json) {
  json.allowOnly({"method", "id", "rms_px", "accuracy_mm", "warnings"});
  return {json["method"].text(), json["id"].text(), json["rms_px"].numberOrNaN(), json["accuracy_mm"].numberOrNaN(),
          warningsFromJson(json["warnings"])};
}

}  // namespace

Json projectionToJson(const View& view) {
  Json json;
  json["projection"] = projectionName(view);
  json["width_px"] = view.width_px;
  json["height_px"] = view.height_px;
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({view.R_CW(i, 0), view.R_CW(i, 1), view.R_CW(i, 2)});
  json["R_CW"] = rows;
  json["p_CW_m"] = {view.p_CW.x(), view.p_CW.y(), view.p_CW.z()};
  std::visit([&](const auto& projection) { write(projection, json); }, view.projection);
  return json;
}

Json rigToJson(const BiplanarRig& rig) {
  Json json;
  json["format"] = "sinew.rig";
  json["version"] = 1;
  json["patient_aligned"] = rig.patient_aligned;
  json["calibration"] = {{"method", rig.calibration.method},
                         {"id", rig.calibration.id},
                         {"rms_px", numberOrNull(rig.calibration.rms_px)},
                         {"accuracy_mm", numberOrNull(rig.calibration.accuracy_mm)},
                         {"warnings", warningsToJson(rig.calibration.warnings)}};
  json["views"] = Json::array();
  for (const auto& view : rig.views) json["views"].push_back(viewToJson(view));
  return json;
}

BiplanarRig rigFromJson(const JsonReader& json) {
  json.expectFormat("sinew.rig", 1);
  json.allowOnly({"format", "version", "patient_aligned", "calibration", "views"});
  BiplanarRig rig;
  rig.patient_aligned = json["patient_aligned"].boolean();
  if (const auto calibration = json.find("calibration"))
    rig.calibration = calibrationFromJson(*calibration);
  else
    rig.calibration.method = "json";
  const auto views = json["views"].items();
  if (views.size() < 2 || views.size() > std::size_t(kMaxViews))
    json["views"].fail("a list of 2 to " + std::to_string(kMaxViews) + " views");
  rig.views.clear();
  for (const auto& view : views) rig.views.push_back(viewFromJson(view, rig, int(rig.views.size())));
  return rig;
}

}  // namespace sinew
