#pragma once
#include <Eigen/Core>
#include <stop_token>
#include <vector>

#include "core/retarget/prepared/routing_reference.h"
#include "core/retarget/routing/body_bones_internal.h"
#include "core/retarget/routing/minimize_internal.h"
#include "core/retarget/routing/routing.h"

namespace sinew {

/// Finds the path of one unit in a new body. Its points are displaced in the reference and carried over by the field:
/// via points freely but for the bones, attachments over the surface of theirs.
class UnitRouter {
 public:
  UnitRouter(const Model& reference, const RoutingReference& prepared, const std::vector<double>& shape,
             const MotionPoses& poses, const BodyBones& bones, const RoutingOptions& options)
      : reference_{reference}, prepared_{prepared}, shape_{shape}, poses_{poses}, bones_{bones}, options_{options} {}

  /// Moves the points of `unit`, the i-th of the model, anchored naively.
  UnitRouting operator()(std::size_t i, MusculotendonUnit& unit, const std::stop_token& stop) const;

  /// Whether all via points of the i-th unit lie outside the bones and its attachments on theirs.
  bool fits(std::size_t i, const MusculotendonUnit& unit) const;

 private:
  /// The points of a unit with the directions in which they can move on from there.
  struct Place {
    std::vector<std::vector<Anchor>> anchors;  ///< by point
    std::vector<UnitProblem::Point> points;
    std::vector<double> free_m;  ///< by point: so far it can move without coming into a bone; 0: not known
    RoutingEnergy energy;
    double objective = 0;  ///< its total, and the price of watched steps
    bool fits = true;      ///< via points outside bones; when settled, attachments on them
    bool settled = false;  ///< attachments are on the new body's bones, not merely where the field carries them
  };

  // unit_places.cpp: where points can be.
  Place naivePlace(std::size_t i, const MusculotendonUnit& unit) const;
  bool settle(std::size_t i, Place& place) const;
  bool pushViasOut(std::size_t i, Place& place) const;
  UnitProblem::Point pointOf(std::size_t unit, std::size_t p, const PathPoint& naive) const;
  void setBasis(const Anchor& anchor, const Eigen::Vector3d& p_B, const Eigen::Matrix3d& basis_B,
                UnitProblem::Point& point) const;
  void setGuard(int bone, double kept_m, const std::vector<Anchor>& anchors, UnitProblem::Point& point) const;
  Place moved(std::size_t i, const Place& from, const Eigen::VectorXd& x, UnitProblem& problem) const;
  void slide(std::size_t unit, std::size_t p, UnitProblem::Point& point, Anchor& anchor) const;
  bool putOntoBone(const PointGuide& guide, UnitProblem::Point& point, Anchor& anchor, double& free_m) const;
  bool pushOut(const PointGuide& guide, UnitProblem::Point& point, std::vector<Anchor>& anchors,
               double& free_m) const;
  struct Inside {
    int bone = -1;      ///< that is the nearest or that the point is deepest in
    double distance_m;  ///< at least; negative inside
  };
  Inside nearestOf(const std::vector<int>& bones, int segment, int but, const Eigen::Vector3d& p_W) const;
  void displace(const Eigen::Vector3d& d_W, UnitProblem::Point& point, std::vector<Anchor>& anchors) const;
  Eigen::Vector3d atRest(const std::vector<Anchor>& anchors) const;
  void evaluate(Place& place, const UnitProblem& problem) const;
  double largestMove_m(const Place& before, const Place& after) const;

  // unit_router.cpp: the search.
  Place rounds(std::size_t i, const Place& start, Minimum step, double slide_1_m2, UnitProblem& problem,
               int& iterations, const std::stop_token& stop) const;
  Place onwards(std::size_t i, const Place& from, Objective objective, UnitProblem& problem, int& iterations,
                const std::stop_token& stop) const;
  Place descended(std::size_t i, const Place& start, UnitProblem& problem, int& iterations,
                  const std::stop_token& stop) const;
  Place solved(std::size_t i, const Place& start, UnitProblem& problem, int& iterations,
               const std::stop_token& stop) const;
  Minimum bestOfStarts(const UnitProblem& problem, double slide_1_m2, const std::stop_token& stop) const;
  double total(const RoutingEnergy& energy) const { return energy.total(options_.weights); }

  // unit_order.cpp: no step of a length-angle curve reversed.
  StepCount reversals(std::size_t i, const Place& place, std::vector<UnitProblem::WatchedStep>* reversed) const;
  Place inOrder(std::size_t i, const Place& naive, const Place& found, UnitProblem& problem, int& iterations,
                const std::stop_token& stop) const;
  Place between(std::size_t i, const Place& from, const Place& to, double share, UnitProblem& problem) const;
  Place watchedFrom(std::size_t i, const Place& from, int allowed, double first_weight,
                    std::vector<UnitProblem::WatchedStep>& watched, UnitProblem& problem, int& iterations,
                    const std::stop_token& stop) const;

  const Model& reference_;
  const RoutingReference& prepared_;
  const std::vector<double>& shape_;
  const MotionPoses& poses_;
  const BodyBones& bones_;
  const RoutingOptions& options_;
};

}  // namespace sinew
