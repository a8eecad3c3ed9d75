#pragma once
#include <string>
#include <vector>

namespace sinew::test {

// Small OpenSim documents, written out so that a reader sees what is read.

inline std::string osimBody(const std::string& name, const std::string& more = "") {
  return "<Body name=\"" + name + "\"><mass>2</mass><mass_center>0 -0.1 0</mass_center>" +
         "<inertia>0.01 0.02 0.03 0 0 0</inertia>" + more + "</Body>";
}

inline std::string osimCoordinate(const std::string& name, const std::string& range = "-2 2", double value = 0) {
  return "<Coordinate name=\"" + name + "\"><default_value>" + std::to_string(value) + "</default_value><range>" +
         range + "</range><clamped>false</clamped><locked>false</locked></Coordinate>";
}

/// A joint whose frames are the bodies' own, with `at` as the place on the parent.
inline std::string osimJoint(const std::string& kind, const std::string& name, const std::string& parent,
                             const std::string& child, const std::vector<std::string>& coordinates,
                             const std::string& more = "", const std::string& at = "0 0 0") {
  std::string text = "<" + kind + " name=\"" + name + "\"><socket_parent_frame>on_parent</socket_parent_frame>" +
                     "<socket_child_frame>" + child + "</socket_child_frame><coordinates>";
  for (const auto& c : coordinates) text += osimCoordinate(c);
  return text + "</coordinates><frames><PhysicalOffsetFrame name=\"on_parent\"><socket_parent>" + parent +
         "</socket_parent><translation>" + at + "</translation><orientation>0 0 0</orientation>" +
         "</PhysicalOffsetFrame></frames>" + more + "</" + kind + ">";
}

inline std::string osimPoint(const std::string& body, const std::string& location) {
  return "<PathPoint name=\"p\"><socket_parent_frame>" + body + "</socket_parent_frame><location>" + location +
         "</location></PathPoint>";
}

inline std::string osimMuscle(const std::string& name, const std::string& points, const std::string& wraps = "") {
  return "<Thelen2003Muscle name=\"" + name + "\"><GeometryPath name=\"path\"><PathPointSet><objects>" + points +
         "</objects></PathPointSet><PathWrapSet><objects>" + wraps + "</objects></PathWrapSet></GeometryPath>" +
         "<max_isometric_force>1000</max_isometric_force><optimal_fiber_length>0.1</optimal_fiber_length>" +
         "<tendon_slack_length>0.2</tendon_slack_length>" +
         "<pennation_angle_at_optimal>0.1</pennation_angle_at_optimal></Thelen2003Muscle>";
}

struct OsimParts {
  std::string bodies, joints, constraints, forces;
};

inline std::string osimDocument(const OsimParts& parts) {
  const auto set = [](const std::string& name, const std::string& objects) {
    return "<" + name + "><objects>" + objects + "</objects><groups/></" + name + ">\n";
  };
  return "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">\n<Model name=\"test\">\n" +
         set("BodySet", parts.bodies) + set("JointSet", parts.joints) + set("ConstraintSet", parts.constraints) +
         set("ForceSet", parts.forces) + "</Model>\n</OpenSimDocument>\n";
}

inline std::string osimAxis(const std::string& name, const std::string& coordinates, const std::string& axis,
                            const std::string& function) {
  return "<TransformAxis name=\"" + name + "\"><coordinates>" + coordinates + "</coordinates><axis>" + axis +
         "</axis>" + function + "</TransformAxis>";
}

}  // namespace sinew::test
