#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/skeleton/fit/bone_figure.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

// The clinical figures as plain triangulation gives them: every landmark where its own picks say, whatever the shape
// of its bone. They know nothing of the model, so they have no bias where a bone is outside its family; they are
// wider than the fitted ones, because nothing is smoothed.

/// Image of a point, with derivatives by the point and by what disturbs the views (movement, errors of the geometry).
struct SeenImage {
  Eigen::Vector2d uv_px;
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix2Xd by_nuisance;  ///< no columns where nothing disturbs
};
/// False behind the source. The point is the place of this landmark (index into skeleton.landmarks) at the first
/// exposure.
using ImageOfPoint = std::function<bool(int landmark, int view, const Eigen::Vector3d& p_W, SeenImage& image)>;

/// All picks of one landmark, and the covariance of their errors (two rows a pick).
struct LandmarkPicks {
  int landmark = 0;  ///< index into skeleton.landmarks
  std::vector<int> views;
  Eigen::VectorXd uv_px;
  Eigen::MatrixXd covariance_px2;
};

/// Where the picks of a landmark meet.
struct PickedPoint {
  int landmark = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_W_m2 = Eigen::Matrix3d::Zero();
  double disagreement = 0;       ///< root of (sum of squares of the residuals in sigmas / their degrees of freedom)
  Eigen::Matrix3Xd by_nuisance;  ///< derivative of p_W by what disturbs the views
};
/// nullopt if the picks leave a direction open (one view, rays within some degrees of parallel): SD above 0.1 m.
/// @param start_W somewhere near.
std::optional<PickedPoint> pickedPoint(const LandmarkPicks& picks, const ImageOfPoint& image,
                                       const Eigen::Vector3d& start_W);

/// Values and SDs in the order of figureList(); NaN where the picks do not give a figure. Knee and ankle centre,
/// which nobody picks, come from the landmarks around them: the similarity that takes these of the reference to the
/// picks.
struct TriangulatedFigures {
  std::vector<double> value, sd;
};
/// @param nuisance_covariance of what disturbs the views, at the solution of the fit.
TriangulatedFigures triangulatedFigures(const Skeleton& reference, std::span<const PickedPoint> points,
                                        const Eigen::MatrixXd& nuisance_covariance = {});

}  // namespace sinew
