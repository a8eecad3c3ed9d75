#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/model/path_clearance.h"

namespace sinew {

/// The bones of a new body as distance fields: those of the reference with their vertices elsewhere, each made when
/// it is first asked for. Shared between threads.
class BodyBones {
 public:
  /// `distances`: of the bones of `reference`.
  BodyBones(const Model& reference, const BoneDistances& distances, const Model& body);

  int segment(int bone) const { return distances_.bones()[static_cast<std::size_t>(bone)].segment; }
  const MeshDistance& operator[](int bone) const;

 private:
  struct Lazy {
    std::once_flag once;
    std::optional<MeshDistance> distance;  ///< none: as in the reference
  };
  const BoneDistances& distances_;
  const std::vector<BoneMesh>&reference_, &body_;
  mutable std::vector<Lazy> bones_;
};

}  // namespace sinew
