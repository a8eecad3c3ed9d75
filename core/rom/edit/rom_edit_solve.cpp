#include "core/rom/edit/rom_edit_solve.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/kernel/sweep.h"
#include "core/muscle/hill.h"
#include "core/rom/edit/rom_edit_problem_internal.h"
#include "core/rom/edit/rom_edit_stops_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

Musculature onlyUnits(const Musculature& all, const std::vector<int>& units) {
  Musculature some;
  for (const int u : units) some.units.push_back(all.units[std::size_t(u)]);
  return some;
}

std::vector<double> longestLengths_m(const Musculature& musculature) {
  std::vector<double> longest_m;
  for (const auto& unit : musculature.units) longest_m.push_back(longestLength_m(unit));
  return longest_m;
}

/// Longest path of these units over the set, through T^-1 if there is one; by unit of the list. Empty if cancelled.
std::vector<double> longestOver(const PoseSet& poses, const Skeleton& skeleton, const Musculature& units,
                                const RomTransform* transform, const Job& job) {
  const PostureReader read = [&](std::size_t first, PoseTable& postures) {
    if (job.cancelled()) return;
    for (std::size_t i = 0; i < postures.poseCount(); ++i) {
      Posture q = poses.posture(first + i);
      if (transform) transform->invert(q);
      postures.set(i, q);
    }
  };
  return sweepPostures(CompiledModel{skeleton, units}, poses.size(), read).longest_m;
}

RomEditCells countedCells(const Skeleton& skeleton, const JointGoal& goal, const std::vector<std::uint8_t>& allowed,
                          std::size_t slice) {
  const JointCells& cells = *goal.cells;
  RomEditCells c{.joint = skeleton.joints[cells.joint()].name, .held = cells.held()[slice].name};
  c.cells = static_cast<int>(cells.cellCount());
  for (std::size_t i = 0; i < cells.cellCount(); ++i) {
    const std::size_t s = slice * cells.cellCount() + i;
    const bool wanted = goal.muscles[s], got = allowed[s];
    c.wanted += wanted;
    c.differing += wanted != got;
    c.either += wanted || got;
    const bool wanted_in = wanted && goal.stops[i], got_in = got && goal.stops[i];
    c.wanted_in_stops += wanted_in;
    c.differing_in_stops += wanted_in != got_in;
    c.either_in_stops += wanted_in || got_in;
  }
  return c;
}

void requireSomething(const JointGoal& goal, const std::string& joint) {
  for (std::size_t s = 0; s < goal.muscles.size(); ++s)
    if (goal.isWanted(s)) return;
  throw InputError{{"range-of-motion edit", joint, "an edit that leaves the joint a posture", "none in any cell"}};
}

void setStop(Skeleton& skeleton, int coordinate, double min_rad, double max_rad, RomEditResult& result) {
  Coordinate& c = skeleton.coordinates[coordinate];
  if (c.stop_min_rad == min_rad && c.stop_max_rad == max_rad) return;
  result.stops.push_back({c.name, c.stop_min_rad, c.stop_max_rad, min_rad, max_rad});
  c.stop_min_rad = min_rad;
  c.stop_max_rad = max_rad;
}

/// A hinge's interval moves; a ball joint remembers T, and its coordinates the box about the new range.
void setStops(const JointGoal& goal, const RomTransform& transform, RomEditResult& result) {
  Skeleton& skeleton = result.model.skeleton;
  const int joint = goal.cells->joint(), first = skeleton.joints[joint].first_coordinate;
  if (!goal.cells->isBall()) return setStop(skeleton, first, goal.hinge.min_rad, goal.hinge.max_rad, result);
  skeleton.joints[joint].edited = transform.editedRange(joint);
  const StopBox box = boxAbout(skeleton, joint, skeleton.joints[joint].edited);
  for (int i = 0; i < 3; ++i) setStop(skeleton, first + i, box.min_rad[i], box.max_rad[i], result);
}

void setLength(Model& model, int unit, double factor, std::vector<RomEditChange>& changed) {
  if (factor == 1) return;
  MusculotendonUnit& u = model.musculature.units[std::size_t(unit)];
  u.optimal_fiber_length_m *= factor;
  u.tendon_slack_length_m *= factor;
  model.length_factors.try_emplace(u.name, 1.0).first->second *= factor;
  changed.push_back({u.name, factor});
}

}  // namespace

std::vector<HeldPosture> heldPostures(const Skeleton& skeleton, int joint) {
  static const std::map<std::string_view, std::map<std::string, double>> kSlackNeighbour = {
      {"hip", {{"knee_flexion", 90}}},       {"knee", {{"hip_flexion", 90}}},
      {"ankle", {{"knee_flexion", 90}}},     {"shoulder", {{"elbow_flexion", 90}}},
      {"elbow", {{"shoulder_flexion", 90}}}, {"wrist", {{"elbow_flexion", 90}}},
      {"lumbosacral", {{"hip_flexion", 90}}}};
  const std::string& name = skeleton.joints[joint].name;
  std::vector<HeldPosture> held = {{"zero", zeroPosture(skeleton), 1}};
  const auto slack = kSlackNeighbour.find(withoutSide(name));
  if (slack == kSlackNeighbour.end()) return held;
  std::map<std::string, double> coordinates_deg;
  std::string words;
  for (const auto& [coordinate, deg] : slack->second)
    for (const std::string side : {"_r", "_l"}) {
      if (!name.ends_with(side) && withoutSide(name) != name) continue;
      coordinates_deg[coordinate + side] = deg;
      words += (words.empty() ? "" : " ") + coordinate + side + "=" + std::to_string(int(deg));
    }
  held.push_back({words, postureFromDegrees(skeleton, coordinates_deg), 0.5});
  return held;
}

struct RomEditSolver::State {
  Model reference;
  PoseSet poses;
  RomCentres centres;
  std::vector<double> longest_path_m;  ///< over the set, by unit
  std::map<int, JointCells> cells;     ///< by joint

  /// Null if cancelled.
  const JointCells* cellsOf(int joint, const Job& job) {
    const auto found = cells.find(joint);
    if (found != cells.end()) return &found->second;
    JointCells made{reference, joint, heldPostures(reference.skeleton, joint), job};
    return job.cancelled() ? nullptr : &cells.emplace(joint, std::move(made)).first->second;
  }

  /// Factor on the length of every given unit, as the paper has it.
  std::vector<double> paperFactors(const RomTransform& transform, const std::vector<int>& units,
                                   const Job& job) const {
    auto factors = longestOver(poses, reference.skeleton, onlyUnits(reference.musculature, units), &transform, job);
    for (std::size_t i = 0; i < units.size(); ++i) factors[i] /= longest_path_m[std::size_t(units[i])];
    return factors;
  }

  std::vector<double> sinewFactors(const std::vector<JointGoal>& goals, const std::vector<int>& units,
                                   const std::vector<double>& paper, const RomEditOptions& options,
                                   const Job& job) const;
};

std::vector<double> RomEditSolver::State::sinewFactors(const std::vector<JointGoal>& goals,
                                                       const std::vector<int>& units,
                                                       const std::vector<double>& paper,
                                                       const RomEditOptions& options, const Job& job) const {
  const JoinedProblem joined = joinedProblem(goals, options.weight_of_muscles_alone);
  require(joined.units == units, "the units of the problem are those that span an edited joint");
  std::vector<double> longest_m, by_paper_m;
  for (std::size_t i = 0; i < units.size(); ++i) {
    longest_m.push_back(longestLength_m(reference.musculature.units[std::size_t(units[i])]));
    by_paper_m.push_back(longest_m.back() * paper[i]);
  }
  const ThresholdFit fit = fitThresholds(joined.problem, {by_paper_m, longest_m}, longest_m, by_paper_m, job);
  if (fit.outcome != Outcome::Converged) return {};
  std::vector<double> factors;
  for (std::size_t i = 0; i < units.size(); ++i) factors.push_back(fit.threshold[i] / longest_m[i]);
  return factors;
}

RomEditSolver::RomEditSolver(const Model& reference, PoseSet poses)
    : state_{std::make_unique<State>(State{reference, std::move(poses), {}, {}, {}})} {
  require(state_->poses.size() > 0, "RomEditSolver: a pose set that is not empty");
  state_->centres = romCentres(reference.skeleton, state_->poses.stream());
  state_->longest_path_m = longestOver(state_->poses, reference.skeleton, reference.musculature, nullptr, {});
}
RomEditSolver::~RomEditSolver() = default;
RomEditSolver::RomEditSolver(RomEditSolver&&) noexcept = default;

const Model& RomEditSolver::reference() const {
  return state_->reference;
}
const RomCentres& RomEditSolver::centres() const {
  return state_->centres;
}
RomTransform RomEditSolver::transform(const RomEdits& edits) const {
  return {state_->reference.skeleton, state_->centres, edits};
}
void RomEditSolver::prepare(const std::string& joint, const Job& job) {
  state_->cellsOf(state_->reference.skeleton.jointIndex(joint), job);
}

RomEditResult RomEditSolver::solve(const RomEdits& edits, const RomEditOptions& options, const Job& job) {
  const Model& reference = state_->reference;
  const RomTransform transform = this->transform(edits);
  const RomEditResult cancelled{.outcome = Outcome::Cancelled, .model = reference};
  RomEditResult result = cancelled;
  std::vector<JointGoal> goals;
  std::set<int> spanning;
  for (const int joint : transform.joints()) {
    const JointCells* cells = state_->cellsOf(joint, job);
    if (!cells) return cancelled;
    goals.push_back(goalOf(reference, transform, *cells));
    spanning.insert(cells->units().begin(), cells->units().end());
    requireSomething(goals.back(), reference.skeleton.joints[joint].name);
  }
  const std::vector<int> units{spanning.begin(), spanning.end()};
  result.outcome = Outcome::Converged;
  if (goals.empty()) return result;
  std::vector<double> factors = state_->paperFactors(transform, units, job);
  if (!job.cancelled() && options.method == RomEditMethod::Sinew)
    factors = state_->sinewFactors(goals, units, factors, options, job);
  if (job.cancelled()) return cancelled;
  for (std::size_t i = 0; i < units.size(); ++i) setLength(result.model, units[i], factors[i], result.changed);
  const auto longest_m = longestLengths_m(result.model.musculature);
  for (const JointGoal& goal : goals) {
    setStops(goal, transform, result);
    const auto allowed = goal.cells->allowed(longest_m);
    for (std::size_t slice = 0; slice < goal.cells->held().size(); ++slice)
      result.cells.push_back(countedCells(reference.skeleton, goal, allowed, slice));
  }
  result.model.passive_moments = movedToStops(std::move(result.model.passive_moments), result.model.skeleton);
  return result;
}

}  // namespace sinew
