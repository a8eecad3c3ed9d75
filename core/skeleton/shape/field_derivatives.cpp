#include "core/skeleton/shape/field_derivatives.h"

#include "core/error.h"
#include "core/skeleton/shape/field_jets_internal.h"

namespace sinew {

Eigen::Matrix3d fieldJacobian(const Skeleton& reference, const std::vector<double>& parameters, int segment,
                              const Eigen::Vector3d& p_B) {
  return field::jacobianAt(reference, field::pointJets(parameters), field::placeOf(reference, segment), p_B).d_point;
}

FieldDerivatives fieldDerivatives(const Skeleton& reference, const std::vector<double>& parameters, int segment,
                                  const Eigen::Vector3d& p_B) {
  constexpr int kParameters = field::kSideBegin + 2 * field::kSideCount;
  require(int(parameters.size()) == kParameters, "fieldDerivatives: one value a shape parameter");
  using Jet = ceres::Jet<double, 3 + kParameters>;
  std::vector<Jet> jets;
  for (int i = 0; i < kParameters; ++i) jets.emplace_back(parameters[std::size_t(i)], 3 + i);
  const Vector3<Jet> p{Jet(p_B.x(), 0), Jet(p_B.y(), 1), Jet(p_B.z(), 2)};
  const Vector3<Jet> x = field::deformAt(reference, jets, field::placeOf(reference, segment), p);
  FieldDerivatives d;
  d.d_parameters.resize(3, kParameters);
  for (int i = 0; i < 3; ++i) {
    d.p_B[i] = x[i].a;
    d.d_point.row(i) = x[i].v.head<3>();
    d.d_parameters.row(i) = x[i].v.tail<kParameters>();
  }
  return d;
}

}  // namespace sinew
