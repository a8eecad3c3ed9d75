#pragma once
#include <memory>
#include <string>

#include "core/model/model.h"

namespace sinew {

/// The model in MuJoCo, through the text of mjcfText().
class MujocoPeer {
 public:
  /// Null where MuJoCo is not linked. @throws std::runtime_error with MuJoCo's message if it does not take the text.
  static std::unique_ptr<MujocoPeer> make(const Model& model);
  static std::string version();  ///< "MuJoCo 2.2.2"
  ~MujocoPeer();

  /// Generalised positions of a posture: patellae at their exact glide, hinges at the clinical angles.
  Eigen::VectorXd positions(const Posture& posture) const;
  void setPositions(const Eigen::VectorXd& positions);
  /// Kinematics, lengths of all tendons and their gradients (mj_kinematics, mj_comPos, mj_tendon).
  void lengthsAndGradients();
  double length_m(int unit) const;
  Eigen::Vector3d p_WB(int segment) const;  ///< origin of a segment
  /// What the unit's muscle pulls with at rest in this posture, fully relaxed (mj_forward).
  double passiveForce_N(int unit);
  /// What all actuators together do at rest in this posture, fully relaxed (mj_forward), by our coordinates: about
  /// hinges the moment; the three entries of a ball joint are its moment vector in the frame of the child [N m].
  Eigen::VectorXd actuatorMoments_Nm();
  /// Lets it run. @returns false if MuJoCo warned of a state that is not finite.
  bool simulate(int steps);

 private:
  struct Impl;
  explicit MujocoPeer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sinew
