#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/skeleton/shape/shape.h"

namespace sinew {

/// What a person says about masses, strengths and joints besides the shape; what is not named follows the scaling
/// rules of core/model/physical_scaling.h.
struct PhysicsFactors {
  std::map<std::string, double> mass_factors;      ///< by segment: times the mass of its deformed volume
  std::map<std::string, double> mass_ratios;       ///< by segment: its mass over the reference's, whatever the volume
  std::map<std::string, double> strength_factors;  ///< by unit, muscle or group: F_max over the reference's
  std::optional<double> age_years;                 ///< joints are as lax as at this age; absent: as an adult's
  friend bool operator==(const PhysicsFactors&, const PhysicsFactors&) = default;
};

/// A body relative to the reference: shape, masses, strengths. The default value is the reference itself.
struct BodyDescription {
  std::string name = "individual";
  std::string about;  ///< a sentence for people; may be empty
  ShapeParameters shape;
  PhysicsFactors physics;
  std::map<std::string, std::string> sources;  ///< where the figures come from, by field or part of the file
  friend bool operator==(const BodyDescription&, const BodyDescription&) = default;
};

/// Reads "sinew.shape", version 1: JSON that people write by hand, every field optional, both sides at once ("femur")
/// or one ("femur_r"), angles in degrees, nested or flat. See docs/methods/parametric_skeleton.md.
/// @throws InputError: file, field, expected, found; an unknown name is answered with the nearest ones.
BodyDescription loadBodyDescription(const std::filesystem::path& file);
/// Writes the same, without the fields that are 1 or 0 deg.
void saveBodyDescription(const BodyDescription& body, const std::filesystem::path& file);

/// Bodies that are shipped (resources/shapes): the four characters of Ryu et al. and a child of seven years.
const std::vector<std::string>& shapePresetNames();
/// @throws InputError for a name that is none of them, with the nearest ones.
BodyDescription loadShapePreset(const std::filesystem::path& resource_dir, const std::string& name);
/// The preset of that name, otherwise the file. @throws InputError if it is neither, naming the presets.
BodyDescription loadBody(const std::string& preset_or_file, const std::filesystem::path& resource_dir);

}  // namespace sinew
