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
                    {"determined", f.determined}});
  return list;
}

std::vector<BoneFigure> figuresFromJson(const JsonReader& json) {
  std::vector<BoneFigure> figures;
  for (const auto& f : json.items()) {
    f.allowOnly({"quantity", "side", "unit", "value", "lower95", "upper95", "determined"});
    figures.push_back({f["quantity"].text(), f["side"].oneOf({"r", "l", ""}), f["unit"].text(),
                       f["value"].numberOrNaN(), f["lower95"].numberOrNaN(), f["upper95"].numberOrNaN(),
                       f["determined"].boolean()});
  }
  return figures;
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
          {"undetermined", fit.undetermined},
          {"shape", shapeToJson(fit.shape)},
          {"posture_m_rad", postureToJson(fit.posture)},
          {"residuals", residuals}};
}

SkeletonFit skeletonFitFromJson(const JsonReader& json) {
  json.allowOnly({"outcome", "rms_px", "warnings", "figures", "undetermined", "shape", "posture_m_rad", "residuals"});
  SkeletonFit fit;
  fit.outcome = outcomeFromJson(json["outcome"]);
  fit.rms_px = json["rms_px"].numberOrNaN();
  fit.warnings = warningsFromJson(json["warnings"]);
  fit.figures = figuresFromJson(json["figures"]);
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
