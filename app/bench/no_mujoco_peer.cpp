// Where MuJoCo is not installed.
#include "app/bench/mujoco_peer.h"

namespace sinew {

struct MujocoPeer::Impl {};
std::unique_ptr<MujocoPeer> MujocoPeer::make(const Model&) {
  return nullptr;
}
std::string MujocoPeer::version() {
  return "MuJoCo";
}
MujocoPeer::MujocoPeer(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
MujocoPeer::~MujocoPeer() = default;
Eigen::VectorXd MujocoPeer::positions(const Posture&) const {
  return {};
}
void MujocoPeer::setPositions(const Eigen::VectorXd&) {}
void MujocoPeer::lengthsAndGradients() {}
double MujocoPeer::length_m(int) const {
  return 0;
}
Eigen::Vector3d MujocoPeer::p_WB(int) const {
  return Eigen::Vector3d::Zero();
}
double MujocoPeer::passiveForce_N(int) {
  return 0;
}
Eigen::VectorXd MujocoPeer::actuatorMoments_Nm() {
  return {};
}
bool MujocoPeer::simulate(int) {
  return false;
}

}  // namespace sinew
