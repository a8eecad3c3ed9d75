#include "core/foreign/foreign_from_model.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/foreign/blended_points_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

/// Range of a coordinate: the stops of this body, or the athlete's range where the model has no stops.
std::pair<double, double> rangeOf(const Coordinate& c) {
  if (c.stop_min_rad < c.stop_max_rad) return {c.stop_min_rad, c.stop_max_rad};
  return {c.athlete_min_rad, c.athlete_max_rad};
}

class Converter {
 public:
  explicit Converter(const Model& model) : skeleton_{model.skeleton} {
    out_.name = model.name;
    out_.source = "Sinew";
    out_.bodies = segmentsWithDrivenMass(skeleton_);
    for (const Coordinate& c : skeleton_.coordinates) {
      const auto [low, high] = rangeOf(c);
      out_.coordinates.push_back({c.name, c.translational, std::clamp(0.0, low, high), low, high, true, false});
    }
    for (std::size_t i = 0; i < model.passive_moments.size(); ++i)
      if (const PassiveMoment& m = model.passive_moments[i]; m.upper_Nm > 0 || m.lower_Nm > 0)
        out_.coordinate_forces.push_back({skeleton_.coordinates[i].name + "_structures", static_cast<int>(i), m});
    for (const Joint& joint : skeleton_.joints) addJoint(joint);
    for (const Joint& joint : skeleton_.joints)
      for (const PatellaDriver& d : skeleton_.patellae)
        if (joint.child == d.femur) addPatella(d);
  }
  ForeignModel model() && { return std::move(out_); }

 private:
  /// Turns about three axes that span space, or one that is completed to such.
  void setTurns(ForeignJoint& joint, int first, int count) const {
    std::array<Eigen::Vector3d, 3> axes;
    const auto axisOf = [&](int i) { return skeleton_.coordinates[static_cast<std::size_t>(i)].axis; };
    axes[0] = axisOf(first);
    axes[1] = count > 1 ? axisOf(first + 1) : Eigen::Vector3d{axes[0].unitOrthogonal()};
    axes[2] = count > 2 ? axisOf(first + 2) : Eigen::Vector3d{axes[0].cross(axes[1]).normalized()};
    for (int i = 0; i < 3; ++i) {
      ForeignAxis& turn = joint.turns[static_cast<std::size_t>(i)];
      turn.axis = axes[static_cast<std::size_t>(i)];
      if (i < count) turn.amount = CoordinateFunction::of(first + i, ScalarFunction::line(1));
    }
    for (int i = 0; i < count; ++i) joint.coordinates.push_back(first + i);
  }

  ForeignJoint plainJoint(const std::string& name, int parent, int child, const RigidTransform& X_PF) const {
    ForeignJoint joint;
    joint.name = name;
    joint.kind = "CustomJoint";
    joint.parent = parent;
    joint.child = child;
    joint.X_PF = X_PF;
    for (int i = 0; i < 3; ++i) joint.shifts[static_cast<std::size_t>(i)].axis = Eigen::Vector3d::Unit(i);
    return joint;
  }

  void addJoint(const Joint& ours) {
    const auto radius = std::ranges::find_if(skeleton_.radii, [&](const RadiusDriver& d) {
      return &skeleton_.joints[static_cast<std::size_t>(d.wrist_joint)] == &ours;
    });
    if (radius != skeleton_.radii.end()) return addForearm(ours, *radius);
    ForeignJoint joint = plainJoint(ours.name, ours.parent, ours.child, ours.X_PJ);
    int first = ours.first_coordinate;
    if (ours.type == JointType::Free) {
      for (int i = 0; i < 3; ++i) {
        joint.shifts[static_cast<std::size_t>(i)].amount = CoordinateFunction::of(first + i, ScalarFunction::line(1));
        joint.coordinates.push_back(first + i);
      }
      first += 3;
    }
    setTurns(joint, first, ours.type == JointType::Revolute ? 1 : 3);
    out_.joints.push_back(std::move(joint));
  }

  /// Pronation turns the radius on the ulna; flexion and deviation turn the hand on the radius.
  void addForearm(const Joint& wrist, const RadiusDriver& d) {
    RigidTransform X_UR = RigidTransform::Identity();
    X_UR.linear() = rotationAbout<double>(d.axis_U, std::numbers::pi / 2);
    X_UR.translation() = d.p_UR;
    const std::string& radius = skeleton_.segments[static_cast<std::size_t>(d.segment)].name;
    ForeignJoint forearm = plainJoint("radioulnar" + radius.substr(radius.size() - 2), d.ulna, d.segment, X_UR);
    setTurns(forearm, wrist.first_coordinate, 1);
    forearm.turns[0].axis = d.axis_U;
    forearm.turns[1].axis = d.axis_U.unitOrthogonal();
    forearm.turns[2].axis = d.axis_U.cross(forearm.turns[1].axis).normalized();
    out_.bodies[static_cast<std::size_t>(d.segment)].parent = d.ulna;
    out_.joints.push_back(std::move(forearm));
    ForeignJoint hand = plainJoint(wrist.name, d.segment, wrist.child, X_UR.inverse() * wrist.X_PJ);
    setTurns(hand, wrist.first_coordinate + 1, 2);
    out_.bodies[static_cast<std::size_t>(wrist.child)].parent = d.segment;
    out_.joints.push_back(std::move(hand));
  }

  void addPatella(const PatellaDriver& d) {
    const std::string& name = skeleton_.segments[static_cast<std::size_t>(d.segment)].name;
    RigidTransform X_FK = RigidTransform::Identity(), X_PK = X_FK;
    X_FK.linear() = d.R_FK;
    X_FK.translation() = d.p_FK;
    X_PK.translation() = -d.radius_m * Eigen::Vector3d{std::cos(d.start_rad), std::sin(d.start_rad), 0};
    ForeignJoint joint = plainJoint("patellofemoral" + name.substr(name.size() - 2), d.femur, d.segment, X_FK);
    joint.X_BM = X_PK;
    const int glide = static_cast<int>(out_.coordinates.size());
    const Coordinate& knee = skeleton_.coordinates[static_cast<std::size_t>(d.knee_coordinate)];
    out_.coordinates.push_back({name + "_glide", false, d.glide(0)[0], d.glide(knee.athlete_min_rad)[0],
                                d.glide(knee.athlete_max_rad)[0], false, false});
    joint.turns[0] = {-Eigen::Vector3d::UnitZ(), CoordinateFunction::of(glide, ScalarFunction::line(1))};
    joint.turns[1].axis = Eigen::Vector3d::UnitX();
    joint.turns[2].axis = -Eigen::Vector3d::UnitY();
    joint.coordinates.push_back(glide);
    out_.bodies[static_cast<std::size_t>(d.segment)].parent = d.femur;
    out_.joints.push_back(std::move(joint));
    out_.couplings.push_back({name + "_follows_knee", glide, {}});
  }

  const Skeleton& skeleton_;
  ForeignModel out_;
};

ScalarFunction glideSpline(const Skeleton& skeleton, const PatellaDriver& d) {
  constexpr double kStep_rad = std::numbers::pi / 180, kMargin_rad = 10 * kStep_rad;
  const Coordinate& knee = skeleton.coordinates[static_cast<std::size_t>(d.knee_coordinate)];
  const double low = knee.athlete_min_rad - kMargin_rad, high = knee.athlete_max_rad + kMargin_rad;
  const int count = static_cast<int>(std::ceil((high - low) / kStep_rad));
  std::vector<double> x, y;
  for (int i = 0; i <= count; ++i) {
    x.push_back(low + (high - low) * i / count);
    y.push_back(d.glide(x.back())[0]);
  }
  return ScalarFunction::simmSpline(x, y);
}

ScalarFunction glideQuartic(const Skeleton& skeleton, const PatellaDriver& d) {
  const PatellaQuartic fit = patellaQuartic(skeleton, d);
  return ScalarFunction::polynomial({std::rbegin(fit.coefficients), std::rend(fit.coefficients)});
}

}  // namespace

std::vector<Segment> segmentsWithDrivenMass(const Skeleton& skeleton) {
  std::vector<Segment> segments = skeleton.segments;
  const auto share = [&](int carrier, int driven) {
    Segment& from = segments[static_cast<std::size_t>(carrier)];
    const double left = (from.mass_kg - kDrivenMass_kg) / from.mass_kg;
    from.mass_kg *= left;
    from.inertia_B_kgm2 *= left;
    Segment& to = segments[static_cast<std::size_t>(driven)];
    to.mass_kg = kDrivenMass_kg;
    to.p_BCom.setZero();
    to.inertia_B_kgm2 = Eigen::Matrix3d::Identity() * kDrivenInertia_kgm2;
  };
  for (const PatellaDriver& d : skeleton.patellae) share(d.femur, d.segment);
  for (const RadiusDriver& d : skeleton.radii) share(d.ulna, d.segment);
  return segments;
}

PatellaQuartic patellaQuartic(const Skeleton& skeleton, const PatellaDriver& patella) {
  constexpr int kSamples = 181;
  const Coordinate& knee = skeleton.coordinates[static_cast<std::size_t>(patella.knee_coordinate)];
  Eigen::MatrixXd powers(kSamples, 5);
  Eigen::VectorXd glide(kSamples);
  for (int i = 0; i < kSamples; ++i) {
    const double x = knee.athlete_min_rad + (knee.athlete_max_rad - knee.athlete_min_rad) * i / (kSamples - 1);
    for (int k = 0; k < 5; ++k) powers(i, k) = std::pow(x, k);
    glide[i] = patella.glide(x)[0];
  }
  const Eigen::VectorXd c = powers.colPivHouseholderQr().solve(glide);
  PatellaQuartic fit;
  std::copy(c.begin(), c.end(), fit.coefficients);
  fit.largest_error_rad = (powers * c - glide).cwiseAbs().maxCoeff();
  return fit;
}

ForeignPosture foreignPosture(const ForeignModel& foreign, const Skeleton& skeleton, const Posture& posture) {
  ForeignPosture q = ForeignPosture::Zero(static_cast<Eigen::Index>(foreign.coordinates.size()));
  q.head(posture.size()) = clinicalFromPosture(skeleton, posture);
  return coupledPosture(foreign, std::move(q));
}

ForeignModel foreignFromModel(const Model& model, const ForeignOptions& options) {
  ForeignModel foreign = Converter{model}.model();
  for (ForeignCoupling& coupling : foreign.couplings)
    for (const PatellaDriver& d : model.skeleton.patellae)
      if (coupling.name.starts_with(model.skeleton.segments[static_cast<std::size_t>(d.segment)].name))
        coupling.value = CoordinateFunction::of(d.knee_coordinate, options.patella == ForeignOptions::Patella::Spline
                                                                       ? glideSpline(model.skeleton, d)
                                                                       : glideQuartic(model.skeleton, d));
  for (const MusculotendonUnit& unit : model.musculature.units) {
    foreign.musculature.units.push_back(unit);
    foreign.musculature.units.back().path.clear();
    foreign.muscle_kinds.push_back("Thelen2003Muscle");
    foreign.paths.push_back(anchoredPath(unit));
  }
  if (options.blended == ForeignOptions::Blended::MovingPoint) fitBlendedPoints(model, foreign);
  return foreign;
}

}  // namespace sinew
