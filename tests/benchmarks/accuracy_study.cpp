#include "tests/benchmarks/accuracy_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <random>
#include <stdexcept>
#include <thread>

#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/bone_field.h"
#include "core/skeleton/shape/population.h"
#include "imaging/rig/rig_uncertainty.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

/// Processor time of this thread: what a fit costs, however busy the machine is.
double threadTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// What every body of a study has in common.
struct Study {
  Skeleton skeleton;
  std::vector<ShapePrior> priors;
  std::vector<ProtocolLandmark> protocol;
  const StudyRig& rig;
  const Disturbance& disturbance;
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_{seed} {}
  double normal(double sd) { return sd * normal_(random_); }
  Eigen::Vector3d vector(double sd) { return {normal(sd), normal(sd), normal(sd)}; }
  double sign() { return random_() % 2 ? 1 : -1; }
  double between(double low, double high) { return std::uniform_real_distribution<double>{low, high}(random_); }
  std::mt19937_64& engine() { return random_; }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

/// The views that really took the images.
std::vector<View> trueViews(const Study& study, Draw& draw) {
  const Disturbance& d = study.disturbance;
  std::vector<View> views = study.rig.views;
  const double farther = draw.sign() * draw.between(d.distance_error[0], d.distance_error[1]);
  const double k1 = draw.sign() * d.k1;
  for (View& view : views) {
    const Eigen::Vector3d pelvis{0, 0.55, 0};
    const double depth_m = (view.R_CW * pelvis + view.p_CW).z();
    view.p_CW += farther * depth_m * Eigen::Vector3d::UnitZ();
    const Eigen::Matrix3d turn = rotationFromVector<double>(draw.vector(d.frame_error_deg * kRadPerDeg));
    view.p_CW += view.R_CW * (pelvis - turn * pelvis) + draw.vector(1e-3 * d.frame_error_mm);
    view.R_CW = view.R_CW * turn;
    if (auto* cone = std::get_if<ConeBeam>(&view.projection)) cone->k1 += k1;
  }
  return views;
}

Posture withKneesBent(const Skeleton& skeleton, const Posture& posture, const Disturbance& d) {
  Eigen::VectorXd clinical = clinicalFromPosture(skeleton, posture);
  for (const std::string side : {"r", "l"}) {
    clinical[skeleton.coordinateIndex("knee_flexion_" + side)] += d.knees_deg * kRadPerDeg;
    if (!d.feet_stay) continue;
    clinical[skeleton.coordinateIndex("hip_flexion_" + side)] += d.knees_deg / 2 * kRadPerDeg;
    clinical[skeleton.coordinateIndex("ankle_dorsiflexion_" + side)] += d.knees_deg / 2 * kRadPerDeg;
  }
  return postureFromClinical(skeleton, clinical);
}

std::vector<LandmarkObservation> observe(const Study& study, const ShapeParameters& shape, const Posture& posture,
                                         Draw& draw) {
  const Disturbance& d = study.disturbance;
  const Skeleton body = deformedSkeleton(study.skeleton, shape);
  const std::vector<View> views = trueViews(study, draw);
  const std::array poses{segmentPoses(body, posture), segmentPoses(body, withKneesBent(body, posture, d))};
  const Eigen::Vector3d pelvis = poses[0][0].translation();
  const Eigen::Matrix3d turn = rotationFromVector<double>({0, draw.sign() * d.yaw_deg * kRadPerDeg, 0});
  const Eigen::Vector3d sway_m = 1e-3 * draw.sign() * Eigen::Vector3d{d.sway_mm[0], d.sway_mm[1], d.sway_mm[2]};
  std::vector<LandmarkObservation> observations;
  for (const ProtocolLandmark& wanted : study.protocol) {
    const Landmark& landmark = body.landmark(wanted.name);
    const Eigen::Vector3d meant_B = landmark.p_BL + draw.vector(1e-3 * d.definition_mm) +
                                    1e-3 * d.protocol_share * wanted.definition_sd_mm.cwiseProduct(draw.vector(1));
    for (int view = 0; view < static_cast<int>(views.size()); ++view) {
      const bool later = view > 0 && !study.rig.simultaneous;
      Eigen::Vector3d p_W = poses[later][landmark.segment] * meant_B;
      if (later) p_W = pelvis + turn * (p_W - pelvis) + sway_m;
      const double sigma_px = d.pick_mm * pixelsPerMillimetre(views[view], p_W);
      const Eigen::Vector2d noise_px{draw.normal(sigma_px), draw.normal(sigma_px)};
      observations.push_back(
          {wanted.name, view, *project(views[view], p_W) + noise_px, sigma_px > 0 ? sigma_px : 0.05});
    }
  }
  return observations;
}

struct Trial {
  std::vector<BoneFigure> truth;
  SkeletonFit fit;
  double ms = 0;
};

Trial runTrial(const Study& study, int seed) {
  Draw draw{static_cast<std::uint64_t>(seed)};
  const ShapeParameters shape = drawShape(study.priors, draw.engine());
  const Posture posture = drawStandingPosture(study.skeleton, draw.engine());
  const auto observations = observe(study, shape, posture, draw);
  FitOptions options;
  std::vector<FitView> views = exactViews(study.rig.views);
  if (!study.disturbance.exact) {
    options.definition_errors = definitionErrors(study.protocol);
    for (std::size_t i = 0; i < views.size(); ++i) {
      CalibrationRecord told;
      told.method = study.disturbance.nominal ? "dicom_nominal"
                    : study.rig.simultaneous  ? "dicom_slot_scan"
                                              : "bead_phantom";
      told.accuracy_mm = 0.3;  // what bead calibrations of the synthetic patients state
      views[i].uncertainty = uncertaintyOf(told, views[i].view);
      views[i].exposure = study.rig.simultaneous ? 0 : static_cast<int>(i);
    }
  }
  const double begin_ms = threadTime_ms();
  Trial trial{boneFigures(study.skeleton, shape, posture),
              fitSkeleton(study.skeleton, views, observations, study.priors, options), 0};
  trial.ms = threadTime_ms() - begin_ms;
  return trial;
}

void addError(AccuracyRow& row, double truth, const BoneFigure& estimate) {
  if (!estimate.determined) {
    ++row.undetermined;
    return;
  }
  ++row.determined;
  const double error = estimate.value - truth;
  row.bias += error;
  row.sd += error * error;
  row.max = std::max(row.max, std::abs(error));
  row.half_width95 += 0.5 * (estimate.upper95 - estimate.lower95);
  row.coverage += estimate.lower95 <= truth && truth <= estimate.upper95;
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void finish(AccuracyRow& row) {
  const double n = row.determined;
  if (n < 2) return;
  row.bias /= n;
  row.sd = std::sqrt((row.sd - n * row.bias * row.bias) / (n - 1));
  row.half_width95 /= n;
  row.coverage /= n;
}

}  // namespace

const AccuracyRow& AccuracyStudy::row(const std::string& quantity) const {
  const auto at = std::ranges::find(rows, quantity, &AccuracyRow::quantity);
  if (at == rows.end()) throw std::out_of_range{quantity};
  return *at;
}

double AccuracyStudy::coverage() const {
  double covered = 0, all = 0;
  for (const auto& row : rows) {
    covered += row.coverage * row.determined;
    all += row.determined;
  }
  return covered / all;
}

StudyRig coneBeamRig() {
  return {"Cone-beam pair, two exposures", test::coneBeamPair(), false};
}

StudyRig slotScanRig() {
  return {"Slot-scan pair", test::slotScanPair(), true};
}

std::vector<Disturbance> requiredDisturbances() {
  return {{.name = "none"},
          {.name = "turned by 2 deg", .yaw_deg = 2},
          {.name = "turned by 5 deg", .yaw_deg = 5},
          {.name = "swayed by 10 mm", .sway_mm = {10, 0, 0}},
          {.name = "definition error of 2 mm", .definition_mm = 2},
          {.name = "definition error of 3 mm", .definition_mm = 3},
          {.name = "k1 of +-2 %", .k1 = 0.02},
          {.name = "nominal geometry, 3-5 % wrong", .distance_error = {0.03, 0.05}, .nominal = true},
          {.name = "knees bent by 5 deg, feet free", .knees_deg = 5},
          {.name = "knees bent by 5 deg, feet stay", .knees_deg = 5, .feet_stay = true}};
}

std::vector<Disturbance> furtherDisturbances() {
  return {{.name = "turned by 3.5 deg", .yaw_deg = 3.5},
          {.name = "swayed by 8 mm aside", .sway_mm = {0, 0, 8}},
          {.name = "turned by 3 deg and swayed by 7 + 7 mm", .yaw_deg = 3, .sway_mm = {7, 0, 7}},
          {.name = "readers of the protocol", .protocol_share = 1},
          {.name = "readers of the protocol, turned by 2 deg", .protocol_share = 1, .yaw_deg = 2},
          {.name = "definition error of 2 mm, turned by 4 deg", .definition_mm = 2, .yaw_deg = 4},
          {.name = "nominal geometry, all of it wrong",
           .distance_error = {0, 0.06},
           .frame_error_mm = 4,
           .frame_error_deg = 0.7,
           .nominal = true},
          {.name = "definition error of 2 mm, knees bent by 5 deg", .definition_mm = 2, .knees_deg = 5}};
}

AccuracyStudy studyAccuracy(const std::filesystem::path& resource_dir, const StudyRig& rig,
                            const Disturbance& disturbance, int first_seed, int bodies) {
  const Study common{loadReferenceSkeleton(resource_dir), loadShapePriors(resource_dir),
                     loadLandmarkProtocol(resource_dir), rig, disturbance};
  std::vector<Trial> trials(static_cast<std::size_t>(bodies));
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i; (i = next++) < bodies;) trials[static_cast<std::size_t>(i)] = runTrial(common, first_seed + i);
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  }

  AccuracyStudy study;
  study.bodies = bodies;
  std::vector<double> times, picks, definitions, blurs;
  for (const auto& trial : trials) {
    times.push_back(trial.ms);
    if (trial.fit.outcome != Outcome::Converged) {
      ++study.not_converged;
      continue;
    }
    const auto warns = [&](const char* code) {
      return std::ranges::count(trial.fit.warnings, code, &Warning::code) > 0;
    };
    study.joint_warnings += warns("joint_moved");
    study.movement_warnings += warns("patient_moved");
    study.outlier_warnings += warns("outlier");
    picks.push_back(trial.fit.pick_scale.pick);
    definitions.push_back(trial.fit.pick_scale.definition);
    blurs.push_back(trial.fit.pick_scale.blur_mm);
    for (std::size_t f = 0; f < trial.truth.size(); ++f) {
      const BoneFigure& truth = trial.truth[f];
      auto at = std::ranges::find(study.rows, truth.quantity, &AccuracyRow::quantity);
      if (at == study.rows.end()) {
        study.rows.push_back({.quantity = truth.quantity, .unit = truth.unit});
        at = std::prev(study.rows.end());
      }
      addError(*at, truth.value, trial.fit.figures[f]);
    }
  }
  for (auto& row : study.rows) finish(row);
  study.median_ms = medianOf(times);
  study.pick_scale = medianOf(picks);
  study.definition_scale = medianOf(definitions);
  study.blur_mm = medianOf(blurs);
  return study;
}

}  // namespace sinew
