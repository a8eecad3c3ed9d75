#include "imaging/calibration/detect_beads.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace sinew {
namespace {

constexpr double kMaxElongation = 1.35;  // of the half-level shape; a ball's shadow at 25 deg obliquity has 1.1
constexpr double kMinFill = 0.9;    // its area over that of the ellipse with the same moments; letters have holes
constexpr double kMaxUnrest = 0.3;  // scatter of the surroundings over the step; an edge or a letter has more
constexpr std::size_t kEnoughBeads = 6;

struct Candidate {
  double u, v, diameter;
};

/// Local maxima of differences of Gaussians, octave by octave; a disc of diameter d answers most to sigma = d / 2.6.
std::vector<Candidate> candidates(const cv::Mat& dense, const BeadDetectionOptions& options, const Job& job) {
  std::vector<Candidate> found;
  cv::Mat octave = dense;
  double scale = 1;  // full pixels per pixel of the octave
  while (options.min_diameter_px / scale < options.max_diameter_px / scale &&
         std::min(octave.rows, octave.cols) > 24) {
    if (job.cancelled()) return {};
    for (const double diameter : {4.0, 5.7}) {
      const double full = diameter * scale;
      if (full < 0.7 * options.min_diameter_px || full > 1.4 * options.max_diameter_px) continue;
      cv::Mat inner, outer, top;
      cv::GaussianBlur(octave, inner, {}, diameter / 3.3);
      cv::GaussianBlur(octave, outer, {}, diameter / 2.06);
      inner -= outer;
      cv::dilate(inner, top, cv::Mat::ones(5, 5, CV_8U));
      // Scatter of the answer, robustly: most of the image is empty.
      cv::Scalar mean, deviation;
      cv::meanStdDev(cv::abs(inner), mean, deviation);
      const float least = float(mean[0]);
      for (int v = 2; v < inner.rows - 2; ++v)
        for (int u = 2; u < inner.cols - 2; ++u)
          if (const float answer = inner.at<float>(v, u); answer > 3 * least && answer == top.at<float>(v, u))
            found.push_back({(u + 0.5) * scale - 0.5, (v + 0.5) * scale - 0.5, full});
    }
    if (scale * 4 > options.max_diameter_px) break;
    cv::Mat half;
    cv::resize(octave, half, {octave.cols / 2, octave.rows / 2}, 0, 0, cv::INTER_AREA);
    octave = half;
    scale *= 2;
  }
  return found;
}

/// What surrounds a candidate: a plane, and the scatter about it.
struct Surroundings {
  Eigen::Vector3d plane;  ///< value = plane . (1, du, dv)
  double scatter;
};

/// Calls `visit(u, v, r2)` for the pixels within `radius` of a centre.
template <class Visit>
void forDisc(const Eigen::Vector2d& centre, double radius, Visit&& visit) {
  for (int v = int(std::ceil(centre.y() - radius)); v <= centre.y() + radius; ++v)
    for (int u = int(std::ceil(centre.x() - radius)); u <= centre.x() + radius; ++u) {
      const double r2 = (Eigen::Vector2d{u, v} - centre).squaredNorm();
      if (r2 <= radius * radius) visit(u, v, r2);
    }
}

Surroundings surroundings(const cv::Mat& dense, const Eigen::Vector2d& centre, double inner, double outer) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double sum2 = 0, count = 0;
  forDisc(centre, outer, [&](int u, int v, double r2) {
    if (r2 < inner * inner) return;
    const Eigen::Vector3d basis{1, u - centre.x(), v - centre.y()};
    const double value = dense.at<float>(v, u);
    normal += basis * basis.transpose();
    right += basis * value;
    sum2 += value * value;
    ++count;
  });
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  const double rest = std::max(sum2 - plane.dot(right), 0.0);
  return {plane, std::sqrt(rest / std::max(count - 3, 1.0))};
}

double above(const cv::Mat& dense, const Surroundings& around, const Eigen::Vector2d& centre, int u, int v) {
  return dense.at<float>(v, u) - around.plane.dot(Eigen::Vector3d{1, u - centre.x(), v - centre.y()});
}

/// Zeroth to second moments of the pixels above half of the step.
struct HalfShape {
  double area = 0, elongation = 0, fill = 0;
};

HalfShape halfShape(const cv::Mat& dense, const Surroundings& around, const Eigen::Vector2d& centre, double radius,
                    double step) {
  double area = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  forDisc(centre, radius, [&](int u, int v, double) {
    // A pixel counts by the part of it that is above: a quarter to three quarters of the step.
    const double part = std::clamp(2 * above(dense, around, centre, u, v) / step - 0.5, 0.0, 1.0);
    const Eigen::Vector2d d = Eigen::Vector2d{u, v} - centre;
    area += part;
    first += part * d;
    second += part * d * d.transpose();
  });
  if (area < 4) return {};
  const Eigen::Matrix2d covariance = second / area - first * first.transpose() / (area * area);
  const Eigen::Vector2d e = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>{covariance}.eigenvalues();
  if (!(e[0] > 0)) return {};
  return {area, std::sqrt(e[1] / e[0]), area / (4 * M_PI * std::sqrt(e[0] * e[1]))};
}

std::optional<DetectedBead> refined(const cv::Mat& dense, const Candidate& candidate,
                                    const BeadDetectionOptions& options) {
  Eigen::Vector2d centre{candidate.u, candidate.v};
  double diameter = candidate.diameter, step = 0;
  Surroundings around{};
  for (int iteration = 0; iteration < 40; ++iteration) {
    const double reach = 1.35 * diameter + 2;
    if (centre.x() < reach || centre.y() < reach || centre.x() > dense.cols - 1 - reach ||
        centre.y() > dense.rows - 1 - reach)
      return std::nullopt;
    around = surroundings(dense, centre, 0.9 * diameter + 1, reach);
    double inside = 0, count = 0;
    forDisc(centre, std::max(0.25 * diameter, 1.0), [&](int u, int v, double) {
      inside += above(dense, around, centre, u, v);
      ++count;
    });
    step = inside / count;
    if (!(step > options.min_contrast_to_noise * around.scatter / 2)) return std::nullopt;

    // Windowed centroid; the window's soft edge keeps single pixels from popping in and out.
    const double window = 0.75 * diameter + 1;
    double weight = 0, area = 0;
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    forDisc(centre, window + 0.5, [&](int u, int v, double r2) {
      const double value = above(dense, around, centre, u, v);
      const double w = value * std::clamp(window + 0.5 - std::sqrt(r2), 0.0, 1.0);
      weight += w;
      moment += w * (Eigen::Vector2d{u, v} - centre);
      area += std::clamp(2 * value / step - 0.5, 0.0, 1.0);
    });
    if (!(weight > 0)) return std::nullopt;
    const Eigen::Vector2d shift = moment / weight;
    if (shift.norm() > candidate.diameter) return std::nullopt;
    centre += shift;
    const double measured = 2 * std::sqrt(area / M_PI);
    if (measured < 0.5 * options.min_diameter_px || measured > 1.5 * options.max_diameter_px) return std::nullopt;
    // The window is frozen after a few rounds, so that the centre can settle.
    if (iteration < 10) diameter = 0.5 * (diameter + measured);
    if (iteration >= 10 && shift.norm() < 1e-4) break;
  }
  const HalfShape shape = halfShape(dense, around, centre, 0.9 * diameter + 1, step);
  diameter = 2 * std::sqrt(shape.area / M_PI);
  if (shape.area == 0 || shape.elongation > kMaxElongation || shape.fill < kMinFill || shape.fill > 1.1 ||
      around.scatter > kMaxUnrest * step || step < options.min_contrast_to_noise * around.scatter ||
      diameter < options.min_diameter_px || diameter > options.max_diameter_px)
    return std::nullopt;
  // Error of the centroid: noise * sqrt(sum of x^2 over the window) / sum of the weights.
  const double window = 0.75 * diameter + 1;
  const double noise_px = around.scatter / step * std::sqrt(M_PI / 4) * window * window / shape.area;
  return DetectedBead{centre, diameter, step, std::hypot(0.02, noise_px)};
}

std::vector<DetectedBead> detectDense(const cv::Mat& dense, const BeadDetectionOptions& options, const Job& job) {
  std::vector<DetectedBead> beads;
  for (const Candidate& candidate : candidates(dense, options, job)) {
    if (job.cancelled()) return {};
    const auto bead = refined(dense, candidate, options);
    if (!bead) continue;
    const auto same = std::find_if(beads.begin(), beads.end(), [&](const DetectedBead& other) {
      return (other.uv_px - bead->uv_px).norm() < 0.5 * std::max(other.diameter_px, bead->diameter_px);
    });
    if (same == beads.end())
      beads.push_back(*bead);
    else if (bead->sigma_px < same->sigma_px)
      *same = *bead;
  }
  std::sort(beads.begin(), beads.end(),
            [](const DetectedBead& a, const DetectedBead& b) { return a.contrast > b.contrast; });
  return beads;
}

}  // namespace

std::vector<DetectedBead> detectBeads(const Radiograph& image, const BeadDetectionOptions& options, const Job& job) {
  require(image.pixels != nullptr, "radiograph has pixels");
  const cv::Mat stored{image.height_px, image.width_px, CV_16U, const_cast<std::uint16_t*>(image.pixels->data())};
  cv::Mat dense;
  stored.convertTo(dense, CV_32F, image.monochrome1 ? -1 : 1);
  auto beads = detectDense(dense, options, job);
  if (beads.size() < kEnoughBeads && !job.cancelled()) {
    auto opposite = detectDense(-dense, options, job);
    if (opposite.size() > beads.size()) beads = std::move(opposite);
  }
  return beads;
}

}  // namespace sinew
