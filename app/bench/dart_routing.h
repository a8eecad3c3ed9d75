#pragma once
#include <memory>
#include <vector>

#include "app/bench/dart_peer.h"

namespace sinew {

class RetargetReference;

/// Routing as it is programmed on top of a physics engine: the paper's energy (E_direction + w_l E_length) of one
/// unit, minimised by gradient descent with finite differences and a growing line search. Kinematics by DART, which
/// computes the poses of those bodies only that are asked for. Unknowns and stopping rule are those of the method
/// `paper`; prices of displacements are left out.
class DartRouting {
 public:
  /// How the energies are had that the differences of a gradient are of: by as many evaluations, each setting every
  /// posture of every motion, as the paper's text reads; or of all in one pass over the postures.
  enum class Differences { OneByOne, OnePass };

  /// `naive`: the new body, points anchored naively.
  DartRouting(const RetargetReference& reference, const Model& naive);
  bool isThere() const { return dart_ != nullptr; }
  /// The paper's energy of one unit where it starts.
  double startEnergy(std::size_t unit);
  /// Optimises one unit. @returns the energy reached.
  double descend(std::size_t unit, Differences differences);

 private:
  using Points = std::vector<Eigen::Vector3d>;  ///< displacements of the path points, W at the zero posture
  /// Energies for several displacements, in one pass over the postures.
  std::vector<double> energies(std::size_t unit, const std::vector<Points>& displaced);
  double energy(std::size_t unit, const Points& displaced) { return energies(unit, {displaced}).front(); }
  std::vector<double> gradient(std::size_t unit, const Points& x, double energy, Differences differences);

  const RetargetReference& reference_;
  const Model& naive_;
  std::unique_ptr<DartPeer> dart_;
  std::vector<RigidTransform> zero_;
  std::vector<std::vector<Eigen::VectorXd>> positions_;  ///< by motion and sample
};

}  // namespace sinew
