#include "core/foreign/foreign_kinematics.h"

#include <limits>

#include "core/foreign/foreign_kinematics_internal.h"
#include "core/foreign/foreign_wrap.h"

namespace sinew {
namespace {

using Dual = ceres::Jet<double, 1>;

std::span<const double> asSpan(const Eigen::VectorXd& q) {
  return {q.data(), static_cast<std::size_t>(q.size())};
}

/// The posture with the derivative of every coordinate by one of them.
std::vector<Dual> seeded(const ForeignModel& model, const ForeignPosture& q, int coordinate) {
  std::vector<Dual> duals(q.begin(), q.end());
  duals[static_cast<std::size_t>(coordinate)].v[0] = 1;
  followCouplings<Dual>(model, duals);
  return duals;
}

std::vector<PathNode> activePoints(const ForeignPath& path, std::span<const double> q,
                                   const std::vector<RigidTransform>& X_WB) {
  constexpr double kTolerance = 1e-5;  // OpenSim's, at the ends of a conditional point's range
  std::vector<PathNode> nodes;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const ForeignPathPoint& point = path.points[i];
    if (const auto& c = point.condition) {
      const double x = q[static_cast<std::size_t>(c->coordinate)];
      if (x < c->min - kTolerance || x > c->max + kTolerance) continue;
    }
    PathNode node{.point = &point, .body = point.body, .index = static_cast<int>(i)};
    node.p_B = point.X_BF * evaluated(point.p_F, q);
    node.p_W = inWorld<double>(X_WB, node.body, node.p_B);
    nodes.push_back(node);
  }
  return nodes;
}

/// Puts the contacts with one obstacle into the path: between the two neighbours where that lengthens it least.
void meetObstacle(const WrapObject& object, const PathWrap& wrap, int wrap_index,
                  const std::vector<RigidTransform>& X_WB, std::vector<PathNode>& nodes) {
  std::erase_if(nodes, [&](const PathNode& n) { return n.wrap == wrap_index; });
  const RigidTransform X_WO =
      object.body < 0 ? object.X_BO : X_WB[static_cast<std::size_t>(object.body)] * object.X_BO;
  std::optional<WrapContact> best;
  std::size_t at = 0;
  double least_m = std::numeric_limits<double>::infinity();
  bool inside = wrap.first_point < 0;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    inside = inside || nodes[i].index == wrap.first_point;
    if (wrap.last_point >= 0 && nodes[i].index == wrap.last_point) break;
    if (!inside || nodes[i + 1].arc_m >= 0) continue;
    const Eigen::Vector3d p_OS = X_WO.inverse() * nodes[i].p_W, p_OE = X_WO.inverse() * nodes[i + 1].p_W;
    const auto contact = wrapOver(object, p_OS, p_OE);
    if (!contact) continue;
    const double longer_m = contact->length_m - (p_OE - p_OS).norm();
    if (longer_m < least_m) {
      least_m = longer_m;
      best = contact;
      at = i + 1;
    }
  }
  if (!best) return;
  const auto node = [&](const Eigen::Vector3d& p_O, double arc_m) {
    return PathNode{
        .body = object.body, .p_B = object.X_BO * p_O, .p_W = X_WO * p_O, .wrap = wrap_index, .arc_m = arc_m};
  };
  nodes.insert(nodes.begin() + static_cast<std::ptrdiff_t>(at),
               {node(best->p_OFirst, -1), node(best->p_OLast, best->arc_m)});
}

}  // namespace

std::vector<PathNode> resolvedPath(const ForeignModel& model, const ForeignPath& path, std::span<const double> q,
                                   const std::vector<RigidTransform>& X_WB) {
  std::vector<PathNode> nodes = activePoints(path, q, X_WB);
  if (path.wraps.empty()) return nodes;
  // With several obstacles each in turn, the others' contacts standing, until the path is taut (OpenSim: 8 rounds).
  const int rounds = path.wraps.size() > 1 ? 30 : 1;
  constexpr double kTaut_m = 1e-10;
  double before_m = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < path.wraps.size(); ++k)
      meetObstacle(model.wrap_objects[static_cast<std::size_t>(path.wraps[k].object)], path.wraps[k],
                   static_cast<int>(k), X_WB, nodes);
    const double length_m = lengthOf<double>(nodes, X_WB, q);
    if (std::abs(length_m - before_m) < kTaut_m) break;
    before_m = length_m;
  }
  return nodes;
}

ForeignPosture defaultPosture(const ForeignModel& model) {
  ForeignPosture q(static_cast<Eigen::Index>(model.coordinates.size()));
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = model.coordinates[static_cast<std::size_t>(i)].default_value;
  return coupledPosture(model, std::move(q));
}

ForeignPosture coupledPosture(const ForeignModel& model, ForeignPosture q) {
  require(q.size() == static_cast<Eigen::Index>(model.coordinates.size()), "a posture has one entry a coordinate");
  followCouplings<double>(model, {q.data(), static_cast<std::size_t>(q.size())});
  return q;
}

std::vector<RigidTransform> bodyPoses(const ForeignModel& model, const ForeignPosture& posture) {
  const ForeignPosture q = coupledPosture(model, posture);
  return posesOf<double>(model, asSpan(q));
}

std::vector<Eigen::Vector3d> foreignPathPoints(const ForeignModel& model, int unit, const ForeignPosture& posture) {
  const ForeignPosture q = coupledPosture(model, posture);
  const auto X_WB = posesOf<double>(model, asSpan(q));
  std::vector<Eigen::Vector3d> points;
  for (const auto& node : resolvedPath(model, model.paths[static_cast<std::size_t>(unit)], asSpan(q), X_WB))
    points.push_back(node.p_W);
  return points;
}

double foreignLength(const ForeignModel& model, int unit, const ForeignPosture& posture) {
  const ForeignPosture q = coupledPosture(model, posture);
  const auto X_WB = posesOf<double>(model, asSpan(q));
  const auto nodes = resolvedPath(model, model.paths[static_cast<std::size_t>(unit)], asSpan(q), X_WB);
  return lengthOf<double>(nodes, X_WB, asSpan(q));
}

Eigen::VectorXd foreignLengths(const ForeignModel& model, const ForeignPosture& posture) {
  const ForeignPosture q = coupledPosture(model, posture);
  const auto X_WB = posesOf<double>(model, asSpan(q));
  Eigen::VectorXd length_m(static_cast<Eigen::Index>(model.paths.size()));
  for (std::size_t u = 0; u < model.paths.size(); ++u)
    length_m[static_cast<Eigen::Index>(u)] =
        lengthOf<double>(resolvedPath(model, model.paths[u], asSpan(q), X_WB), X_WB, asSpan(q));
  return length_m;
}

double foreignMomentArm(const ForeignModel& model, int unit, int coordinate, const ForeignPosture& posture) {
  if (model.couplingOf(coordinate)) return 0;
  const ForeignPosture q = coupledPosture(model, posture);
  const auto nodes =
      resolvedPath(model, model.paths[static_cast<std::size_t>(unit)], asSpan(q), posesOf<double>(model, asSpan(q)));
  const std::vector<Dual> dual_q = seeded(model, q, coordinate);
  const auto dual_X_WB = posesOf<Dual>(model, dual_q);
  return -lengthOf<Dual>(nodes, dual_X_WB, dual_q).v[0];
}

Eigen::MatrixXd foreignMomentArms(const ForeignModel& model, const ForeignPosture& posture) {
  const ForeignPosture q = coupledPosture(model, posture);
  const auto X_WB = posesOf<double>(model, asSpan(q));
  std::vector<std::vector<PathNode>> nodes;
  for (const auto& path : model.paths) nodes.push_back(resolvedPath(model, path, asSpan(q), X_WB));
  Eigen::MatrixXd arm_m = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(nodes.size()), q.size());
  for (int k = 0; k < q.size(); ++k) {
    if (model.couplingOf(k)) continue;
    const std::vector<Dual> dual_q = seeded(model, q, k);
    const auto dual_X_WB = posesOf<Dual>(model, dual_q);
    for (std::size_t u = 0; u < nodes.size(); ++u)
      arm_m(static_cast<Eigen::Index>(u), k) = -lengthOf<Dual>(nodes[u], dual_X_WB, dual_q).v[0];
  }
  return arm_m;
}

}  // namespace sinew
