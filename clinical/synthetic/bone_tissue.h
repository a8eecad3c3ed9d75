#pragma once
#include <vector>

#include "core/model/model.h"
#include "imaging/xray/path_length.h"

namespace sinew {

/// What X-rays meet in one bone.
struct BoneTissue {
  std::vector<XrayVolume> volumes;  ///< compact shell, spongy inside, marrow cavity; contrast against muscle
  TriangleMesh spongy_W;            ///< surface of the spongy part, whose texture shows
};

/// Splits a bone into a compact shell and a spongy inside. The shell is thin at the ends and thick in the shaft of
/// long bones (tables in the source), where a marrow cavity runs; its inner surface is the bone's surface moved
/// inwards along the vertex normals. The bone stays in the frame of its segment up to `X_WB`.
BoneTissue boneTissue(const BoneMesh& bone, const RigidTransform& X_WB);

/// The same surface with four times the triangles: each edge is split at a point that lies off the chord by the
/// sagitta which the normals at its ends imply, so that outlines are round at the size of a pixel.
TriangleMesh smoothlySubdivided(const TriangleMesh& mesh);

}  // namespace sinew
