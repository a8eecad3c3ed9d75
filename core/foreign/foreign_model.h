#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/foreign/coordinate_force.h"
#include "core/foreign/scalar_function.h"
#include "core/geometry/rigid_transform.h"
#include "core/muscle/musculature.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

// A musculoskeletal model as other programs (OpenSim) describe it: any tree of joints whose motion is made of
// functions of coordinates, coordinates that follow others, paths with moving and conditional points that may wrap
// over obstacles. A constant value; algorithms are free functions (foreign_kinematics.h, foreign_evaluate.h). It is
// what .osim files are read into, and what our own model is turned into before it is exported (foreign_from_model.h).
// Metres, radians; -1 as a body is the ground.

/// constant + sum of functions of one coordinate each.
struct CoordinateFunction {
  struct Term {
    int coordinate = -1;
    ScalarFunction function;
  };
  double constant = 0;
  std::vector<Term> terms;

  static CoordinateFunction of(int coordinate, ScalarFunction function) { return {0, {{coordinate, function}}}; }
  bool isConstant() const { return terms.empty(); }
};

struct ForeignCoordinate {
  std::string name;
  bool translational = false;
  double default_value = 0;
  double min = 0, max = 0;
  bool clamped = false;
  bool locked = false;  ///< the file holds it at its default; a posture that names it moves it all the same
};

/// Turn about, or shift along, a fixed axis by a function of coordinates.
struct ForeignAxis {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  CoordinateFunction amount;
};

/// R_FM = turn 1 * turn 2 * turn 3, p_FM = the sum of the shifts (in F).
struct ForeignJoint {
  std::string name;
  std::string kind;                                  ///< "CustomJoint", as the file calls it
  int parent = -1, child = -1;                       ///< bodies
  RigidTransform X_PF = RigidTransform::Identity();  ///< frame F on the parent
  RigidTransform X_BM = RigidTransform::Identity();  ///< frame M on the child
  std::array<ForeignAxis, 3> turns, shifts;
  Eigen::Vector3d ellipsoid_radii_m = Eigen::Vector3d::Zero();  ///< not 0: M slides on this ellipsoid, z outwards
  std::vector<int> coordinates;                                 ///< its own
  bool towards_parent = false;                                  ///< in the tree the parent hangs on the child
};

/// A coordinate that follows others.
struct ForeignCoupling {
  std::string name;
  int dependent = -1;
  CoordinateFunction value;
};

struct ForeignPathPoint {
  std::string name;
  int body = -1;
  RigidTransform X_BF = RigidTransform::Identity();  ///< the frame that the location is given in
  std::array<CoordinateFunction, 3> p_F;             ///< location; constants unless the point moves
  /// The point exists while this coordinate is in [min, max].
  struct Condition {
    int coordinate = -1;
    double min = 0, max = 0;
  };
  std::optional<Condition> condition;

  bool moves() const { return !(p_F[0].isConstant() && p_F[1].isConstant() && p_F[2].isConstant()); }
};

enum class WrapShape { Cylinder, Ellipsoid };

/// An obstacle fixed to a body. A cylinder lies along z of its frame O; a sphere is an ellipsoid.
struct WrapObject {
  std::string name;
  int body = -1;
  RigidTransform X_BO = RigidTransform::Identity();
  WrapShape shape = WrapShape::Cylinder;
  Eigen::Vector3d radii_m = Eigen::Vector3d::Zero();  ///< cylinder: radius, radius, half length
  int side_axis = 0, side_sign = 0;                   ///< half that paths stay on, sign 0: either
};

struct PathWrap {
  int object = -1;
  int first_point = -1, last_point = -1;  ///< stretch of the path that may wrap; -1: from the start, to the end
};

struct ForeignPath {
  std::vector<ForeignPathPoint> points;
  std::vector<PathWrap> wraps;
};

struct ForeignModel {
  std::string name;
  std::string source;                              ///< "OpenSim 40000"
  std::string credits;                             ///< as in the file
  Eigen::Vector3d gravity_W_m_s2{0, -9.80665, 0};  ///< world: Y up
  std::vector<Segment> bodies;                     ///< Segment::parent is the body that it hangs on
  std::vector<ForeignCoordinate> coordinates;
  std::vector<ForeignJoint> joints;        ///< what a joint hangs on comes before it
  std::vector<ForeignCoupling> couplings;  ///< in an order in which each can be computed from those before
  std::vector<ForeignCoordinateForce> coordinate_forces;
  std::vector<WrapObject> wrap_objects;
  Musculature musculature;                ///< parameters of the units; their paths are below
  std::vector<std::string> muscle_kinds;  ///< by unit: "Thelen2003Muscle"
  std::vector<ForeignPath> paths;         ///< by unit
  Warnings warnings;                      ///< what was not read, or not as it was meant

  /// Index by name. @throws InputError with the nearest names if there is none.
  int coordinateIndex(std::string_view name) const;
  /// The coupling that a coordinate follows, or nullptr.
  const ForeignCoupling* couplingOf(int coordinate) const;
};

}  // namespace sinew
