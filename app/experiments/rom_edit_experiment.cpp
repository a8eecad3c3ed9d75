#include "app/experiments/rom_edit_experiment.h"

#include "core/angle.h"
#include "core/rom/poses/pose_sampler.h"

namespace sinew {
namespace {

std::vector<RomEdits> experimentEdits() {
  const auto forward = [](double deg) { return RomTilt{.towards = "forward", .angle_rad = deg * kRadPerDeg}; };
  return {{{.joint = "hip_r", .cone_factor = 0.63, .tilt = forward(30)}},
          {{.joint = "hip_r", .cone_factor = 0.8}},
          {{.joint = "hip_r", .tilt = forward(15)}},
          {{.joint = "shoulder_r", .cone_factor = 0.7, .twist_factor = 0.8}},
          {{.joint = "ankle_r", .cone_factor = 0.7, .tilt = {.towards = "down", .angle_rad = 10 * kRadPerDeg}}},
          {{.joint = "knee_r", .range_factor = 0.8, .shift_rad = 10 * kRadPerDeg}},
          {{.joint = "elbow_r", .range_factor = 0.7}}};
}

}  // namespace

RomEditSolver romEditSolver(const Model& reference, const std::filesystem::path& resource_dir,
                            std::string_view preset) {
  const RomPreset data = loadRomPreset(resource_dir, preset, reference.skeleton);
  const ClinicalTests norms = loadClinicalTests(resource_dir, reference.skeleton);
  return {reference, sampledPoseSet(reference.skeleton, data, norms.tests)};
}

RomEditExperiment romEditExperiment(const std::filesystem::path& resource_dir, const Job& job) {
  RomEditExperiment experiment{.outcome = Outcome::Cancelled};
  const auto edits = experimentEdits();
  const std::size_t count = edits.size() * romPresetNames().size();
  for (const std::string& preset : romPresetNames()) {
    if (job.cancelled()) return {.outcome = Outcome::Cancelled};
    const Model reference = loadReferenceModel(resource_dir, preset);
    RomEditSolver solver = romEditSolver(reference, resource_dir, preset);
    for (const RomEdits& edit : edits) {
      job.report(double(experiment.rows.size()) / double(count), inWords(edit.front()));
      const RomEditResult paper = solver.solve(edit, {.method = RomEditMethod::Paper}, job);
      const RomEditResult sinew = solver.solve(edit, {}, job);
      if (job.cancelled()) return {.outcome = Outcome::Cancelled};
      experiment.rows.push_back({reference.name, edit, paper.cells, sinew.cells, paper.changed, sinew.changed});
    }
  }
  experiment.outcome = Outcome::Converged;
  return experiment;
}

}  // namespace sinew
