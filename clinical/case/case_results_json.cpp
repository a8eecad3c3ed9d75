#include "clinical/case/case_results_json.h"

#include <limits>

#include "clinical/exam/physical_exam_json.h"
#include "core/skeleton/shape/shape_json.h"

namespace sinew {
namespace {

Json toJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Eigen::Vector2d vector2(const JsonReader& json) {
  const auto n = json.numbers(2);
  return {n[0], n[1]};
}

Eigen::Vector3d vector3(const JsonReader& json) {
  const auto n = json.numbers(3);
  return {n[0], n[1], n[2]};
}

/// Views are counted from 1 in files.
int viewFromJson(const JsonReader& json) {
  return json.integer(1, kMaxViews) - 1;
}

Json pointToJson(const TriangulatedLandmark& point) {
  Json covariance = Json::array();
  for (int i = 0; i < 3; ++i) covariance.push_back(toJson(Eigen::Vector3d{point.cov_W.row(i)}));
  Json views = Json::array(), residuals = Json::array();
  for (const auto& r : point.residuals) {
    views.push_back(r.view + 1);
    residuals.push_back({r.residual_px.x(), r.residual_px.y()});
  }
  return {{"name", point.name},
          {"p_W_m", toJson(point.p_WL)},
          {"covariance_W_m2", covariance},
          {"reprojection_rms_px", numberOrNull(point.reprojection_rms_px)},
          {"views", views},
          {"residual_px", residuals}};
}

TriangulatedLandmark pointFromJson(const JsonReader& json) {
  json.allowOnly({"name", "p_W_m", "covariance_W_m2", "reprojection_rms_px", "views", "residual_px"});
  TriangulatedLandmark point;
  point.name = json["name"].text();
  point.p_WL = vector3(json["p_W_m"]);
  const auto rows = json["covariance_W_m2"].items(3);
  for (int i = 0; i < 3; ++i) point.cov_W.row(i) = vector3(rows[static_cast<std::size_t>(i)]);
  point.reprojection_rms_px = json["reprojection_rms_px"].numberOrNaN();
  for (const auto& residual : json["residual_px"].items())
    point.residuals.push_back({int(point.residuals.size()), vector2(residual)});
  if (const auto stated = json.find("views")) {  // cases that knew two views only do not have them
    const auto views = stated->items(point.residuals.size());
    for (std::size_t i = 0; i < views.size(); ++i) point.residuals[i].view = viewFromJson(views[i]);
  }
  return point;
}

Json postureToJson(const Posture& posture) {
  Json json = Json::array();
  for (const double q : posture) json.push_back(numberOrNull(q));
  return json;
}

Posture postureFromJson(const JsonReader& json) {
  const auto items = json.items();
  Posture posture(static_cast<Eigen::Index>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) posture[static_cast<Eigen::Index>(i)] = items[i].numberOrNaN();
  return posture;
}

Json figuresToJson(const std::vector<BoneFigure>& figures) {
  Json list = Json::array();
  for (const auto& f : figures)
    list.push_back({{"quantity", f.quantity},
                    {"side", f.side},
                    {"unit", f.unit},
                    {"value", numberOrNull(f.value)},
                    {"lower95", numberOrNull(f.lower95)},
                    {"upper95", numberOrNull(f.upper95)},
                    {"determined", f.determined},
                    {"source", f.triangulated ? "triangulated" : "fitted"},
                    {"other", numberOrNull(f.other)},
                    {"other_lower95", numberOrNull(f.other_lower95)},
                    {"other_upper95", numberOrNull(f.other_upper95)}});
  return list;
}

std::vector<BoneFigure> figuresFromJson(const JsonReader& json) {
  std::vector<BoneFigure> figures;
  for (const auto& f : json.items()) {
    f.allowOnly({"quantity", "side", "unit", "value", "lower95", "upper95", "determined", "source", "other",
                 "other_lower95", "other_upper95"});
    // Older files know the fitted figure alone.
    const auto optional = [&](const char* name) {
      const auto number = f.find(name);
      return number ? number->number() : kNoFigure;
    };
    const auto source = f.find("source");
    figures.push_back({f["quantity"].text(), f["side"].oneOf({"r", "l", ""}), f["unit"].text(),
                       f["value"].numberOrNaN(), f["lower95"].numberOrNaN(), f["upper95"].numberOrNaN(),
                       f["determined"].boolean(),
                       source && source->oneOf({"fitted", "triangulated"}) == "triangulated", optional("other"),
                       optional("other_lower95"), optional("other_upper95")});
  }
  return figures;
}

Json outsideToJson(const std::vector<OutsideBone>& bones) {
  Json list = Json::array();
  for (const auto& b : bones)
    list.push_back({{"bone", b.segment},
                    {"misfit", numberOrNull(b.misfit)},
                    {"landmark", b.landmark},
                    {"distance_mm", numberOrNull(b.distance_mm)}});
  return list;
}

std::vector<OutsideBone> outsideFromJson(const JsonReader& json) {
  std::vector<OutsideBone> bones;
  for (const auto& b : json.items()) {
    b.allowOnly({"bone", "misfit", "landmark", "distance_mm"});
    bones.push_back(
        {b["bone"].text(), b["misfit"].numberOrNaN(), b["landmark"].text(), b["distance_mm"].numberOrNaN()});
  }
  return bones;
}

Json adviceToJson(const std::vector<FigureAdvice>& advice) {
  Json list = Json::array();
  for (const auto& a : advice)
    list.push_back({{"quantity", a.quantity}, {"side", a.side}, {"landmarks", a.landmarks}, {"enough", a.enough}});
  return list;
}

std::vector<FigureAdvice> adviceFromJson(const JsonReader& json) {
  std::vector<FigureAdvice> advice;
  for (const auto& a : json.items()) {
    a.allowOnly({"quantity", "side", "landmarks", "enough"});
    FigureAdvice one{a["quantity"].text(), a["side"].oneOf({"r", "l", ""}), {}, a["enough"].boolean()};
    for (const auto& landmark : a["landmarks"].items()) one.landmarks.push_back(landmark.text());
    advice.push_back(std::move(one));
  }
  return advice;
}

}  // namespace

Json triangulationToJson(const Triangulation& landmarks) {
  Json points = Json::array();
  for (const auto& point : landmarks.points) points.push_back(pointToJson(point));
  return {{"rms_px", numberOrNull(landmarks.rms_px)},
          {"warnings", warningsToJson(landmarks.warnings)},
          {"points", points}};
}

Triangulation triangulationFromJson(const JsonReader& json) {
  json.allowOnly({"rms_px", "warnings", "points"});
  Triangulation landmarks;
  landmarks.rms_px = json["rms_px"].numberOrNaN();
  landmarks.warnings = warningsFromJson(json["warnings"]);
  for (const auto& point : json["points"].items()) landmarks.points.push_back(pointFromJson(point));
  return landmarks;
}

Json exchangesToJson(const std::vector<SideExchange>& exchanges) {
  Json list = Json::array();
  for (const auto& e : exchanges)
    list.push_back({{"view", e.view + 1}, {"landmarks", e.landmarks}, {"whole", e.whole}});
  return list;
}

std::vector<SideExchange> exchangesFromJson(const JsonReader& json) {
  std::vector<SideExchange> exchanges;
  for (const auto& e : json.items()) {
    e.allowOnly({"view", "landmarks", "whole"});
    exchanges.push_back({viewFromJson(e["view"]), {}, e["whole"].boolean()});
    for (const auto& name : e["landmarks"].items()) exchanges.back().landmarks.push_back(name.text());
  }
  return exchanges;
}

/// An angle or a distance with its interval, in the unit that the key names.
Json amountToJson(const ExposureMovement::Amount& amount) {
  return {numberOrNull(amount.value), numberOrNull(amount.lower95), numberOrNull(amount.upper95)};
}

ExposureMovement::Amount amountFromJson(const JsonReader& json) {
  const auto parts = json.items(3);
  return {parts[0].numberOrNaN(), parts[1].numberOrNaN(), parts[2].numberOrNaN()};
}

Json movementsToJson(const std::vector<ExposureMovement>& movements) {
  Json list = Json::array();
  for (const auto& m : movements) {
    Json joints = Json::array();
    for (const auto& j : m.joints)
      joints.push_back({{"joint", j.joint}, {"turn_deg", amountToJson(j.turn_deg)}, {"moved", j.moved}});
    list.push_back({{"exposure", m.exposure},
                    {"turn_deg", amountToJson(m.turn_deg)},
                    {"sway_mm", amountToJson(m.sway_mm)},
                    {"moved", m.moved},
                    {"joints", joints}});
  }
  return list;
}

std::vector<ExposureMovement> movementsFromJson(const JsonReader& json) {
  std::vector<ExposureMovement> movements;
  for (const auto& m : json.items()) {
    m.allowOnly({"exposure", "turn_deg", "sway_mm", "moved", "joints"});
    ExposureMovement movement{m["exposure"].integer(0, 1000),
                              amountFromJson(m["turn_deg"]),
                              amountFromJson(m["sway_mm"]),
                              m["moved"].boolean(),
                              {}};
    for (const auto& j : m["joints"].items()) {
      j.allowOnly({"joint", "turn_deg", "moved"});
      movement.joints.push_back({j["joint"].text(), amountFromJson(j["turn_deg"]), j["moved"].boolean()});
    }
    movements.push_back(movement);
  }
  return movements;
}

Json skeletonFitToJson(const SkeletonFit& fit) {
  Json residuals = Json::array();
  for (const auto& r : fit.residuals)
    residuals.push_back({{"landmark", r.landmark},
                         {"view", r.view + 1},
                         {"u_px", numberOrNull(r.residual_px.x())},
                         {"v_px", numberOrNull(r.residual_px.y())},
                         {"sigmas", numberOrNull(r.sigmas)}});
  return {{"outcome", nameOf(fit.outcome)},
          {"rms_px", numberOrNull(fit.rms_px)},
          {"warnings", warningsToJson(fit.warnings)},
          {"figures", figuresToJson(fit.figures)},
          {"outside_model", outsideToJson(fit.outside)},
          {"advice", adviceToJson(fit.advice)},
          {"pick_scale",
           {{"pick", fit.pick_scale.pick},
            {"definition", fit.pick_scale.definition},
            {"blur_mm", fit.pick_scale.blur_mm}}},
          {"movements", movementsToJson(fit.movements)},
          {"undetermined", fit.undetermined},
          {"shape", shapeToJson(fit.shape)},
          {"posture_m_rad", postureToJson(fit.posture)},
          {"residuals", residuals}};
}

SkeletonFit skeletonFitFromJson(const JsonReader& json) {
  json.allowOnly({"outcome", "rms_px", "warnings", "figures", "pick_scale", "movements", "undetermined", "shape",
                  "posture_m_rad", "residuals", "outside_model", "advice"});
  SkeletonFit fit;
  fit.outcome = outcomeFromJson(json["outcome"]);
  fit.rms_px = json["rms_px"].numberOrNaN();
  fit.warnings = warningsFromJson(json["warnings"]);
  fit.figures = figuresFromJson(json["figures"]);
  if (const auto outside = json.find("outside_model")) fit.outside = outsideFromJson(*outside);
  if (const auto advice = json.find("advice")) fit.advice = adviceFromJson(*advice);
  if (const auto scale = json.find("pick_scale")) {
    scale->allowOnly({"pick", "definition", "blur_mm"});
    fit.pick_scale = {(*scale)["pick"].number(), (*scale)["definition"].number(), (*scale)["blur_mm"].number()};
  }
  if (const auto movements = json.find("movements")) fit.movements = movementsFromJson(*movements);
  for (const auto& name : json["undetermined"].items()) fit.undetermined.push_back(name.text());
  fit.shape = shapeFromJson(json["shape"]);
  fit.posture = postureFromJson(json["posture_m_rad"]);
  for (const auto& r : json["residuals"].items()) {
    r.allowOnly({"landmark", "view", "u_px", "v_px", "sigmas"});
    fit.residuals.push_back({r["landmark"].text(),
                             viewFromJson(r["view"]),
                             {r["u_px"].numberOrNaN(), r["v_px"].numberOrNaN()},
                             r["sigmas"].numberOrNaN()});
  }
  return fit;
}

Json truthToJson(const Truth& truth) {
  return {{"seed", truth.seed},
          {"figures", figuresToJson(truth.figures)},
          {"length_factors", factorsToJson(truth.length_factors)}};
}

Truth truthFromJson(const JsonReader& json) {
  json.allowOnly({"seed", "figures", "length_factors"});
  Truth truth;
  truth.seed = static_cast<unsigned>(json["seed"].numberIn(0, std::numeric_limits<unsigned>::max()));
  truth.figures = figuresFromJson(json["figures"]);
  truth.length_factors = factorsFromJson(json["length_factors"]);
  return truth;
}

Json stageRecordToJson(const StageRecord& record) {
  return {{"outcome", nameOf(record.outcome)},
          {"input_hash", record.input_hash},
          {"seconds", record.seconds},
          {"summary", record.summary},
          {"warnings", warningsToJson(record.warnings)}};
}

StageRecord stageRecordFromJson(const JsonReader& json) {
  json.allowOnly({"outcome", "input_hash", "seconds", "summary", "warnings"});
  StageRecord record;
  record.outcome = outcomeFromJson(json["outcome"]);
  record.input_hash = json["input_hash"].text();
  record.seconds = json["seconds"].number();
  record.summary = json["summary"].text();
  record.warnings = warningsFromJson(json["warnings"]);
  return record;
}

}  // namespace sinew
