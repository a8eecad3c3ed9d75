#include "core/skeleton/fit/figure_report_internal.h"

#include <ceres/jet.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/skeleton/fit/bone_figures_internal.h"
#include "core/skeleton/fit/fit_residuals.h"
#include "core/skeleton/fit/outside_bones_internal.h"

namespace sinew {
namespace {

constexpr double kTwoSided95 = 1.959964;

std::vector<int> everything(int count) {
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Segments whose shape a figure depends on.
bool dependsOn(const BoneFigure& figure, const std::string& segment) {
  const std::string bone{withoutSide(segment)};
  const bool other_side = !figure.side.empty() && bone != segment && !segment.ends_with("_" + figure.side);
  if (other_side) return false;
  const std::string& q = figure.quantity;
  if (bone == "pelvis") return q == "pelvic_tilt";
  if (bone == "tibia" || bone == "foot")
    return q == "tibia_length" || q.starts_with("leg_length") || q == "hka" || q == "tibial_torsion" ||
           q == "knee_flexion";
  return bone == "femur" && q != "tibial_torsion";
}

/// What every landmark's picks say against the fitted body.
struct PickReport {
  std::vector<PickedPoint> points;
  std::vector<LandmarkMisfit> misfits;
  double scale = 1;  ///< by which all residuals exceed what is stated, if they do: a wrong geometry is no deformity
};

PickReport reportOf(const FitEvidence& evidence) {
  PickReport report;
  std::vector<int> landmarks;
  for (const LandmarkPicks& picks : evidence.picks) landmarks.push_back(picks.landmark);
  const PosedPoints posed =
      posePoints(evidence.reference, evidence.body, landmarks, evidence.z, everything(evidence.body.count()));
  std::vector<double> ratios;
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    const LandmarkPicks& picks = evidence.picks[l];
    const Eigen::Index rows = picks.uv_px.size();
    Eigen::VectorXd residual_px(rows);
    Eigen::MatrixXd by_z(rows, evidence.z.size());
    bool visible = true;
    for (Eigen::Index k = 0; k < rows / 2 && visible; ++k) {
      SeenImage seen;
      visible = evidence.image(picks.landmark, picks.views[std::size_t(k)], posed.p_W[l], seen);
      if (!visible) break;
      residual_px.segment<2>(2 * k) = picks.uv_px.segment<2>(2 * k) - seen.uv_px;
      by_z.middleRows<2>(2 * k) = seen.by_point * posed.dp_dz[l];
    }
    if (!visible) continue;
    const Eigen::MatrixXd weight = picks.covariance_px2.inverse();
    LandmarkMisfit misfit{picks.landmark, residual_px.dot(weight * residual_px), 0, {}};
    const double used = (weight * by_z * evidence.covariance * by_z.transpose()).trace();
    misfit.degrees = std::max(0.1, double(rows) - used);
    if (auto point = pickedPoint(picks, evidence.image, posed.p_W[l])) {
      misfit.distance_m = (point->p_W - posed.p_W[l]).norm();
      report.points.push_back(std::move(*point));
    }
    ratios.push_back(misfit.chi2 / misfit.degrees);
    report.misfits.push_back(misfit);
  }
  if (ratios.empty()) return report;
  std::ranges::nth_element(ratios, ratios.begin() + long(ratios.size() / 2));
  constexpr double kMedianOfOwn = 0.8;  // of chi-squared over its degrees of freedom, for three of them
  report.scale = std::sqrt(std::max(1.0, ratios[ratios.size() / 2] / kMedianOfOwn));
  for (LandmarkMisfit& misfit : report.misfits) misfit.chi2 /= report.scale * report.scale;
  return report;
}

struct Estimate {
  double value = kNoFigure, sd = kNoFigure;
  double lower95() const { return value - kTwoSided95 * sd; }
  double upper95() const { return value + kTwoSided95 * sd; }
};

void take(BoneFigure& figure, const Estimate& taken, const Estimate& other) {
  figure.value = taken.value, figure.lower95 = taken.lower95(), figure.upper95 = taken.upper95();
  figure.other = other.value, figure.other_lower95 = other.lower95(), figure.other_upper95 = other.upper95();
}

double limitOf(const std::string& quantity) {
  const auto at = std::ranges::find(figureLimits(), quantity, &FigureLimit::quantity);
  require(at != figureLimits().end(), "every figure has its limit");
  return at->half_width;
}

std::string inWords(const BoneFigure& figure) {
  std::string words = figure.quantity + (figure.side == "r" ? " right" : figure.side == "l" ? " left" : "");
  std::ranges::replace(words, '_', ' ');
  return words;
}

}  // namespace

FittedFigures fittedFigures(const FitEvidence& evidence) {
  std::vector<int> landmarks;
  for (const auto& name : figureLandmarkNames()) landmarks.push_back(evidence.reference.landmarkIndex(name));
  const PosedPoints points =
      posePoints(evidence.reference, evidence.body, landmarks, evidence.z, everything(evidence.body.count()));
  constexpr int kInputs = 3 * (2 * figures::kLegPoints + 1);
  using Jet = ceres::Jet<double, kInputs>;
  std::vector<Vector3<Jet>> p_W;
  for (std::size_t i = 0; i < points.p_W.size(); ++i) {
    const int first = 3 * static_cast<int>(i);
    p_W.emplace_back(Jet(points.p_W[i].x(), first), Jet(points.p_W[i].y(), first + 1),
                     Jet(points.p_W[i].z(), first + 2));
  }
  const auto values = figureValues<Jet>(p_W);
  FittedFigures fitted;
  fitted.by_z = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(values.size()), evidence.z.size());
  for (std::size_t f = 0; f < values.size(); ++f) {
    fitted.value.push_back(values[f].a);
    for (std::size_t i = 0; i < points.p_W.size(); ++i)
      fitted.by_z.row(static_cast<Eigen::Index>(f)) +=
          values[f].v.segment<3>(3 * static_cast<Eigen::Index>(i)).transpose() * points.dp_dz[i];
  }
  return fitted;
}

void judgeFigures(const FitEvidence& evidence, SkeletonFit& fit) {
  const PickReport report = reportOf(evidence);
  fit.outside = outsideBones(evidence.reference, report.misfits);
  warnOfOutsideBones(fit.outside, fit.warnings);
  const FittedFigures fitted = fittedFigures(evidence);
  const TriangulatedFigures picked =
      triangulatedFigures(evidence.reference, report.points, evidence.nuisance_covariance);
  Eigen::VectorXd prior_variance(evidence.z.size());
  for (int i = 0; i < evidence.body.count(); ++i) prior_variance[i] = std::pow(evidence.body.priorWeight(i), -2);

  fit.figures = figureList();
  std::string taken_from_picks;
  for (std::size_t f = 0; f < fit.figures.size(); ++f) {
    BoneFigure& figure = fit.figures[f];
    const Eigen::VectorXd g = fitted.by_z.row(static_cast<Eigen::Index>(f));
    const double variance = g.dot(evidence.covariance * g);
    const Estimate of_model{fitted.value[f], std::sqrt(variance)};
    const Estimate of_picks{picked.value[f], report.scale * picked.sd[f]};
    const bool outside =
        std::ranges::any_of(fit.outside, [&](const OutsideBone& bone) { return dependsOn(figure, bone.segment); });
    constexpr double kDisagree_sd = 3, kLeastShare = 0.2;
    const double sd_of_difference =
        std::sqrt(std::max(std::pow(of_picks.sd, 2) - variance, std::pow(kLeastShare * of_picks.sd, 2)));
    const bool differs = std::abs(of_picks.value - of_model.value) > kDisagree_sd * sd_of_difference;
    figure.triangulated = std::isfinite(of_picks.value) && (outside || differs);
    take(figure, figure.triangulated ? of_picks : of_model, figure.triangulated ? of_model : of_picks);
    if (figure.triangulated) taken_from_picks += (taken_from_picks.empty() ? "" : ", ") + inWords(figure);

    constexpr double kMostOfPrior = 0.7;  // half of its variance
    const double prior_sd = std::sqrt(g.cwiseAbs2().dot(prior_variance));
    const bool seen = figure.triangulated || (of_model.sd < kMostOfPrior * prior_sd && !outside);
    figure.determined = seen && 0.5 * (figure.upper95 - figure.lower95) <= limitOf(figure.quantity);
    if (!figure.determined && !evidence.offered.empty())
      fit.advice.push_back(
          adviceFor(evidence, fitted, f, std::min(limitOf(figure.quantity) / kTwoSided95, kMostOfPrior * prior_sd)));
  }
  if (!taken_from_picks.empty())
    fit.warnings.push_back({"figures_triangulated",
                            "taken from the picks themselves, because the fitted bone differs from them by more than "
                            "both intervals allow: " +
                                taken_from_picks});
}

}  // namespace sinew
