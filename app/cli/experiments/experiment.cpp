#include "app/cli/experiments/experiment.h"

#include "app/cli/support/retarget_reference.h"
#include "app/cli/support/text_table.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {

const RetargetReference& ExperimentContext::reference() {
  if (!reference_)
    reference_ = preparedReference(session_, reference_name_, "sinew experiment",
                                   {{"format", "sinew.experiments"},
                                    {"version", 1},
                                    {"outcome", nameOf(Outcome::Cancelled)},
                                    {"experiments", Json::array()}});
  return *reference_;
}

const std::vector<Character>* ExperimentContext::characters() {
  if (!characters_.empty()) return &characters_;
  std::vector<Character> made;
  for (const char* name : {"human", "alien", "hulk", "dwarf"}) {
    made.push_back(makeCharacter(reference(), loadShapePreset(session_.resourceDir(), name), job()));
    if (made.back().retargeted.outcome != Outcome::Converged) return nullptr;
  }
  characters_ = std::move(made);
  return &characters_;
}

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> list = {
      {"rom-preservation", "range of motion of the hip with other femora", romPreservationReport},
      {"pose-dependence", "range of motion of the hip with the knee straight and flexed", poseDependenceReport},
      {"rom-edit", "the range of motion of a joint edited, muscle lengths solved again", romEditReport},
      {"disorders", "muscles that reverse with limbs of 60-250 %", disordersReport},
      {"characters", "the four characters", charactersReport},
      {"peak-torque", "angles of peak torque of the four characters", peakTorqueReport},
      {"moment-arms", "moment arms of the four characters", momentArmsReport},
      {"popliteal", "unilateral popliteal angle at 50 N m", poplitealReport},
      {"exam", "length factors over the measured angles, and random examinations", examReport},
      {"energy", "energy, time and kept functions against the paper's method", energyReport}};
  return list;
}

std::string percentText(double share, int decimals) {
  return fixed(100 * share, decimals) + " %";
}

}  // namespace sinew
