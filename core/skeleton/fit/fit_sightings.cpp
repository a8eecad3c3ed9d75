#include "core/skeleton/fit/fit_sightings_internal.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/skeleton/fit/posed_landmarks_internal.h"

namespace sinew {

std::vector<SightingBlock> blocksOf(const SightingList& sightings) {
  std::vector<SightingBlock> blocks(sightings.landmarks.size());
  for (std::size_t i = 0; i < sightings.items.size(); ++i) {
    const auto& s = sightings.items[i];
    blocks[s.point].point = s.point;
    if (!s.left_out) blocks[s.point].items.push_back(i);
  }
  std::erase_if(blocks, [](const SightingBlock& block) { return block.items.empty(); });
  return blocks;
}

SightingsBesideBody::SightingsBesideBody(const FitModel& model, const SightingList& sightings,
                                         std::span<const DefinitionError> definitions, const Eigen::VectorXd& z,
                                         const Eigen::VectorXd& y)
    : model_{model},
      sightings_{sightings},
      definitions_{definitions},
      z_{z},
      y_{y},
      views_{disturbedViews(model.views, model.nuisances, y, model.pivot_W)},
      points_{posed(sightings.landmarks)} {
  std::vector<double> shape, q;
  model.body.expand<double>({z.data(), static_cast<std::size_t>(z.size())}, shape, q);
  const auto X_WB = posedSegments<double>(model.skeleton, shape, q);
  for (const int index : sightings.landmarks) R_WB_.push_back(X_WB[model.skeleton.landmarks[index].segment].linear());
}

std::vector<std::vector<Eigen::Vector3d>> SightingsBesideBody::posed(const std::vector<int>& landmarks) const {
  std::vector<std::vector<Eigen::Vector3d>> points;
  for (int e = 0; e < model_.nuisances.exposureCount(); ++e)
    points.push_back(posePoints(model_.skeleton, model_.body, landmarks, model_.nuisances.bodyAt(e, z_, y_), {}).p_W);
  return points;
}

Eigen::Matrix3d SightingsBesideBody::statedDefinition_W(int point) const {
  const std::string& name = model_.skeleton.landmarks[sightings_.landmarks[point]].name;
  const auto stated = std::ranges::find(definitions_, name, &DefinitionError::landmark);
  if (stated == definitions_.end()) return Eigen::Matrix3d::Zero();
  return R_WB_[point] * stated->covariance_B_m2 * R_WB_[point].transpose();
}

std::vector<LandmarkResidual> SightingsBesideBody::residuals(const PickScale& scale) const {
  constexpr double kMm_m = 1e-3;
  std::vector<LandmarkResidual> list;
  for (const auto& s : sightings_.items) {
    LandmarkResidual residual{s.landmark, s.view, Eigen::Vector2d::Zero(), std::numeric_limits<double>::infinity()};
    PointImage image;
    if (views_[s.view].image(points_[model_.nuisances.exposureOf(s.view)][s.point], image)) {
      const Eigen::Matrix3d definition_W = std::pow(scale.definition, 2) * statedDefinition_W(s.point) +
                                           std::pow(kMm_m * scale.blur_mm, 2) * Eigen::Matrix3d::Identity();
      const Eigen::Matrix2d covariance_px2 = std::pow(scale.pick * s.sigma_px, 2) * Eigen::Matrix2d::Identity() +
                                             image.by_point * definition_W * image.by_point.transpose();
      residual.residual_px = s.uv_px - image.uv_px;
      residual.sigmas = std::sqrt(residual.residual_px.dot(covariance_px2.inverse() * residual.residual_px));
    }
    list.push_back(residual);
  }
  return list;
}

std::vector<double> SightingsBesideBody::distances_sigma(const PickScale& scale) const {
  std::vector<double> sigmas;
  for (const auto& residual : residuals(scale)) sigmas.push_back(residual.sigmas);
  return sigmas;
}

std::vector<LandmarkNoise> SightingsBesideBody::noise(std::span<const SightingBlock> blocks) const {
  std::vector<LandmarkNoise> list;
  for (const SightingBlock& block : blocks) {
    const Eigen::Index rows = 2 * static_cast<Eigen::Index>(block.items.size());
    LandmarkNoise noise{Eigen::MatrixXd::Zero(rows, rows), {}, {}};
    Eigen::MatrixXd by_point = Eigen::MatrixXd::Zero(rows, 3);
    for (Eigen::Index i = 0; i < rows / 2; ++i) {
      const auto& s = sightings_.items[block.items[i]];
      noise.pick.diagonal().segment<2>(2 * i).setConstant(s.sigma_px * s.sigma_px);
      PointImage image;
      if (views_[s.view].image(points_[model_.nuisances.exposureOf(s.view)][s.point], image))
        by_point.middleRows<2>(2 * i) = image.by_point;
    }
    noise.definition = by_point * statedDefinition_W(block.point) * by_point.transpose();
    noise.blur = by_point * by_point.transpose();
    list.push_back(std::move(noise));
  }
  return list;
}

std::vector<LandmarkPicks> SightingsBesideBody::picks(std::span<const SightingBlock> blocks,
                                                      const PickScale& scale) const {
  const auto noise_of = noise(blocks);
  std::vector<LandmarkPicks> list;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const SightingBlock& block = blocks[b];
    LandmarkPicks picks{sightings_.landmarks[block.point], {}, {}, noise_of[b].at(scale)};
    picks.uv_px.resize(2 * static_cast<Eigen::Index>(block.items.size()));
    for (std::size_t k = 0; k < block.items.size(); ++k) {
      picks.views.push_back(sightings_.items[block.items[k]].view);
      picks.uv_px.segment<2>(2 * static_cast<Eigen::Index>(k)) = sightings_.items[block.items[k]].uv_px;
    }
    list.push_back(std::move(picks));
  }
  return list;
}

ImageOfPoint SightingsBesideBody::image(std::vector<int> landmarks) const {
  auto points = posed(landmarks);
  return [&model = model_, unknowns = y_.size(), views = views_, landmarks = std::move(landmarks),
          points = std::move(points)](int landmark, int view, const Eigen::Vector3d& p_W, SeenImage& seen) {
    const auto l = static_cast<std::size_t>(std::ranges::find(landmarks, landmark) - landmarks.begin());
    const Eigen::Vector3d moved = points[model.nuisances.exposureOf(view)][l] - points.front()[l];
    PointImage image;
    if (!views[view].image(p_W + moved, image)) return false;
    seen.uv_px = image.uv_px;
    seen.by_point = image.by_point;
    seen.by_nuisance = Eigen::Matrix2Xd::Zero(2, unknowns);
    const Nuisances::Local& local = model.nuisances.local(view);
    for (int k = 0; k < Nuisances::kLocal; ++k)
      if (local.y[k] >= 0) seen.by_nuisance.col(local.y[k]) = image.by_local.col(k);
    return true;
  };
}

std::vector<bool> SightingsBesideBody::contradictions(std::span<const SightingBlock> blocks, const PickScale& scale,
                                                      double excess) const {
  constexpr double kContradicts_sigma = 5;
  const ImageOfPoint image_of = image(sightings_.landmarks);
  std::vector<bool> contradicts(sightings_.landmarks.size(), false);
  const auto picked = picks(blocks, scale);
  for (std::size_t b = 0; b < picked.size(); ++b) {
    const int point = blocks[b].point;
    const auto met = pickedPoint(picked[b], image_of, points_.front()[point]);
    contradicts[point] = met && met->disagreement > kContradicts_sigma * excess;
  }
  return contradicts;
}

}  // namespace sinew
