#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

namespace sinew {

// Solids described by a signed distance: negative inside, positive outside, metres. Distances are exact for spheres,
// boxes and sheets; for elliptic shapes they are the first-order estimate k0 (k0 - 1) / k1 of Quilez (2008), exact on
// the surface and in sign. All values are lower bounds good enough to skip empty space.

/// One simple solid.
class Primitive {
 public:
  virtual ~Primitive() = default;
  virtual double distance(const Eigen::Vector3d& p) const = 0;
  /// Corners of a box that holds the solid.
  const Eigen::Vector3d& lower() const { return lower_; }
  const Eigen::Vector3d& upper() const { return upper_; }
  /// Distance to that box: never more than distance().
  double boundDistance(const Eigen::Vector3d& p) const;

 protected:
  void include(const Eigen::Vector3d& p, double reach);
  Eigen::Vector3d lower_ = Eigen::Vector3d::Constant(1e9), upper_ = Eigen::Vector3d::Constant(-1e9);
};

/// Right-handed axes from two directions: columns u, v (made perpendicular to u), u x v.
Eigen::Matrix3d axesFrom(const Eigen::Vector3d& u, const Eigen::Vector3d& v);

std::unique_ptr<Primitive> makeSphere(const Eigen::Vector3d& center, double radius_m);
/// Radii along the columns of `axes`.
std::unique_ptr<Primitive> makeEllipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii_m,
                                         const Eigen::Matrix3d& axes);
/// Half sizes along the columns of `axes`, edges rounded by `rounding_m` within that size.
std::unique_ptr<Primitive> makeBox(const Eigen::Vector3d& center, const Eigen::Vector3d& half_m,
                                   const Eigen::Matrix3d& axes, double rounding_m);
/// Elliptic cylinder with flat rounded ends: half size.x and .z are the radii, .y the half height along axes.col(1);
/// `waist` is the share by which the radii shrink at half height (vertebral bodies).
std::unique_ptr<Primitive> makeDrum(const Eigen::Vector3d& center, const Eigen::Vector3d& half_m,
                                    const Eigen::Matrix3d& axes, double rounding_m, double waist);

/// A point of a tube's centre line and its elliptic section there.
struct TubeStation {
  Eigen::Vector3d center;
  double u_radius_m = 0;  ///< along `u`
  double v_radius_m = 0;  ///< across `u` and the centre line
  Eigen::Vector3d u = Eigen::Vector3d::UnitZ();
};
/// Chain of tapered elliptic capsules along a Catmull-Rom spline through the stations (at least two): shafts, ribs,
/// processes, and, with unequal radii, blades.
std::unique_ptr<Primitive> makeTube(const std::vector<TubeStation>& stations);

/// A point of a sheet and half its thickness there.
struct SheetPoint {
  Eigen::Vector3d p;
  double half_thickness_m = 0;
};
/// Curved plate with round edges over a smoothly interpolated grid of points (at least 2 x 2, rows of equal length).
std::unique_ptr<Primitive> makeSheet(const std::vector<std::vector<SheetPoint>>& rows);

/// How a part joins what the parts before it have made.
enum class JoinKind { Add, Cut, Keep };  ///< union, subtraction, intersection

struct SurfacePart {
  JoinKind join = JoinKind::Add;
  double blend_m = 0.004;  ///< radius of the fillet at the joint
  std::shared_ptr<const Primitive> primitive;
};

/// A solid made of parts in their order.
class ImplicitSurface {
 public:
  /// `symmetric`: only z >= 0 is described, the other half is its mirror image (bones on the midline).
  /// The first part must be added.
  explicit ImplicitSurface(std::vector<SurfacePart> parts, bool symmetric = false);

  double distance(const Eigen::Vector3d& p) const;
  /// Gradient of the distance (central differences), about unit length near the surface.
  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const;
  /// Point of the surface near `p`, along the gradient; exact to 1 um for smooth surroundings.
  Eigen::Vector3d nearestSurfacePoint(const Eigen::Vector3d& p) const;
  /// Corners of a box that holds the solid.
  Eigen::Vector3d lower() const { return lower_; }
  Eigen::Vector3d upper() const { return upper_; }

 private:
  std::vector<SurfacePart> parts_;
  bool symmetric_;
  Eigen::Vector3d lower_, upper_;
};

}  // namespace sinew
