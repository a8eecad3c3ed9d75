#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/geometry/triangle_mesh.h"
#include "core/muscle/musculature.h"
#include "core/passive/passive_moment.h"
#include "core/passive/structures.h"
#include "core/skeleton/kinematics.h"
#include "core/skeleton/shape/body_description.h"
#include "core/skeleton/shape/shape.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

/// Surface of one bone; several bones may belong to one segment (tibia, fibula).
struct BoneMesh {
  std::string bone;  ///< "femur_r"
  int segment = -1;
  TriangleMesh mesh;      ///< in the segment frame
  bool supplied = false;  ///< by a person, in the place of the reference's
};

/// A whole musculoskeletal model: everything constant. Algorithms are free functions over (Model, Posture).
struct Model {
  std::string name = "reference";
  ShapeParameters shape;  ///< relative to the reference
  Skeleton skeleton;      ///< of that shape
  Musculature musculature;
  PassiveMoments passive_moments;  ///< of capsules and ligaments, by coordinate; empty = none
  Laxity laxity;                   ///< of the reference: how much wider the ranges of the young are
  std::shared_ptr<const std::vector<BoneMesh>> bones = std::make_shared<std::vector<BoneMesh>>();
  /// By unit: what the exam changed (1 if absent). A record; the lengths in `musculature` include it already.
  std::map<std::string, double> length_factors;
  /// What withPhysics() applied; nullopt: masses follow the volume alone, F_max is the reference's. A record too.
  std::optional<PhysicsFactors> physics;
};

/// The reference model from the resource folder (skeleton, landmarks, muscles, bone meshes) with the flexibility of a
/// preset: joint stops and muscle lengths (core/rom/rom_preset.h). Its name is "reference" or "reference:athlete".
/// @throws InputError: file, entry, expected, found.
Model loadReferenceModel(const std::filesystem::path& resource_dir, std::string_view preset = "average-adult");

/// Preset that a model's name asks for: "reference" and "reference:PRESET"; nullopt for the name of a file.
std::optional<std::string> presetOf(const std::string& model_name);

/// The model of a shape: bones and joints deformed, path points carried by the same field ("naive anchoring": each
/// anchor moves with its bone), fibre and tendon lengths scaled by the ratio of path lengths at the zero posture;
/// passive structures by scaledStructures(); F_max stays. @pre `reference` is undeformed. @throws InputError for a
/// shape that the deformation cannot represent.
Model deformedModel(const Model& reference, const ShapeParameters& shape);

/// Versioned JSON ("sinew.model", version 1). Bone meshes are not stored, they follow from the shape; except those
/// that a person supplied (replaceBones()): they go into a file beside it, NAME.bones.bin, of which the model file
/// keeps the name and the SHA-256.
void saveModel(const Model& model, const std::filesystem::path& file);
/// `reference` supplies the bones, and to a file from before there were passive structures its own, scaled.
/// @throws InputError: where, field, expected, found; supplied bones that are missing
/// or changed included.
Model loadModel(const std::filesystem::path& file, const Model& reference);
/// "reference", "reference:athlete" or a file.
Model loadModelByName(const std::string& name_or_file, const std::filesystem::path& resource_dir);

/// Broken invariants and doubts: weights, mirror symmetry of the reference, positive parameters, spanning joints, ...
Warnings validateModel(const Model& model);

}  // namespace sinew
