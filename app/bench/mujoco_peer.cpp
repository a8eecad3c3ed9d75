#include "app/bench/mujoco_peer.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "core/io/mjcf/mjcf.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

struct ModelDeleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
};
struct DataDeleter {
  void operator()(mjData* d) const { mj_deleteData(d); }
};

std::unique_ptr<mjModel, ModelDeleter> load(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* kName = "model.xml";
  if (mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(xml.size())) != 0)
    throw std::runtime_error{"MuJoCo has no room for the model"};
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), kName)], xml.data(), xml.size());
  char message[1000] = "";
  std::unique_ptr<mjModel, ModelDeleter> model{mj_loadXML(kName, files.get(), message, sizeof message)};
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error{std::string{"MuJoCo: "} + message};
  return model;
}

}  // namespace

struct MujocoPeer::Impl {
  Skeleton skeleton;
  std::unique_ptr<mjModel, ModelDeleter> m;
  std::unique_ptr<mjData, DataDeleter> d;

  explicit Impl(const Model& model) : skeleton{model.skeleton}, m{load(mjcfText(model))} {
    m->opt.jacobian = mjJAC_SPARSE;  // its own choice here would be dense, a quarter slower
    d.reset(mj_makeData(m.get()));
  }

  /// A hinge for each coordinate instead of a ball.
  bool hasHinges(const Joint& joint) const {
    return mj_name2id(m.get(), mjOBJ_JOINT, skeleton.coordinates[joint.first_coordinate].name.c_str()) >= 0;
  }

  int address(const std::string& joint) const {
    const int id = mj_name2id(m.get(), mjOBJ_JOINT, joint.c_str());
    if (id < 0) throw std::runtime_error{"MuJoCo has no joint " + joint};
    return m->jnt_qposadr[id];
  }
};

MujocoPeer::MujocoPeer(std::unique_ptr<Impl> impl) : impl_{std::move(impl)} {}
MujocoPeer::~MujocoPeer() = default;

std::unique_ptr<MujocoPeer> MujocoPeer::make(const Model& model) {
  return std::unique_ptr<MujocoPeer>{new MujocoPeer{std::make_unique<Impl>(model)}};
}

std::string MujocoPeer::version() {
  return std::string{"MuJoCo "} + mj_versionString();
}

Eigen::VectorXd MujocoPeer::positions(const Posture& q) const {
  const Skeleton& s = impl_->skeleton;
  const Eigen::VectorXd clinical = clinicalFromPosture(s, q);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(impl_->m->nq);
  const auto setTurn = [&](int at, const Eigen::Matrix3d& R) {
    const Eigen::Quaterniond turn{R};
    x.segment<4>(at) << turn.w(), turn.x(), turn.y(), turn.z();
  };
  for (const Joint& joint : s.joints) {
    const int first = joint.first_coordinate;
    if (joint.type == JointType::Free) {
      const int at = impl_->address(joint.name);
      x.segment<3>(at) = joint.X_PJ * Eigen::Vector3d{q.segment<3>(first)};
      setTurn(at + 3, joint.X_PJ.linear() * rotationFromVector<double>(q.segment<3>(first + 3)));
    } else if (impl_->hasHinges(joint)) {
      for (int i = first; i < first + joint.coordinate_count; ++i)
        x[impl_->address(s.coordinates[i].name)] = clinical[i];
    } else {
      setTurn(impl_->address(joint.name), rotationFromVector<double>(q.segment<3>(first)));
    }
  }
  for (const auto& d : s.patellae)
    x[impl_->address(s.segments[d.segment].name + "_glide")] = d.glide(q[d.knee_coordinate])[0];
  return x;
}

void MujocoPeer::setPositions(const Eigen::VectorXd& positions) {
  std::copy(positions.begin(), positions.end(), impl_->d->qpos);
}

void MujocoPeer::lengthsAndGradients() {
  mj_kinematics(impl_->m.get(), impl_->d.get());
  mj_comPos(impl_->m.get(), impl_->d.get());
  mj_tendon(impl_->m.get(), impl_->d.get());
}

double MujocoPeer::length_m(int unit) const {
  return impl_->d->ten_length[unit];
}

Eigen::Vector3d MujocoPeer::p_WB(int segment) const {
  const int id = mj_name2id(impl_->m.get(), mjOBJ_BODY, impl_->skeleton.segments[segment].name.c_str());
  return Eigen::Map<const Eigen::Vector3d>(impl_->d->xpos + 3 * id);
}

double MujocoPeer::passiveForce_N(int unit) {
  mju_zero(impl_->d->act, impl_->m->na);
  mju_zero(impl_->d->qvel, impl_->m->nv);
  mj_forward(impl_->m.get(), impl_->d.get());
  return -impl_->d->actuator_force[impl_->m->nu - impl_->m->ntendon + unit];  // one tendon a muscle, muscles last
}

Eigen::VectorXd MujocoPeer::actuatorMoments_Nm() {
  mju_zero(impl_->d->act, impl_->m->na);
  mju_zero(impl_->d->qvel, impl_->m->nv);
  mj_forward(impl_->m.get(), impl_->d.get());
  const Skeleton& s = impl_->skeleton;
  Eigen::VectorXd moments_Nm = Eigen::VectorXd::Zero(s.coordinateCount());
  const auto at = [&](const std::string& joint) {
    return impl_->d->qfrc_actuator + impl_->m->jnt_dofadr[mj_name2id(impl_->m.get(), mjOBJ_JOINT, joint.c_str())];
  };
  for (const Joint& joint : s.joints) {
    if (joint.type == JointType::Free) continue;
    const bool ball = !impl_->hasHinges(joint);
    for (int i = 0; i < joint.coordinate_count; ++i) {
      const int c = joint.first_coordinate + i;
      moments_Nm[c] = ball ? at(joint.name)[i] : *at(s.coordinates[std::size_t(c)].name);
    }
  }
  return moments_Nm;
}

bool MujocoPeer::simulate(int steps) {
  for (int i = 0; i < steps; ++i) mj_step(impl_->m.get(), impl_->d.get());
  const mjWarningStat* w = impl_->d->warning;
  return w[mjWARN_BADQPOS].number + w[mjWARN_BADQVEL].number + w[mjWARN_BADQACC].number == 0;
}

}  // namespace sinew
