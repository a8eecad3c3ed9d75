#include "core/skeleton/mirrored_posture.h"

#include "core/error.h"

namespace sinew {

int mirroredCoordinate(const Skeleton& skeleton, int coordinate) {
  std::string name = skeleton.coordinates[std::size_t(coordinate)].name;
  if (withoutSide(name) == name) return coordinate;
  name.back() = name.back() == 'r' ? 'l' : 'r';
  return skeleton.coordinateIndex(name);
}

Eigen::VectorXd mirroredClinical(const Skeleton& skeleton, const Eigen::VectorXd& clinical) {
  require(clinical.size() == skeleton.coordinateCount(), "one entry a coordinate");
  Eigen::VectorXd image(clinical.size());
  for (int i = 0; i < int(clinical.size()); ++i) {
    const Coordinate& c = skeleton.coordinates[std::size_t(i)];
    const int other = mirroredCoordinate(skeleton, i);
    // A turn about an axis in the plane of symmetry, or a shift across it, changes its sign; the axes of the two
    // sides are each other's images already.
    const Eigen::Vector3d axis = c.translational ? mirrored(c.axis) : mirroredAxis(c.axis);
    image[other] = other == i && axis.dot(c.axis) < 0 ? -clinical[i] : clinical[i];
  }
  return image;
}

}  // namespace sinew
