#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/skeleton/fit/fit_noise_internal.h"
#include "core/skeleton/fit/fit_report_internal.h"
#include "core/skeleton/fit/fit_residuals.h"
#include "core/skeleton/fit/triangulated_figures_internal.h"

namespace sinew {

/// Sightings of one landmark that are used: indices into the list.
struct SightingBlock {
  int point = 0;
  std::vector<std::size_t> items;
};
std::vector<SightingBlock> blocksOf(const SightingList& sightings);

/// The sightings beside one body as the views have it, moved between its exposures: what lies how far apart, and how
/// far it may.
class SightingsBesideBody {
 public:
  /// `model` and `sightings` are kept by reference.
  SightingsBesideBody(const FitModel& model, const SightingList& sightings,
                      std::span<const DefinitionError> definitions, const Eigen::VectorXd& z,
                      const Eigen::VectorXd& y);

  /// Of every sighting; one behind a source is infinitely far away, with residual 0.
  std::vector<LandmarkResidual> residuals(const PickScale& scale) const;
  std::vector<double> distances_sigma(const PickScale& scale) const;
  /// Covariance of the sightings of every block, by its causes.
  std::vector<LandmarkNoise> noise(std::span<const SightingBlock> blocks) const;
  /// All picks of every landmark that are used, with the covariance of their errors.
  std::vector<LandmarkPicks> picks(std::span<const SightingBlock> blocks, const PickScale& scale) const;
  /// Images of these landmarks (indices into skeleton.landmarks) as this body's views have them.
  ImageOfPoint image(std::vector<int> landmarks) const;
  /// By landmark of the list: its own picks do not meet, by more than `excess` times what `scale` lets expect.
  std::vector<bool> contradictions(std::span<const SightingBlock> blocks, const PickScale& scale,
                                   double excess) const;

 private:
  /// Published covariance of a landmark's definition, in the world [m^2].
  Eigen::Matrix3d statedDefinition_W(int point) const;
  std::vector<std::vector<Eigen::Vector3d>> posed(const std::vector<int>& landmarks) const;  ///< by exposure

  const FitModel& model_;
  const SightingList& sightings_;
  std::span<const DefinitionError> definitions_;
  Eigen::VectorXd z_, y_;
  std::vector<DisturbedView> views_;
  std::vector<std::vector<Eigen::Vector3d>> points_;  ///< of the list's landmarks, by exposure
  std::vector<Eigen::Matrix3d> R_WB_;                 ///< of their bones
};

}  // namespace sinew
