#pragma once
#include <vector>

#include "core/geometry/view.h"
#include "core/job.h"
#include "core/model/model.h"
#include "core/skeleton/kinematics.h"
#include "imaging/xray/exposure.h"
#include "imaging/xray/path_length.h"

namespace sinew {

/// Everything between source and detector.
struct XrayScene {
  std::vector<XrayVolume> volumes;
  std::vector<XrayBall> balls;
  std::vector<TriangleMesh> spongy_W;  ///< solids with trabecular texture
  std::vector<TriangleMesh> muscle_W;  ///< solids streaked by fat between the muscles
};

/// Bones and soft tissues of a posed model. Progress is the job's; empty if it was cancelled.
XrayScene patientScene(const Model& model, const Posture& posture, const Job& job = {});

/// Attenuation with texture: attenuationField() of all bodies, plus random variation whose standard deviation grows
/// with the root of the path length, as it does for a sum over independent grains. Texture belongs to the view: it is
/// not the projection of one three-dimensional pattern. `pixel_mm` is the pixel at the patient. Empty if cancelled.
PixelField renderScene(const XrayScene& scene, const View& view, double pixel_mm, std::uint64_t seed,
                       const Job& job = {});

}  // namespace sinew
