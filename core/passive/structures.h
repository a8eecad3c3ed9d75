#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/passive/passive_moment.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

// Where the passive moments of a body come from. The resource file says how large and how steep they are at the ends
// of the reference's ranges; the ends themselves are the stops of the coordinates. So a stop *is* the place where the
// structures of its end alone set the file's moment - scaled with the body - against the joint, and whoever asks for
// stops (validity, kernels, maps) and whoever asks for moments (tests, torques, exports) speak of the same
// structures.

/// One end of a coordinate, by age: how much farther it lies than an adult's. Linear between the entries, constant
/// beyond both ends.
struct LaxityByAge {
  std::string coordinate;  ///< without side
  bool upper = true;
  std::vector<double> age_years, shift_rad;  ///< positive = a wider range
  std::string source;
  double at(double age_years) const;
};
using Laxity = std::vector<LaxityByAge>;

/// How firm one end of a coordinate is in the reference's body.
struct EndStructures {
  double end_Nm = 0;  ///< moment at the stop
  double rate_per_rad = 1;
  std::string source;
  bool verified = false;  ///< the rate was taken from a publication; otherwise it is estimated
};

struct CoordinateStructures {
  std::string coordinate;  ///< without side
  EndStructures lower, upper;
};

struct PassiveStructures {
  std::vector<CoordinateStructures> coordinates;
  Laxity laxity;
};

/// Reads skeleton/passive_moments.json for a flexibility ("average-adult", core/model/rom_preset.h). @throws
/// InputError: file, entry, expected, found; also for a coordinate of `skeleton` without structures.
PassiveStructures loadPassiveStructures(const std::filesystem::path& resource_dir, const Skeleton& skeleton,
                                        std::string_view preset);

/// The moments of the reference's body at the stops of `skeleton`.
PassiveMoments passiveMomentsAtStops(const PassiveStructures& structures, const Skeleton& skeleton);

/// The same structures after the stops moved: each end's moment is reached at its stop.
PassiveMoments movedToStops(PassiveMoments moments, const Skeleton& skeleton);

/// The structures of another body: moments grow with its mass, as the examiner's torque does (force with the
/// cross-section L^2, its lever with L; mass with L^3), rates stay (angles do not scale), ends are its own stops.
/// Empty for a reference without structures.
PassiveMoments scaledStructures(const PassiveMoments& of_reference, const Skeleton& reference, const Skeleton& body);

/// Moves the stops of an adult to those of a body of this age [years]: wider by Laxity, within the athletes'
/// envelope.
void widenStops(Skeleton& skeleton, const Laxity& laxity, double age_years);

/// Sum over the segments [kg].
double bodyMass_kg(const Skeleton& skeleton);

}  // namespace sinew
