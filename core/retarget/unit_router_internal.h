#pragma once
#include <Eigen/Core>
#include <stop_token>
#include <vector>

#include "core/retarget/minimize_internal.h"
#include "core/retarget/routing.h"
#include "core/retarget/routing_reference.h"

namespace sinew {

/// Finds the path of one unit in a new body. Its points are displaced in the reference and carried over by the field:
/// via points freely, attachments over the surface of their bone.
class UnitRouter {
 public:
  UnitRouter(const Model& reference, const RoutingReference& prepared, const std::vector<double>& shape,
             const MotionPoses& poses, const RoutingOptions& options)
      : reference_{reference}, prepared_{prepared}, shape_{shape}, poses_{poses}, options_{options} {}

  /// Moves the points of `unit`, the i-th of the model, anchored naively.
  UnitRouting operator()(std::size_t i, MusculotendonUnit& unit, const std::stop_token& stop) const;

 private:
  /// The points of a unit with the directions in which they can move on from there.
  struct Place {
    std::vector<std::vector<Anchor>> anchors;  ///< by point
    std::vector<UnitProblem::Point> points;
    RoutingEnergy energy;
  };

  UnitProblem::Point pointOf(std::size_t unit, std::size_t p, const PathPoint& naive) const;
  void setBasis(const Anchor& anchor, const Eigen::Vector3d& p_B, const Eigen::Matrix3d& basis_B,
                UnitProblem::Point& point) const;
  void setGuard(std::size_t unit, std::size_t p, const std::vector<Anchor>& anchors, UnitProblem::Point& point) const;
  Place moved(std::size_t i, const Place& from, const Eigen::VectorXd& x, UnitProblem& problem) const;
  void slide(std::size_t unit, std::size_t p, UnitProblem::Point& point, Anchor& anchor) const;
  Place descended(std::size_t i, const Place& naive, UnitProblem& problem, int& iterations,
                  const std::stop_token& stop) const;
  Place solved(std::size_t i, const Place& naive, UnitProblem& problem, int& iterations,
               const std::stop_token& stop) const;
  Minimum bestOfStarts(const UnitProblem& problem, double slide_1_m2, const std::stop_token& stop) const;
  double largestMove_m(const Place& before, const Place& after) const;
  double total(const RoutingEnergy& energy) const { return energy.total(options_.weights); }

  const Model& reference_;
  const RoutingReference& prepared_;
  const std::vector<double>& shape_;
  const MotionPoses& poses_;
  const RoutingOptions& options_;
};

}  // namespace sinew
