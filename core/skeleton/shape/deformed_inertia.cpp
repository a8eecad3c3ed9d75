#include "core/skeleton/shape/deformed_inertia.h"

#include <Eigen/Eigenvalues>
#include <array>

#include "core/skeleton/shape/field_jets_internal.h"

namespace sinew {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

struct Node {
  double x, weight;  ///< on [-1, 1], weights with sum 1
};
constexpr std::array<Node, 3> kAcross = {
    {{-0.7745966692414834, 5.0 / 18}, {0, 8.0 / 18}, {0.7745966692414834, 5.0 / 18}}};
constexpr std::array<Node, 8> kAlong = {{{-0.9602898564975363, 0.0506142681451881},
                                         {-0.7966664774136267, 0.1111905172266872},
                                         {-0.5255324099163290, 0.1568533229389436},
                                         {-0.1834346424956498, 0.1813418916891810},
                                         {0.1834346424956498, 0.1813418916891810},
                                         {0.5255324099163290, 0.1568533229389436},
                                         {0.7966664774136267, 0.1111905172266872},
                                         {0.9602898564975363, 0.0506142681451881}}};

/// Half sides of the box as columns, the longest last.
Matrix3d equivalentBox(const Segment& segment) {
  const Matrix3d& I = segment.inertia_B_kgm2;
  const Matrix3d moments = (0.5 * I.trace() * Matrix3d::Identity() - I) / segment.mass_kg;  // integral of x x^T
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal{moments};
  return principal.eigenvectors() * (3 * principal.eigenvalues().cwiseMax(0)).cwiseSqrt().asDiagonal();
}

/// Sums of share of mass, first and second moments.
struct Moments {
  double mass = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  void add(double share, const Vector3d& p) {
    mass += share;
    first += share * p;
    second += share * p * p.transpose();
  }
};

void carry(const Skeleton& reference, const std::vector<field::PointJet>& parameters, int index, Segment& segment) {
  if (!(segment.mass_kg > 0)) return;
  const Matrix3d box = equivalentBox(segment);
  const field::Place place = field::placeOf(reference, index);
  Moments sum;  // about the old centre, so that no digits are lost
  for (const Node& a : kAcross)
    for (const Node& b : kAcross)
      for (const Node& c : kAlong) {
        const Vector3d p = segment.p_BCom + box * Vector3d{a.x, b.x, c.x};
        const auto [image, jacobian] = field::jacobianAt(reference, parameters, place, p);
        sum.add(a.weight * b.weight * c.weight * jacobian.determinant(), image - segment.p_BCom);
      }
  const Vector3d centre = sum.first / sum.mass;
  const Matrix3d second = segment.mass_kg * (sum.second - sum.mass * centre * centre.transpose());
  segment.mass_kg *= sum.mass;
  segment.p_BCom += centre;
  segment.inertia_B_kgm2 = second.trace() * Matrix3d::Identity() - second;
}

}  // namespace

std::vector<Segment> deformedInertias(const Skeleton& reference, const std::vector<double>& parameters) {
  const auto jets = field::pointJets(parameters);
  std::vector<Segment> segments = reference.segments;
  for (int i = 0; i < reference.movingSegmentCount(); ++i) carry(reference, jets, i, segments[std::size_t(i)]);
  return segments;
}

}  // namespace sinew
