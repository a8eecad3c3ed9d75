// Where DART is not installed.
#include "app/bench/dart_peer.h"

namespace sinew {

struct DartPeer::Impl {};
std::unique_ptr<DartPeer> DartPeer::make(const Model&) {
  return nullptr;
}
std::string DartPeer::version() {
  return "DART";
}
DartPeer::DartPeer(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
DartPeer::~DartPeer() = default;
Eigen::VectorXd DartPeer::positions(const Posture&) const {
  return {};
}
void DartPeer::setPositions(const Eigen::VectorXd&) {}
void DartPeer::moveTo(const Eigen::VectorXd&) {}
Eigen::Vector3d DartPeer::inWorld(int, const Eigen::Vector3d& p_B) const {
  return p_B;
}
RigidTransform DartPeer::X_WB(int) const {
  return RigidTransform::Identity();
}
void DartPeer::lengths(std::span<const int>, std::vector<double>&) const {}

}  // namespace sinew
