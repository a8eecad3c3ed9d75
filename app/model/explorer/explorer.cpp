#include "app/model/explorer/explorer.h"

#include <algorithm>

#include "core/muscle/hill.h"
#include "core/passive/structures.h"
#include "core/posture/muscle_role.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/rom/tests/threshold.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/mirrored_posture.h"

namespace sinew {
namespace {

char sideOf(const std::string& name) {
  return name.ends_with("_l") ? 'l' : name.ends_with("_r") ? 'r' : ' ';
}

std::vector<NamedPosture> namedPostures(const std::filesystem::path& resource_dir, const Skeleton& skeleton) {
  const auto resting = restingPostures(skeleton);
  std::vector<NamedPosture> all{
      {"Standing", resting.at(0)}, {"Zero gravity", resting.at(1)}, {"T-pose", resting.at(2)}};
  for (auto& preset : loadPresetPostures(resource_dir, skeleton)) all.push_back(std::move(preset));
  return all;
}

}  // namespace

Explorer::Explorer(std::filesystem::path resource_dir, QObject* parent)
    : QObject{parent}, resource_dir_{std::move(resource_dir)} {}

void Explorer::setModel(std::shared_ptr<const Model> model, const QString& title) {
  require(model != nullptr, "setModel: no model");
  const Skeleton& skeleton = model->skeleton;
  auto motions = loadJointMotions(resource_dir_, skeleton);  // first, so that a complaint leaves the old model shown
  auto presets = namedPostures(resource_dir_, skeleton);
  examiner_Nm_ = examinerMoments_Nm(loadClinicalTests(resource_dir_, skeleton), skeleton, bodyMass_kg(skeleton));
  model_ = std::move(model);
  title_ = title;
  motions_ = std::move(motions);
  presets_ = std::move(presets);
  activation_.assign(model_->musculature.units.size(), 0);
  ranges_.clear();
  if (muscleIndex() < 0) muscle_.clear();
  emit modelChanged();
  emit muscleChanged();
  takeClinical(clinical_.size() == skeleton.coordinateCount()
                   ? clinical_
                   : Eigen::VectorXd{Eigen::VectorXd::Zero(skeleton.coordinateCount())});
}

void Explorer::takeClinical(const Eigen::VectorXd& clinical) {
  clinical_ = clinical;
  posture_ = postureFromClinical(model_->skeleton, clinical_);
  evaluation_.reset();
  ranges_current_ = false;
  emit postureChanged();
  computeRanges();
}

void Explorer::setCoordinate(int coordinate, double value) {
  if (clinical_[coordinate] == value) return;
  Eigen::VectorXd next = clinical_;
  next[coordinate] = value;
  if (linked_) {
    const int other = mirroredCoordinate(model_->skeleton, coordinate);
    if (other != coordinate) next[other] = value;
  }
  takeClinical(next);
}

void Explorer::setPosture(const Posture& posture) {
  takeClinical(clinicalFromPosture(model_->skeleton, posture));
}

void Explorer::mirror() {
  takeClinical(mirroredClinical(model_->skeleton, clinical_));
}

const PostureEvaluation& Explorer::evaluation() const {
  require(model_ != nullptr, "evaluation: no model");
  if (!evaluation_)
    evaluation_ = evaluatePosture(model_->skeleton, model_->musculature, posture_, model_->passive_moments);
  return *evaluation_;
}

void Explorer::computeRanges() {
  ranges_job_.post(tr("Joint ranges"),
                   [=, this, model = model_, clinical = clinical_, examiner_Nm = examiner_Nm_](const Job& job) {
                     auto ranges = muscleInducedRanges(*model, clinical, job, examiner_Nm);
                     return [this, model, clinical, ranges = std::move(ranges)] {
                       if (model != model_) return;
                       ranges_ = ranges;
                       ranges_current_ = clinical == clinical_;
                       emit rangesChanged();
                     };
                   });
}

std::optional<CoordinateRange> Explorer::range(int coordinate) const {
  const auto found = std::ranges::find(ranges_, coordinate, &CoordinateRange::coordinate);
  if (found == ranges_.end()) return std::nullopt;
  return *found;
}

int Explorer::muscleIndex() const {
  if (!model_ || muscle_.empty()) return -1;
  const auto& units = model_->musculature.units;
  const auto found = std::ranges::find(units, muscle_, &MusculotendonUnit::name);
  return found == units.end() ? -1 : int(found - units.begin());
}

void Explorer::setMuscle(const std::string& name) {
  if (name == muscle_) return;
  muscle_ = name;
  if (muscleIndex() < 0) muscle_.clear();
  emit muscleChanged();
}

std::vector<int> Explorer::groupOf(int unit) const {
  const auto& units = model_->musculature.units;
  const auto& wanted = units[std::size_t(unit)];
  std::vector<int> members;
  for (int i = 0; i < int(units.size()); ++i)
    if (const auto& other = units[std::size_t(i)];
        other.group == wanted.group && sideOf(other.name) == sideOf(wanted.name))
      members.push_back(i);
  return members;
}

std::vector<int> Explorer::agonistsOf(const JointMotion& motion) const {
  return agonists(evaluation(), model_->skeleton.coordinateIndex(motion.coordinate),
                  motion.end_deg > motion.start_deg);
}

void Explorer::setActivation(std::span<const int> units, double activation) {
  for (const int i : units) activation_[std::size_t(i)] = std::clamp(activation, 0.0, 1.0);
  emit coloursChanged();
}

void Explorer::relaxAll() {
  std::ranges::fill(activation_, 0.0);
  emit coloursChanged();
}

double Explorer::torque_Nm(int coordinate) const {
  const PostureEvaluation& e = evaluation();
  double torque_Nm = 0;
  for (Eigen::Index i = 0; i < e.length_m.size(); ++i)
    if (const double a = activation_[std::size_t(i)]; a > 0)
      torque_Nm += e.moment_arm_m(i, coordinate) *
                   equilibrium(model_->musculature.units[std::size_t(i)], e.length_m[i], a).force_N;
  return torque_Nm;
}

void Explorer::setColouring(MuscleColouring colouring) {
  if (colouring == colouring_) return;
  colouring_ = colouring;
  emit coloursChanged();
}

std::optional<ColourScale> Explorer::colourScale() const {
  if (!model_ || colouring_ == MuscleColouring::Group) return std::nullopt;
  ColourScale scale;
  const auto count = Eigen::Index(model_->musculature.units.size());
  switch (colouring_) {
    case MuscleColouring::Activation:
      scale = {tr("Activation, %"), 0, 100, 0, false, false, {}};
      for (const double a : activation_) scale.by_unit.push_back(100 * a);
      break;
    case MuscleColouring::FiberLength:  // where the active curve falls to half on both sides, about
      scale = {tr("Fibre length / optimal, passive"), 0.4, 1.6, 1, true, true, {}};
      for (Eigen::Index i = 0; i < count; ++i) scale.by_unit.push_back(evaluation().normalized_fiber_length[i]);
      break;
    case MuscleColouring::PassiveForce:
      scale = {tr("Passive force, % of maximal force"), 0, 20, 0, false, true, {}};
      for (Eigen::Index i = 0; i < count; ++i)
        scale.by_unit.push_back(100 * evaluation().passive_force_N[i] /
                                model_->musculature.units[std::size_t(i)].max_isometric_force_N);
      break;
    case MuscleColouring::Group:
      break;
  }
  return scale;
}

}  // namespace sinew
