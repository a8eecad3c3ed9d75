#include "app/model/retarget/rom_edit_study.h"

#include <algorithm>

#include "core/retarget/prepared/reference.h"
#include "core/rom/edit/rom_edit_target.h"

namespace sinew {
namespace {

double widest(const std::optional<RomMap>& map) {
  double widest_rad = 0;
  if (map)
    for (int polar = 0; polar < RomMap::kPolars; ++polar)
      for (int azimuth = 0; azimuth < RomMap::kAzimuths; ++azimuth)
        widest_rad = std::max(widest_rad, map->twistWidth_rad(polar, azimuth));
  return widest_rad;
}

}  // namespace

/// Centres and maps before an edit belong to a body: kept until another one comes.
struct RomEditStudy::Memory {
  std::shared_ptr<const Model> base;
  RomCentres centres;
  std::map<std::string, RomMap> before;

  void take(const std::shared_ptr<const Model>& model, const RetargetReference& reference) {
    if (base == model) return;
    centres = romCentres(model->skeleton, reference.poses().stream());
    before.clear();
    base = model;
  }
  const RomMap& mapBefore(const std::string& joint, const Posture& zero) {
    const auto found = before.find(joint);
    return found != before.end() ? found->second : before.emplace(joint, romMap(*base, joint, zero)).first->second;
  }
};

RomEditStudy::RomEditStudy(QObject* parent) : QObject{parent}, memory_{std::make_shared<Memory>()} {
  connect(&job_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) emit failed(message);
  });
}

void RomEditStudy::ask(std::shared_ptr<const RetargetReference> reference, std::shared_ptr<const SolvedBody> body,
                       const std::string& joint_name, const RomEdits& edits) {
  job_.post(
      tr("Range of motion"),
      [this, memory = memory_, reference, body, joint_name, edits](const Job& job) -> JobRunner::Finish {
        memory->take(body->base, *reference);
        const Model& base = *body->base;
        const Skeleton& skeleton = base.skeleton;
        const int joint = skeleton.jointIndex(joint_name);
        const RomTransform transform{skeleton, memory->centres, edits},
            earlier{skeleton, memory->centres, editsBefore(edits, joint_name)};
        RomEditPicture picture{.joint = joint_name,
                               .is_ball = skeleton.joints[std::size_t(joint)].type == JointType::Ball};
        const bool solved = body->design.rom == edits;
        if (picture.is_ball) {
          const Posture zero = zeroPosture(skeleton);
          picture.before = memory->mapBefore(joint_name, zero);
          picture.ball_before =
              ballRange(earlier.changes(joint) ? editedRomMap(base, earlier, joint_name, zero) : *picture.before,
                        memory->centres, joint);
          if (earlier.changes(joint)) {
            const TwistSwing middle =
                earlier.ballInverse(joint, {picture.ball_before.twist_centre_rad, picture.ball_before.centre_J});
            picture.ball_before.centre_J = middle.direction_J;
            picture.ball_before.twist_centre_rad = middle.twist_rad;
          }
          if (job.cancelled()) return {};
          picture.wanted =
              transform.changes(joint) ? editedRomMap(base, transform, joint_name, zero) : *picture.before;
          if (solved && !job.cancelled()) {
            picture.reached = romMap(*body->model, joint_name, zero);
            picture.error = compare(*picture.wanted, *picture.reached);
          }
          picture.widest_rad = std::max({widest(picture.before), widest(picture.wanted), widest(picture.reached)});
        } else {
          const HingeRange stops = hingeRange(skeleton, memory->centres, joint);
          const auto through = [&](const RomTransform& t) {
            return HingeRange{t.hingeInverse(joint, stops.centre_rad), t.hingeInverse(joint, stops.low_rad),
                              t.hingeInverse(joint, stops.high_rad)};
          };
          picture.hinge_before = through(earlier);
          picture.hinge_wanted = through(transform);
          picture.hinge_reached = hingeRange((solved ? body->model : body->base)->skeleton, memory->centres, joint);
        }
        return [this, picture = std::move(picture)] {
          picture_ = picture;
          emit answered();
        };
      });
}

std::vector<std::string> editableJoints(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const auto& joint : skeleton.joints)
    if (joint.type != JointType::Free) names.push_back(joint.name);
  return names;
}

}  // namespace sinew
