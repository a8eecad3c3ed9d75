#include "app/model/explorer/rom_study.h"

#include <algorithm>

#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

Posture withCoordinate(const Skeleton& skeleton, const Posture& held, const std::string& name, double deg) {
  Eigen::VectorXd clinical = clinicalFromPosture(skeleton, held);
  clinical[skeleton.coordinateIndex(name)] = deg * kRadPerDeg;
  return postureFromClinical(skeleton, clinical);
}

const Coordinate* firstAngleOf(const Skeleton& skeleton, const Joint& joint) {
  if (joint.type == JointType::Free) return nullptr;
  return &skeleton.coordinates[std::size_t(joint.first_coordinate)];
}

}  // namespace

double RomAnswer::widest_rad() const {
  double widest_rad = 0;
  for (const auto& map : maps)
    for (int polar = 0; polar < RomMap::kPolars; ++polar)
      for (int azimuth = 0; azimuth < RomMap::kAzimuths; ++azimuth)
        widest_rad = std::max(widest_rad, map.twistWidth_rad(polar, azimuth));
  return widest_rad;
}

std::vector<std::string> ballJoints(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const auto& joint : skeleton.joints)
    if (joint.type == JointType::Ball) names.push_back(joint.name);
  return names;
}

std::vector<std::string> secondCoordinates(const Skeleton& skeleton, const std::string& joint) {
  const int own = skeleton.jointIndex(joint);
  std::vector<std::string> names;
  for (const auto& c : skeleton.coordinates)
    if (c.joint != own && c.joint != 0) names.push_back(c.name);
  return names;
}

RomQuestion firstQuestion(const Skeleton& skeleton, const std::string& joint) {
  constexpr double kBent_deg = 90;
  RomQuestion question{joint, {}, {0, 0}};
  const Joint& own = skeleton.joints[std::size_t(skeleton.jointIndex(joint))];
  const Coordinate* neighbour = nullptr;
  for (const auto& other : skeleton.joints)
    if (!neighbour && other.parent == own.child) neighbour = firstAngleOf(skeleton, other);
  for (const auto& other : skeleton.joints)
    if (!neighbour && other.child == own.parent) neighbour = firstAngleOf(skeleton, other);
  if (!neighbour) return question;
  question.with = neighbour->name;
  question.with_deg[1] = std::min(kBent_deg, std::floor(neighbour->stop_max_rad / kRadPerDeg + 1e-9));
  return question;
}

RomStudy::RomStudy(Mapper mapper, QObject* parent) : QObject{parent}, mapper_{std::move(mapper)} {
  if (!mapper_)
    mapper_ = [](const Model& model, const std::string& joint, const Posture& held) {
      return romMap(model, joint, held);
    };
  connect(&job_, &LatestJob::idle, this, &RomStudy::idle);
}

void RomStudy::ask(std::shared_ptr<const Model> model, const RomQuestion& question, const Posture& held,
                   bool abandon_running) {
  job_.post(
      tr("Range of motion"),
      [this, mapper = mapper_, model, question, held](const Job& job) -> JobRunner::Finish {
        RomAnswer answer{question, model, held, {}, {}};
        const int count = question.with.empty() ? 1 : 2;
        for (int i = 0; i < count; ++i) {
          if (job.cancelled()) return {};
          job.report(double(i) / count, "range of motion");
          const Posture posture = question.with.empty() ? held
                                                        : withCoordinate(model->skeleton, held, question.with,
                                                                         question.with_deg[std::size_t(i)]);
          answer.maps.push_back(mapper(*model, question.joint, posture));
        }
        if (count == 2) answer.difference = compare(answer.maps[0], answer.maps[1]);
        return [this, answer = std::move(answer)] {
          answer_ = answer;
          emit answered();
        };
      },
      abandon_running);
}

void RomStudy::clear() {
  job_.cancel();
  answer_.reset();
  emit answered();
}

}  // namespace sinew
