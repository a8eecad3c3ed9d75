#pragma once
#include <string>
#include <vector>

#include "core/foreign/foreign_model.h"

namespace sinew {

struct OsimOptions {
  enum class Muscles { Thelen, Millard } muscles = Muscles::Thelen;
  std::vector<std::string> remarks;  ///< lines for the credits and for a comment at the top
  /// Surfaces to show: file names beside the model, by body.
  struct Mesh {
    int body = -1;
    std::string file;
  };
  std::vector<Mesh> meshes;
};

/// The model as an OpenSim document, version 40000 (read by OpenSim 4.0 and later). Y up, metres, radians, newtons.
/// Bodies, CustomJoints between offset frames, coordinates with ranges, couplings as CoordinateCouplerConstraints,
/// paths with fixed, moving and conditional points, wrap objects, muscles with Thelen's curves as ours are, or
/// Millard's with OpenSim's defaults; passive structures as an ExpressionBasedCoordinateForce of every coordinate,
/// exactly. Names get underscores where OpenSim forbids a character, and numbers where two were the same.
std::string osimText(const ForeignModel& model, const OsimOptions& options = {});

}  // namespace sinew
