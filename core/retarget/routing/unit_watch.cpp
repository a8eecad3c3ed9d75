#include <algorithm>
#include <utility>

#include "core/retarget/routing/unit_problem_internal.h"

// Steps of length-angle curves that UnitProblem is told to keep in their direction.

namespace sinew {

void UnitProblem::watch(std::vector<WatchedStep> steps, const std::vector<std::vector<Anchor>>& anchors) {
  watched_ = std::move(steps);
  watched_places_.resize(2 * watched_.size() * points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p) placeWatched(p, anchors[p]);
}

void UnitProblem::placeWatched(std::size_t p, const std::vector<Anchor>& anchors) {
  if (watched_.empty()) return;
  const Bases bases_B = basesOf(p, anchors);
  for (std::size_t w = 0; w < watched_.size(); ++w) {
    const auto& poses = poses_->over(reference_->motions[watched_[w].motion]);
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}})
      watched_places_[(2 * w + end) * points_.size() + p] = placed(anchors, bases_B, poses[watched_[w].step + end]);
  }
}

/// Relative length of the path at one pose; its slope, times `sign`, is added.
double UnitProblem::watchedLength(const Eigen::VectorXd& x, const Place* places, double sign,
                                  Eigen::VectorXd* slope) const {
  double length = 0;
  for (std::size_t p = 0; p + 1 < points_.size(); ++p) {
    const auto a = static_cast<Eigen::Index>(3 * p), b = a + 3;
    const Eigen::Vector3d piece =
        (places[p + 1].c + places[p + 1].D * x.segment<3>(b)) - (places[p].c + places[p].D * x.segment<3>(a));
    const double norm = std::max(piece.norm(), 1e-9);
    length += norm / zero_length_m_;
    if (!slope) continue;
    const Eigen::Vector3d along = piece * (sign / (norm * zero_length_m_));
    slope->segment<3>(a) -= places[p].D.transpose() * along;
    slope->segment<3>(b) += places[p + 1].D.transpose() * along;
  }
  return length;
}

double UnitProblem::addWatched(const Eigen::VectorXd& x, Order order, Expansion& e) const {
  double energy = 0;
  Eigen::VectorXd slope;
  for (std::size_t w = 0; w < watched_.size(); ++w) {
    const WatchedStep& step = watched_[w];
    const Place *begin = &watched_places_[2 * w * points_.size()], *end = begin + points_.size();
    if (order != Order::Value) slope.setZero(unknowns());
    Eigen::VectorXd* wanted = order == Order::Value ? nullptr : &slope;
    const double lacking = step.direction * (watchedLength(x, end, step.direction, wanted) -
                                             watchedLength(x, begin, -step.direction, wanted)) -
                           step.least;
    if (lacking >= 0) continue;
    energy += step.weight * lacking * lacking;
    if (order != Order::Value) e.gradient += 2 * step.weight * lacking * slope;
    if (order == Order::Hessian) e.hessian.selfadjointView<Eigen::Lower>().rankUpdate(slope, 2 * step.weight);
  }
  return energy;
}

double UnitProblem::watchedPrice() const {
  Expansion unused;
  return addWatched(Eigen::VectorXd::Zero(unknowns()), Order::Value, unused);
}

}  // namespace sinew
