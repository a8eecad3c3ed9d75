#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/geometry/triangle_mesh.h"
#include "core/geometry/view.h"
#include "core/job.h"
#include "imaging/xray/pixel_field.h"

namespace sinew {

/// Closed surface inside which X-rays are attenuated `contrast_per_m` more than in what surrounds it: a shell is an
/// outer volume and an inner one with the opposite contrast. Negative for air in tissue.
struct XrayVolume {
  TriangleMesh mesh_W;  ///< world [m]
  double contrast_per_m = 0;
};

/// Solid ball, exact rather than meshed: calibration beads.
struct XrayBall {
  Eigen::Vector3d center_W;
  double radius_m = 0;
  double contrast_per_m = 0;
};

/// Sum over all bodies of contrast times length of the pixel's ray inside: the exponent of Beer-Lambert, without
/// unit. Every triangle is drawn once per view: what leaves the body adds the distance along the ray, what enters
/// takes it away, and over a closed surface the sum is the path length. Pixels are covered by an exact fill rule on a
/// lattice of 1/1024 px, so that entries and exits balance everywhere, also on edges and outlines. The result does
/// not depend on the number of threads. Empty if the job was cancelled.
/// @throws std::logic_error if a body is not wholly in front of the source.
PixelField attenuationField(const std::vector<XrayVolume>& volumes, const std::vector<XrayBall>& balls,
                            const View& view, const Job& job = {});

}  // namespace sinew
