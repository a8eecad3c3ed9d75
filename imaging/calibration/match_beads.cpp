#include <ceres/ceres.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

#include "imaging/calibration/bead_residuals.h"
#include "imaging/calibration/calibration_internal.h"

namespace sinew {
namespace {

constexpr double kReach_m = 0.25;      // displacement and turn of the object together, at a bead
constexpr double kMaxTurn_rad = 0.45;  // of a pose against the guess
constexpr double kMaxShift_m = 0.6;    // along the beam it takes up an error of the focal length
constexpr int kTriples = 80;
constexpr std::size_t kKept = 8;

using Pairs = std::vector<std::pair<int, int>>;

double diagonal_px(const View& view) {
  return std::hypot(view.width_px, view.height_px);
}

/// The shadow's size speaks neither for nor against an unknown diameter. Detected discs are a little smaller.
bool sizeFits(const CalibrationBead& bead, const DetectedBead& seen, const View& view) {
  if (bead.diameter_m <= 0 || seen.diameter_px <= 0) return true;
  const double depth_m = (view.R_CW * bead.p_WQ + view.p_CW).z();
  const double ratio = seen.diameter_px * depth_m / (bead.diameter_m * std::get<ConeBeam>(view.projection).fx_px);
  return ratio > 0.6 && ratio < 1.4;
}

/// Beads and detections that are each other's nearest within `reach_px`.
Pairs nearestPairs(const CalibrationObject& object, const std::vector<DetectedBead>& detected, const View& view,
                   double reach_px) {
  std::vector<int> bead_of(detected.size(), -1);
  std::vector<double> best(detected.size(), reach_px);
  for (std::size_t b = 0; b < object.beads.size(); ++b) {
    const auto uv = project(view, object.beads[b].p_WQ);
    if (!uv) continue;
    int nearest = -1;
    double distance = reach_px;
    for (std::size_t d = 0; d < detected.size(); ++d) {
      const double apart = (*uv - detected[d].uv_px).norm();
      if (apart < distance && sizeFits(object.beads[b], detected[d], view)) distance = apart, nearest = int(d);
    }
    if (nearest >= 0 && distance < best[std::size_t(nearest)]) {
      best[std::size_t(nearest)] = distance;
      bead_of[std::size_t(nearest)] = int(b);
    }
  }
  Pairs pairs;
  for (std::size_t d = 0; d < detected.size(); ++d)
    if (bead_of[d] >= 0) pairs.emplace_back(bead_of[d], int(d));
  return pairs;
}

/// The view that explains the pairs, robustly against wrong ones.
View refit(const CalibrationObject& object, const std::vector<DetectedBead>& detected, const Pairs& pairs,
           const View& start, double scale_px) {
  ViewUnknowns unknowns{start};
  ceres::Problem problem;
  std::vector<Eigen::Vector3d> places;
  places.reserve(pairs.size());
  for (const auto& [bead, seen] : pairs) {
    places.push_back(object.beads[std::size_t(bead)].p_WQ);
    problem.AddResidualBlock(
        BeadProjectionResidual::create(detected[std::size_t(seen)].uv_px, scale_px, unknowns.R0, unknowns.aspect),
        new ceres::CauchyLoss{1}, unknowns.intrinsics.data(), unknowns.pose.data(), places.back().data());
    problem.SetParameterBlockConstant(places.back().data());
  }
  problem.SetManifold(
      unknowns.intrinsics.data(),
      new ceres::SubsetManifold{ViewUnknowns::kIntrinsics, {3, 4, 5, 6, 7}});  // distortion: as guessed
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 50;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.IsSolutionUsable() && unknowns.intrinsics[0] > 0 ? unknowns.view(start) : start;
}

/// Poses from which three beads are seen in three places (perspective three-point problem), near the guess.
std::vector<View> posesOf(const std::array<Eigen::Vector3d, 3>& beads, const std::array<Eigen::Vector2d, 3>& uv_px,
                          const View& guess) {
  // A mirrored view is solved in its mirror image.
  const double mirror = guess.R_CW.determinant() < 0 ? -1 : 1;
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (std::size_t i = 0; i < 3; ++i) {
    object.emplace_back(beads[i].x(), beads[i].y(), beads[i].z());
    const Eigen::Vector2d xy = (guess.R_CW * backProject(guess, uv_px[i]).direction_W).hnormalized();
    image.emplace_back(mirror * xy.x(), xy.y());
  }
  std::vector<cv::Mat> rotations, translations;
  cv::solveP3P(object, image, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotations, translations, cv::SOLVEPNP_AP3P);
  std::vector<View> poses;
  for (std::size_t k = 0; k < rotations.size(); ++k) {
    const cv::Mat &r = rotations[k], &t = translations[k];
    View view = guess;
    view.R_CW = rotationFromVector<double>({r.at<double>(0), r.at<double>(1), r.at<double>(2)});
    view.p_CW = {t.at<double>(0), t.at<double>(1), t.at<double>(2)};
    view.R_CW.row(0) *= mirror;
    view.p_CW[0] *= mirror;
    const double turn = Eigen::AngleAxisd{Eigen::Matrix3d{view.R_CW * guess.R_CW.transpose()}}.angle();
    if (view.p_CW.allFinite() && turn < kMaxTurn_rad && (view.p_CW - guess.p_CW).norm() < kMaxShift_m)
      poses.push_back(view);
  }
  return poses;
}

struct Hypothesis {
  View view;
  std::size_t score;
};

/// Search over triples of beads and their possible detections.
class PoseSearch {
 public:
  PoseSearch(const CalibrationObject& object, const std::vector<DetectedBead>& detected, const View& guess)
      : object_{object}, detected_{detected}, guess_{guess}, candidates_(object.beads.size()) {
    const double reach_px = kReach_m * std::get<ConeBeam>(guess.projection).fx_px / guess.p_CW.z();
    for (std::size_t b = 0; b < object.beads.size(); ++b) {
      const auto uv = project(guess, object.beads[b].p_WQ);
      for (std::size_t d = 0; uv && d < detected.size(); ++d)
        if ((*uv - detected[d].uv_px).norm() < reach_px && sizeFits(object.beads[b], detected[d], guess))
          candidates_[b].push_back(d);
      if (!candidates_[b].empty()) order_.push_back(b);
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return candidates_[a].size() < candidates_[b].size(); });
  }

  /// Best poses found, best first.
  std::vector<Hypothesis> run(const Job& job) {
    if (order_.size() < 3) return {};
    std::mt19937 random{17};  // fixed: the same images give the same calibration
    const std::size_t pool = std::min<std::size_t>(order_.size(), 12);
    const std::size_t enough = std::size_t(0.85 * double(std::min(object_.beads.size(), detected_.size())));
    for (int n = 0; n < kTriples && !job.cancelled(); ++n) {
      std::array<std::size_t, 3> triple;
      for (auto& b : triple) b = order_[random() % pool];
      if (wellSpread(triple)) tryTriple(triple);
      if (!best_.empty() && best_[0].score >= enough && n >= 8) break;
    }
    return best_;
  }

 private:
  bool wellSpread(const std::array<std::size_t, 3>& t) const {
    const Eigen::Vector3d a = object_.beads[t[0]].p_WQ, b = object_.beads[t[1]].p_WQ, c = object_.beads[t[2]].p_WQ;
    const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    return longest > 0 && (b - a).cross(c - a).norm() > 0.1 * longest * longest;
  }

  void tryTriple(const std::array<std::size_t, 3>& t) {
    const std::array<Eigen::Vector3d, 3> beads{object_.beads[t[0]].p_WQ, object_.beads[t[1]].p_WQ,
                                               object_.beads[t[2]].p_WQ};
    for (std::size_t i : candidates_[t[0]])
      for (std::size_t j : candidates_[t[1]])
        for (std::size_t k : candidates_[t[2]]) {
          if (i == j || j == k || k == i) continue;
          const std::array<Eigen::Vector2d, 3> uv{detected_[i].uv_px, detected_[j].uv_px, detected_[k].uv_px};
          for (const View& view : posesOf(beads, uv, guess_)) keep(view);
        }
  }

  void keep(const View& view) {
    const std::size_t score = nearestPairs(object_, detected_, view, 0.01 * diagonal_px(view)).size();
    if (score < 6 || (best_.size() == kKept && score <= best_.back().score)) return;
    best_.push_back({view, score});
    std::stable_sort(best_.begin(), best_.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
    if (best_.size() > kKept) best_.pop_back();
  }

  const CalibrationObject& object_;
  const std::vector<DetectedBead>& detected_;
  const View& guess_;
  std::vector<std::vector<std::size_t>> candidates_;  // by bead
  std::vector<std::size_t> order_;                    // beads, least ambiguous first
  std::vector<Hypothesis> best_;
};

}  // namespace

std::optional<BeadMatch> matchBeads(const CalibrationObject& object, const std::vector<DetectedBead>& detected,
                                    const View& guess, const Job& job) {
  require(std::holds_alternative<ConeBeam>(guess.projection), "the guess is a cone-beam view");
  std::optional<BeadMatch> best;
  const double tight_px = std::max(0.001 * diagonal_px(guess), 2.0);
  for (const Hypothesis& hypothesis : PoseSearch{object, detected, guess}.run(job)) {
    BeadMatch match{{}, hypothesis.view};
    for (const double reach : {0.01, 0.01, 0.005, 0.002, 0.001, 0.001}) {
      const double reach_px = std::max(reach * diagonal_px(guess), tight_px);
      match.pairs = nearestPairs(object, detected, match.view, reach_px);
      if (int(match.pairs.size()) < kMinBeads) break;
      match.view = refit(object, detected, match.pairs, match.view, reach_px / 5);
    }
    match.pairs = nearestPairs(object, detected, match.view, tight_px);
    if (int(match.pairs.size()) >= kMinBeads && (!best || match.pairs.size() > best->pairs.size())) best = match;
  }
  return best;
}

}  // namespace sinew
