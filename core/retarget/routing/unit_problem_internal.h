#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/retarget/prepared/routing_reference.h"
#include "core/retarget/routing/routing.h"

namespace sinew {

/// What is minimised: RoutingEnergy::total() and
struct Objective {
  /// a price of moving attachments away from where they are: the surface of their bone is flat only near them.
  double slide_1_m2 = 0;
  /// The same for via points, once they have come into a bone.
  double via_1_m2 = 0;
};

/// The routing energy of one unit in one new body as a function of the displacements of its points: three unknowns a
/// point, in metres of the reference body. Every point is p(x) = c + D x at every sample of every motion, which is
/// all that the energy needs to know of the skeleton.
class UnitProblem {
 public:
  struct Point {
    Eigen::Matrix3d basis_W = Eigen::Matrix3d::Zero();  ///< columns: where its unknowns take it, at the zero posture
    Eigen::Matrix3d basis_B = Eigen::Matrix3d::Zero();  ///< the same in the reference, in its segment's frame
    Eigen::Vector3d moved_B = Eigen::Vector3d::Zero();  ///< displacement so far, in the reference
    double price_1_m2 = 0;                              ///< of the whole displacement
    bool slides = false;                                ///< over a bone, which is flat only nearby
    Eigen::Vector3d outward_W = Eigen::Vector3d::Zero();  ///< away from the bone it glides on; zero: there is none
    double slack_m = 0;                                   ///< how far it may move towards that bone
  };
  /// `anchors`: of every point in the new body, where displacements count from. `zero_length_m`: what lengths are
  /// relative to.
  UnitProblem(const std::vector<std::vector<Anchor>>& anchors, const ReferenceCurves& reference,
              const MotionPoses& reference_poses, const MotionPoses& poses, const std::vector<Point>& points,
              double zero_length_m, const std::vector<RoutingMotion>& motions, const RoutingWeights& weights);

  /// One step of a length-angle curve (core/retarget/reversals.h) that must keep its direction.
  struct WatchedStep {
    std::size_t motion = 0;  ///< of those that the unit takes part in
    std::size_t step = 0;
    double direction = 1;
    double least = 0;   ///< how far it has to go, relative to the length at the zero posture
    double weight = 0;  ///< of the square of what it lacks
  };
  /// From now on a price is asked for these steps, beyond RoutingEnergy. `anchors`: where the points are.
  void watch(std::vector<WatchedStep> steps, const std::vector<std::vector<Anchor>>& anchors);
  double watchedPrice() const;  ///< of the points where they are

  /// The same unit, its points elsewhere.
  void moveTo(const std::vector<std::vector<Anchor>>& anchors, const std::vector<Point>& points);
  void movePoint(std::size_t p, const std::vector<Anchor>& anchors, const Point& point);

  int unknowns() const { return 3 * static_cast<int>(points_.size()); }
  bool isFree() const;  ///< any point may move, and there is something to compare
  /// Whether a piece of the path points the other way at `to` than at `from`, at the zero posture: its ends have
  /// changed places, which the cross product of directions does not notice.
  bool turnsAround(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;

  RoutingEnergy parts(const Eigen::VectorXd& x) const;
  double energy(const Eigen::VectorXd& x, Objective objective = {}) const;
  /// The gradient is exact but for the places where an extremum jumps.
  double energy(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const;

  /// Gauss-Newton expansion: E(x + d) ~ energy + gradient.d + d.hessian d / 2; the lower triangle is filled.
  struct Expansion {
    double energy = 0;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
  };
  void expand(const Eigen::VectorXd& x, Objective objective, Expansion& expansion) const;

 private:
  enum class Order { Value, Gradient, Hessian };  ///< how much is asked for
  struct Place {                                  ///< of one point at one sample
    Eigen::Vector3d c;
    Eigen::Matrix3d D;
  };
  /// A piece of the path whose ends do not move against each other in a motion shapes no curve. If its bone also
  /// turns as in the reference, its direction is the same all the way, and in all such motions: one sample says all.
  struct RigidPiece {
    std::size_t motion, piece;
    double weight = 0;
  };
  struct MovingPiece {
    std::size_t piece;
    bool changes_length;
  };
  void placePoint(std::size_t p, const std::vector<Anchor>& anchors);
  void placeWatched(std::size_t p, const std::vector<Anchor>& anchors);
  using Bases = std::array<Eigen::Matrix3d, 8>;
  Bases basesOf(std::size_t p, const std::vector<Anchor>& anchors) const;
  static Place placed(const std::vector<Anchor>& anchors, const Bases& bases_B, const MotionPoses::Poses& X_WB);
  void sortPieces(const std::vector<std::vector<Anchor>>& anchors, const MotionPoses& reference_poses);
  bool changesLength(std::size_t motion) const { return changes_length_[motion]; }

  template <Order kOrder>
  double evaluate(const Eigen::VectorXd& x, Objective objective, RoutingEnergy& parts, Expansion& e) const;
  struct PieceSum;
  template <Order kOrder>
  void addSample(const Eigen::VectorXd& x, std::size_t row, std::size_t piece, double weight, int length_of,
                 PieceSum& sum) const;
  template <Order kOrder>
  static double collect(const PieceSum& sum, std::size_t piece, Expansion& e);
  template <Order kOrder>
  double addFeatures(std::size_t motion) const;
  template <Order kOrder>
  double addCurve(std::size_t motion, double weight) const;
  template <Order kOrder>
  double addReversals(std::size_t motion) const;
  Eigen::MatrixXd::ColXpr addResidual(double residual) const;
  template <Order kOrder>
  void addResiduals(Expansion& e) const;
  template <Order kOrder>
  double addPrices(const Eigen::VectorXd& x, Objective objective, Expansion& e, double& slide) const;
  template <Order kOrder>
  double addCrowding(const Eigen::VectorXd& x, Expansion& e) const;
  double addWatched(const Eigen::VectorXd& x, Order order, Expansion& e) const;
  double watchedLength(const Eigen::VectorXd& x, const Place* places, double sign, Eigen::VectorXd* slope) const;

  static constexpr double kLeastPiece_m = 0.001;  ///< what is shorter is no piece of the path

  const ReferenceCurves* reference_;
  const MotionPoses* poses_;
  RoutingWeights weights_;
  std::vector<Point> points_;
  std::vector<double> motion_weight_;
  std::vector<Place> places_;      ///< [motion][sample][point]
  std::vector<Place> zero_;        ///< by point, at the zero posture
  std::vector<double> lengths_m_;  ///< by piece, at the zero posture, where the problem began
  std::vector<RigidPiece> rigid_;
  std::vector<std::vector<MovingPiece>> moving_;  ///< by motion: the other pieces
  std::vector<bool> changes_length_;              ///< by motion: any of them
  std::vector<WatchedStep> watched_;
  std::vector<Place> watched_places_;  ///< [watched step][its begin, its end][point]
  double zero_length_m_;

  // Working memory of one evaluation: a problem belongs to one thread.
  mutable std::vector<double> lengths_;    ///< of the present motion, relative, without rigid pieces
  mutable Eigen::MatrixXd length_slopes_;  ///< unknowns x samples
  mutable Eigen::VectorXd mean_slope_;
  mutable Eigen::MatrixXd residual_slopes_;  ///< unknowns x residuals, of which the first residual_count_ are in use
  mutable Eigen::VectorXd residuals_;
  mutable Eigen::Index residual_count_ = 0;
};

}  // namespace sinew
