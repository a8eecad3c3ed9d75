#include "core/io/osim/osim_writer.h"

#include <array>
#include <cctype>
#include <map>
#include <sstream>

#include "core/angle.h"
#include "core/io/osim/osim_forces_internal.h"
#include "core/io/osim/osim_nodes_internal.h"

namespace sinew {
namespace {

using namespace osim;

class OsimWriter {
 public:
  OsimWriter(const ForeignModel& model, const OsimOptions& options)
      : model_{model},
        options_{options},
        bodies_{legalNames(model.bodies, &Segment::name)},
        joints_{legalNames(model.joints, &ForeignJoint::name)},
        coordinates_{legalNames(model.coordinates, &ForeignCoordinate::name)},
        wraps_{legalNames(model.wrap_objects, &WrapObject::name)},
        muscles_{legalNames(model.musculature.units, &MusculotendonUnit::name)} {
    for (std::size_t j = 0; j < model.joints.size(); ++j)
      for (const int c : model.joints[j].coordinates) owner_[c] = j;
  }

  std::string text() {
    pugi::xml_document document;
    Node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version").set_value("1.0");
    declaration.append_attribute("encoding").set_value("UTF-8");
    std::string remarks;
    for (std::string line : options_.remarks) {
      for (auto at = line.find("--"); at != std::string::npos; at = line.find("--")) line.replace(at, 2, "-");
      remarks += "\n  " + line;
    }
    if (!remarks.empty()) document.append_child(pugi::node_comment).set_value((remarks + "\n").c_str());
    Node root = document.append_child("OpenSimDocument");
    root.append_attribute("Version").set_value("40000");
    write(named(root, "Model", legalNames({model_.name}).front()));
    std::ostringstream out;
    document.save(out, "\t");
    return std::move(out).str();
  }

 private:
  void write(Node model) {
    Node ground = named(model, "Ground", "ground");
    geometry(ground, -1);
    wrapObjects(ground, -1);
    leaf(model, "gravity", numbers(model_.gravity_W_m_s2));
    std::string credits = model_.credits;
    for (const auto& line : options_.remarks) credits += (credits.empty() ? "" : " ") + line;
    leaf(model, "credits", credits);
    leaf(model, "length_units", "meters");
    leaf(model, "force_units", "N");
    Node bodies = openSet(model, "BodySet", "bodyset");
    for (std::size_t i = 0; i < bodies_.size(); ++i) body(bodies, static_cast<int>(i));
    Node joints = openSet(model, "JointSet", "jointset");
    for (std::size_t i = 0; i < joints_.size(); ++i) joint(joints, i);
    openSet(model, "ControllerSet", "controllerset");
    Node constraints = openSet(model, "ConstraintSet", "constraintset");
    const auto names = legalNames(model_.couplings, &ForeignCoupling::name);
    for (std::size_t i = 0; i < names.size(); ++i) coupling(constraints, model_.couplings[i], names[i]);
    Node forces = openSet(model, "ForceSet", "forceset");
    for (std::size_t i = 0; i < muscles_.size(); ++i) muscle(forces, i);
    const auto force_names = legalNames(model_.coordinate_forces, &ForeignCoordinateForce::name);
    for (std::size_t i = 0; i < force_names.size(); ++i)
      coordinateForce(forces, model_.coordinate_forces[i], force_names[i]);
    for (const char* set : {"MarkerSet", "ContactGeometrySet", "ProbeSet", "ComponentSet"}) {
      std::string name = set;
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
      openSet(model, set, name);
    }
  }

  std::string bodyPath(int body) const {
    return body < 0 ? "/ground" : "/bodyset/" + bodies_[static_cast<std::size_t>(body)];
  }
  std::string coordinatePath(int c) const {
    return "/jointset/" + joints_[owner_.at(c)] + "/" + coordinates_[static_cast<std::size_t>(c)];
  }

  void body(Node bodies, int index) {
    const Segment& segment = model_.bodies[static_cast<std::size_t>(index)];
    Node node = named(bodies, "Body", bodies_[static_cast<std::size_t>(index)]);
    geometry(node, index);
    wrapObjects(node, index);
    leaf(node, "mass", number(segment.mass_kg));
    leaf(node, "mass_center", numbers(segment.p_BCom));
    const Eigen::Matrix3d& I = segment.inertia_B_kgm2;
    leaf(node, "inertia", numbers(std::array{I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)}));
  }

  void geometry(Node node, int body) {
    Node attached;
    for (std::size_t i = 0; i < options_.meshes.size(); ++i) {
      if (options_.meshes[i].body != body) continue;
      if (!attached) attached = node.append_child("attached_geometry");
      Node mesh = named(attached, "Mesh", "geometry_" + std::to_string(i + 1));
      leaf(mesh, "socket_frame", "..");
      leaf(mesh, "scale_factors", "1 1 1");
      leaf(mesh, "mesh_file", options_.meshes[i].file);
    }
  }

  void wrapObjects(Node node, int body) {
    Node objects;
    for (std::size_t i = 0; i < wraps_.size(); ++i) {
      const WrapObject& o = model_.wrap_objects[i];
      if (o.body != body) continue;
      if (!objects) objects = openSet(node, "WrapObjectSet", "wrapobjectset");
      const bool cylinder = o.shape == WrapShape::Cylinder;
      Node wrap = named(objects, cylinder ? "WrapCylinder" : "WrapEllipsoid", wraps_[i]);
      leaf(wrap, "active", "true");
      leaf(wrap, "xyz_body_rotation", numbers(xyzAngles(o.X_BO.linear())));
      leaf(wrap, "translation", numbers(o.X_BO.translation()));
      leaf(wrap, "quadrant", o.side_sign == 0 ? "all" : std::string{o.side_sign < 0 ? "-" : ""} + "xyz"[o.side_axis]);
      if (cylinder) {
        leaf(wrap, "radius", number(o.radii_m.x()));
        leaf(wrap, "length", number(2 * o.radii_m.z()));
      } else {
        leaf(wrap, "dimensions", numbers(o.radii_m));
      }
    }
  }

  void offsetFrame(Node frames, const std::string& name, int body, const RigidTransform& X) {
    Node frame = named(frames, "PhysicalOffsetFrame", name);
    leaf(frame, "socket_parent", bodyPath(body));
    leaf(frame, "translation", numbers(X.translation()));
    leaf(frame, "orientation", numbers(xyzAngles(X.linear())));
  }

  void joint(Node joints, std::size_t index) {
    const ForeignJoint& j = model_.joints[index];
    const bool ellipsoid = !j.ellipsoid_radii_m.isZero();
    Node node = named(joints, ellipsoid ? "EllipsoidJoint" : "CustomJoint", joints_[index]);
    const auto nameOf = [&](int body) { return body < 0 ? "ground" : bodies_[static_cast<std::size_t>(body)]; };
    leaf(node, "socket_parent_frame", nameOf(j.parent) + "_offset");
    leaf(node, "socket_child_frame", nameOf(j.child) + "_offset");
    Node coordinates = node.append_child("coordinates");
    for (const int c : j.coordinates) coordinate(coordinates, c);
    Node frames = node.append_child("frames");
    offsetFrame(frames, nameOf(j.parent) + "_offset", j.parent, j.X_PF);
    offsetFrame(frames, nameOf(j.child) + "_offset", j.child, j.X_BM);
    if (ellipsoid) return leaf(node, "radii_x_y_z", numbers(j.ellipsoid_radii_m));
    Node transform = node.append_child("SpatialTransform");
    for (std::size_t i = 0; i < 3; ++i) axis(transform, "rotation" + std::to_string(i + 1), j.turns[i]);
    for (std::size_t i = 0; i < 3; ++i) axis(transform, "translation" + std::to_string(i + 1), j.shifts[i]);
  }

  void coordinate(Node coordinates, int index) {
    const ForeignCoordinate& c = model_.coordinates[static_cast<std::size_t>(index)];
    Node node = named(coordinates, "Coordinate", coordinates_[static_cast<std::size_t>(index)]);
    leaf(node, "default_value", number(c.default_value));
    leaf(node, "default_speed_value", "0");
    leaf(node, "range", numbers(std::array{c.min, c.max}));
    leaf(node, "clamped", c.clamped ? "true" : "false");
    leaf(node, "locked", c.locked ? "true" : "false");
    node.append_child("prescribed_function");
  }

  void axis(Node transform, const std::string& name, const ForeignAxis& axis) {
    Node node = named(transform, "TransformAxis", name);
    std::string names;
    for (const auto& term : axis.amount.terms)
      names += (names.empty() ? "" : " ") + coordinates_[static_cast<std::size_t>(term.coordinate)];
    leaf(node, "coordinates", names);
    leaf(node, "axis", numbers(axis.axis));
    function(node, axis.amount);
  }

  /// Sums of several coordinates are lines in practice (that is all that the reader makes).
  void function(Node parent, const CoordinateFunction& f) {
    if (f.terms.empty()) return leaf(named(parent, "Constant", "function"), "value", number(f.constant));
    if (f.terms.size() > 1) {
      std::vector<double> c;
      for (const auto& term : f.terms) c.push_back(term.function(0).slope);
      c.push_back(f.constant);
      return leaf(named(parent, "LinearFunction", "function"), "coefficients", numbers(c));
    }
    const ScalarFunction& g = f.terms[0].function;
    std::vector<double> c = g.coefficients(), y = g.y();
    for (double& v : y) v += f.constant;
    if (!c.empty()) c.back() += f.constant;
    switch (g.kind()) {
      case ScalarFunction::Kind::Constant:
        return leaf(named(parent, "Constant", "function"), "value", numbers(c));
      case ScalarFunction::Kind::Polynomial:
        return leaf(named(parent, c.size() == 2 ? "LinearFunction" : "PolynomialFunction", "function"),
                    "coefficients", numbers(c));
      case ScalarFunction::Kind::PiecewiseLinear:
      case ScalarFunction::Kind::SimmSpline:
        Node knots =
            named(parent, g.kind() == ScalarFunction::Kind::SimmSpline ? "SimmSpline" : "PiecewiseLinearFunction",
                  "function");
        leaf(knots, "x", numbers(g.x()));
        leaf(knots, "y", numbers(y));
    }
  }

  void coupling(Node constraints, const ForeignCoupling& c, const std::string& name) {
    Node node = named(constraints, "CoordinateCouplerConstraint", name);
    leaf(node, "isEnforced", "true");
    function(node.append_child("coupled_coordinates_function"), c.value);
    std::string names;
    for (const auto& term : c.value.terms)
      names += (names.empty() ? "" : " ") + coordinates_[static_cast<std::size_t>(term.coordinate)];
    leaf(node, "independent_coordinate_names", names);
    leaf(node, "dependent_coordinate_name", coordinates_[static_cast<std::size_t>(c.dependent)]);
    leaf(node, "scale_factor", "1");
  }

  void muscle(Node forces, std::size_t index) {
    const MusculotendonUnit& unit = model_.musculature.units[index];
    const bool thelen = options_.muscles == OsimOptions::Muscles::Thelen;
    Node node = named(forces, thelen ? "Thelen2003Muscle" : "Millard2012EquilibriumMuscle", muscles_[index]);
    leaf(node, "appliesForce", "true");
    path(node, index);
    leaf(node, "optimal_force", "1");
    leaf(node, "max_isometric_force", number(unit.max_isometric_force_N));
    leaf(node, "optimal_fiber_length", number(unit.optimal_fiber_length_m));
    leaf(node, "tendon_slack_length", number(unit.tendon_slack_length_m));
    leaf(node, "pennation_angle_at_optimal", number(unit.pennation_angle_at_optimal_rad));
    leaf(node, "max_contraction_velocity", "10");
    if (!thelen) return;
    // The curves of core/muscle/hill.h.
    leaf(node, "FmaxTendonStrain", "0.033");
    leaf(node, "FmaxMuscleStrain", "0.6");
    leaf(node, "KshapeActive", "0.45");
    leaf(node, "KshapePassive", "5");
    leaf(node, "Af", "0.25");
    leaf(node, "Flen", "1.4");
  }

  /// Our law as an expression of the coordinate, exactly; OpenSim's own limit as what it was.
  void coordinateForce(Node forces, const ForeignCoordinateForce& force, const std::string& name) {
    const auto c = static_cast<std::size_t>(force.coordinate);
    const auto* limit = std::get_if<CoordinateLimit>(&force.law);
    Node node = named(forces, limit ? "CoordinateLimitForce" : "ExpressionBasedCoordinateForce", name);
    leaf(node, "appliesForce", "true");
    leaf(node, "coordinate", coordinates_[c]);
    if (!limit) return leaf(node, "expression", expressionOf(std::get<PassiveMoment>(force.law)));
    const double unit = model_.coordinates[c].translational ? 1 : kRadPerDeg;
    leaf(node, "upper_stiffness", number(limit->upper_stiffness * unit));
    leaf(node, "upper_limit", number(limit->upper / unit));
    leaf(node, "lower_stiffness", number(limit->lower_stiffness * unit));
    leaf(node, "lower_limit", number(limit->lower / unit));
    leaf(node, "damping", "0");
    leaf(node, "transition", number(limit->transition / unit));
  }

  void path(Node muscle, std::size_t index) {
    const ForeignPath& path = model_.paths[index];
    Node geometry = named(muscle, "GeometryPath", "geometrypath");
    Node objects = openSet(geometry, "PathPointSet");
    for (std::size_t i = 0; i < path.points.size(); ++i)
      pathPoint(objects, path.points[i], muscles_[index] + "-P" + std::to_string(i + 1));
    Node wrap_objects = openSet(geometry, "PathWrapSet");
    for (std::size_t i = 0; i < path.wraps.size(); ++i) {
      const PathWrap& w = path.wraps[i];
      Node wrap = named(wrap_objects, "PathWrap", "pathwrap_" + std::to_string(i + 1));
      leaf(wrap, "wrap_object", wraps_[static_cast<std::size_t>(w.object)]);
      leaf(wrap, "method", "hybrid");
      const auto end = [](int point) { return std::to_string(point < 0 ? -1 : point + 1); };
      leaf(wrap, "range", end(w.first_point) + " " + end(w.last_point));
    }
  }

  void pathPoint(Node objects, const ForeignPathPoint& point, const std::string& name) {
    const char* kind = point.moves() ? "MovingPathPoint" : point.condition ? "ConditionalPathPoint" : "PathPoint";
    Node node = named(objects, kind, name);
    leaf(node, "socket_parent_frame", bodyPath(point.body));
    if (!point.moves()) {
      const Eigen::Vector3d p_F{point.p_F[0].constant, point.p_F[1].constant, point.p_F[2].constant};
      leaf(node, "location", numbers(Eigen::Vector3d{point.X_BF * p_F}));
      if (const auto& c = point.condition) {
        leaf(node, "socket_coordinate", coordinatePath(c->coordinate));
        leaf(node, "range", numbers(std::array{c->min, c->max}));
      }
      return;
    }
    require(point.X_BF.isApprox(RigidTransform::Identity()), "a moving point is given in the frame of its body");
    const char* letters[] = {"x", "y", "z"};
    // A component that rests has a constant; OpenSim wants a coordinate all the same.
    int any = -1;
    for (const auto& f : point.p_F)
      if (!f.terms.empty()) any = f.terms[0].coordinate;
    for (std::size_t i = 0; i < 3; ++i)
      leaf(node, (std::string{"socket_"} + letters[i] + "_coordinate").c_str(),
           coordinatePath(point.p_F[i].terms.empty() ? any : point.p_F[i].terms[0].coordinate));
    for (std::size_t i = 0; i < 3; ++i)
      function(node.append_child((std::string{letters[i]} + "_location").c_str()), point.p_F[i]);
  }

  const ForeignModel& model_;
  const OsimOptions& options_;
  std::vector<std::string> bodies_, joints_, coordinates_, wraps_, muscles_;
  std::map<int, std::size_t> owner_;  ///< joint of a coordinate
};

}  // namespace

std::string osimText(const ForeignModel& model, const OsimOptions& options) {
  return OsimWriter{model, options}.text();
}

}  // namespace sinew
