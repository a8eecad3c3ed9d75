#pragma once
#include <string>

#include "core/foreign/foreign_kinematics.h"
#include "core/model/model.h"

namespace sinew {

/// How our model is put into the terms of another program, where those do not suffice.
struct ForeignOptions {
  /// A blended path point (linear blend skinning) of ours is one of:
  /// MovingPoint: on whichever of its segments, at rest or moving with one coordinate, makes the unit's length
  /// deviate
  ///   least over postures of the adult norm. Exact where a single coordinate joins the segments.
  /// HeaviestAnchor: fixed to the segment of the largest weight.
  enum class Blended { MovingPoint, HeaviestAnchor } blended = Blended::MovingPoint;
  /// The patella's angle as a function of the knee's: a spline through its curve every degree, or a quartic.
  enum class Patella { Spline, Quartic } patella = Patella::Spline;
};

/// Our model as a foreign one: bodies, joints, passive structures, coordinates (the clinical ones, same names and
/// order, then the two "patella_r_glide", "patella_l_glide"), paths; a body has the index of our segment.
///
/// Exact: bodies but the radius, units anchored to one segment a point. Not exact: blended points (see options); the
/// radius turns by the clinical pronation instead of the wrist's twist, the same while wrist flexion or deviation is
/// zero. Patellae and radii take kDrivenMass_kg from the bone that they glide on, because the other programs want
/// mass in every moving body.
ForeignModel foreignFromModel(const Model& model, const ForeignOptions& options = {});

/// Our posture there.
ForeignPosture foreignPosture(const ForeignModel& foreign, const Skeleton& skeleton, const Posture& posture);

/// Mass and inertia of a driven bone on export; the bone that it glides on has that much less.
inline constexpr double kDrivenMass_kg = 0.02, kDrivenInertia_kgm2 = 2e-5;
/// Segments with masses shared like that.
std::vector<Segment> segmentsWithDrivenMass(const Skeleton& skeleton);

/// Glide angle of a patella [rad] as a polynomial of knee flexion [rad], c0 + c1 x + ... + c4 x^4, fitted over the
/// knee's athlete range.
struct PatellaQuartic {
  double coefficients[5] = {};
  double largest_error_rad = 0;
};
PatellaQuartic patellaQuartic(const Skeleton& skeleton, const PatellaDriver& patella);

}  // namespace sinew
