#pragma once
#include <filesystem>
#include <string>

#include "core/foreign/foreign_model.h"

namespace sinew {

/// Reads an OpenSim model: documents of version 4 (40000 and later: joint set, sockets) and of versions 2 and 3
/// (joints inside bodies). Bodies, joints, coordinates, couplings, muscles of every kind with the common fields,
/// paths.
///
/// Joints: Weld, Pin, Slider, Universal, Gimbal, Ball, Planar, Ellipsoid, Free, Custom with any SpatialTransform of
/// Constant, LinearFunction, PolynomialFunction, PiecewiseLinearFunction, SimmSpline, MultiplierFunction. Ball and
/// free joints turn about x, y, z of the child in this order. Points: fixed, moving, conditional. Wraps: cylinder,
/// sphere; ellipsoid by the shortest plane way (foreign_wrap.h).
///
/// What is not used is named in ForeignModel::warnings: forces that are no muscles, other constraints, tori, joints
/// of plug-ins (then rigid), splines of other kinds (then SimmSpline), curve parameters other than ours.
/// @throws InputError: file and line, element, expected, found.
ForeignModel readOsim(const std::filesystem::path& file);
/// The same from text; `where` names it in complaints.
ForeignModel osimFromText(const std::string& text, const std::string& where);

}  // namespace sinew
