#include "app/bench/dart_peer.h"

#include <dart/config.hpp>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <numbers>

namespace sinew {
namespace {

namespace dyn = dart::dynamics;

struct PlainAnchor {
  std::vector<const dyn::BodyNode*> bodies;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;

  Eigen::Vector3d position() const {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < bodies.size(); ++i) p += weights[i] * (bodies[i]->getWorldTransform() * points[i]);
    return p;
  }
};

struct PlainMuscle {
  std::vector<PlainAnchor> anchors;

  double length() const {
    double sum = 0;
    for (std::size_t i = 1; i < anchors.size(); ++i)
      sum += (anchors[i].position() - anchors[i - 1].position()).norm();
    return sum;
  }
};

dyn::BodyNode::Properties bodyNamed(const std::string& name) {
  return dyn::BodyNode::Properties{dyn::BodyNode::AspectProperties{name}};
}

template <class JointType>
dyn::BodyNode* addBody(dyn::Skeleton& skeleton, dyn::BodyNode* parent, const std::string& name,
                       const RigidTransform& X_PJ, const Eigen::Vector3d* axis = nullptr) {
  typename JointType::Properties properties;
  properties.mName = name + "_joint";
  properties.mT_ParentBodyToJoint = Eigen::Isometry3d{X_PJ.matrix()};
  if constexpr (std::is_same_v<JointType, dyn::RevoluteJoint>) properties.mAxis = *axis;
  return skeleton.createJointAndBodyNodePair<JointType>(parent, properties, bodyNamed(name)).second;
}

}  // namespace

struct DartPeer::Impl {
  Skeleton skeleton;  ///< ours
  dyn::SkeletonPtr dart = dyn::Skeleton::create("body");
  std::vector<dyn::BodyNode*> bodies;  ///< by our segment
  std::vector<PlainMuscle> muscles;

  explicit Impl(const Model& model) : skeleton{model.skeleton}, bodies(model.skeleton.segments.size()) {
    for (const Joint& joint : skeleton.joints) addJoint(joint);
    for (const auto& d : skeleton.patellae) {
      // Turns about the knee's axis by -glide: the joint's frame at the knee, the body's where the patella starts.
      RigidTransform X_FK = RigidTransform::Identity();
      X_FK.linear() = d.R_FK;
      X_FK.translation() = d.p_FK;
      const Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ();
      auto* body = addBody<dyn::RevoluteJoint>(*dart, bodies[d.femur], name(d.segment), X_FK, &axis);
      Eigen::Isometry3d X_BJ = Eigen::Isometry3d::Identity();
      X_BJ.translation() = -d.radius_m * Eigen::Vector3d{std::cos(d.start_rad), std::sin(d.start_rad), 0};
      body->getParentJoint()->setTransformFromChildBodyNode(X_BJ);
      bodies[d.segment] = body;
    }
    for (const auto& d : skeleton.radii) {
      RigidTransform X_UR = RigidTransform::Identity();
      X_UR.translation() = d.p_UR;
      bodies[d.segment] = addBody<dyn::RevoluteJoint>(*dart, bodies[d.ulna], name(d.segment), X_UR, &d.axis_U);
    }
    for (const auto& unit : model.musculature.units) muscles.push_back(muscle(unit));
  }

  const std::string& name(int segment) const { return skeleton.segments[segment].name; }

  void addJoint(const Joint& joint) {
    auto* parent = joint.parent < 0 ? nullptr : bodies[joint.parent];
    auto& body = bodies[joint.child];
    if (joint.type == JointType::Free)
      body = addBody<dyn::FreeJoint>(*dart, parent, name(joint.child), joint.X_PJ);
    else if (joint.type == JointType::Ball)
      body = addBody<dyn::BallJoint>(*dart, parent, name(joint.child), joint.X_PJ);
    else
      body = addBody<dyn::RevoluteJoint>(*dart, parent, name(joint.child), joint.X_PJ,
                                         &skeleton.coordinates[joint.first_coordinate].axis);
  }

  PlainMuscle muscle(const MusculotendonUnit& unit) const {
    PlainMuscle plain;
    for (const auto& point : unit.path) {
      PlainAnchor anchor;
      for (const Anchor& a : point.anchors) {
        anchor.bodies.push_back(bodies[a.segment]);
        anchor.points.push_back(a.p_B);
        anchor.weights.push_back(a.weight);
      }
      plain.anchors.push_back(anchor);
    }
    return plain;
  }

  std::size_t dof(int segment) const { return bodies[segment]->getParentJoint()->getIndexInSkeleton(0); }
};

DartPeer::DartPeer(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
DartPeer::~DartPeer() = default;

std::unique_ptr<DartPeer> DartPeer::make(const Model& model) {
  return std::unique_ptr<DartPeer>{new DartPeer{std::make_unique<Impl>(model)}};
}

std::string DartPeer::version() {
  return "DART " DART_VERSION;
}

Eigen::VectorXd DartPeer::positions(const Posture& q) const {
  const Skeleton& s = impl_->skeleton;
  Eigen::VectorXd x(static_cast<Eigen::Index>(impl_->dart->getNumDofs()));
  for (const Joint& joint : s.joints) {
    const auto first = static_cast<Eigen::Index>(impl_->dof(joint.child));
    x.segment(first, joint.coordinate_count) = q.segment(joint.first_coordinate, joint.coordinate_count);
    if (joint.type == JointType::Free)  // DART: rotation vector first
      x.segment<6>(first) << q.segment<3>(joint.first_coordinate + 3), q.segment<3>(joint.first_coordinate);
  }
  for (const auto& d : s.patellae)
    x[static_cast<Eigen::Index>(impl_->dof(d.segment))] = d.glide(q[d.knee_coordinate])[0];
  for (const auto& d : s.radii) {
    const Eigen::Quaterniond wrist{
        rotationFromVector<double>(q.segment<3>(s.joints[d.wrist_joint].first_coordinate))};
    x[static_cast<Eigen::Index>(impl_->dof(d.segment))] =
        std::numbers::pi / 2 + 2 * std::atan2(wrist.vec().dot(d.axis_U), wrist.w());
  }
  return x;
}

void DartPeer::setPositions(const Eigen::VectorXd& positions) {
  impl_->dart->setPositions(positions);
}

Eigen::Vector3d DartPeer::inWorld(int segment, const Eigen::Vector3d& p_B) const {
  return impl_->bodies[segment]->getWorldTransform() * p_B;
}

RigidTransform DartPeer::X_WB(int segment) const {
  return RigidTransform{impl_->bodies[segment]->getWorldTransform().matrix()};
}

void DartPeer::moveTo(const Eigen::VectorXd& positions) {
  setPositions(positions);
  for (const auto* body : impl_->bodies) body->getWorldTransform();
}

void DartPeer::lengths(std::span<const int> units, std::vector<double>& lengths_m) const {
  lengths_m.resize(units.size());
  for (std::size_t i = 0; i < units.size(); ++i) lengths_m[i] = impl_->muscles[units[i]].length();
}

}  // namespace sinew
