#include "core/skeleton/motion_words.h"

#include <algorithm>

#include "core/skeleton/skeleton.h"

namespace sinew {
namespace {

struct Words {
  std::string_view coordinate, increase, decrease;
};

constexpr Words kWords[] = {
    {"pelvis_tx", "pelvis forward", "pelvis backward"},
    {"pelvis_ty", "pelvis up", "pelvis down"},
    {"pelvis_tz", "pelvis to the right", "pelvis to the left"},
    {"pelvis_tilt", "pelvis anterior tilt", "pelvis posterior tilt"},
    {"pelvis_list", "pelvis list to the right", "pelvis list to the left"},
    {"pelvis_rotation", "pelvis rotation to the left", "pelvis rotation to the right"},
    {"hip_flexion", "hip flexion", "hip extension"},
    {"hip_adduction", "hip adduction", "hip abduction"},
    {"hip_internal_rotation", "hip medial rotation", "hip lateral rotation"},
    {"knee_flexion", "knee flexion", "knee extension"},
    {"ankle_dorsiflexion", "foot dorsiflexion", "foot plantarflexion"},
    {"ankle_inversion", "foot inversion", "foot eversion"},
    {"ankle_internal_rotation", "foot medial rotation", "foot lateral rotation"},
    {"lumbar_flexion", "lumbar flexion", "lumbar extension"},
    {"lumbar_lateral_flexion", "lumbar lateral flexion to the right", "lumbar lateral flexion to the left"},
    {"lumbar_rotation", "lumbar rotation to the right", "lumbar rotation to the left"},
    {"thorax_flexion", "thoracic flexion", "thoracic extension"},
    {"thorax_lateral_flexion", "thoracic lateral flexion to the right", "thoracic lateral flexion to the left"},
    {"thorax_rotation", "thoracic rotation to the right", "thoracic rotation to the left"},
    {"neck_flexion", "neck flexion", "neck extension"},
    {"neck_lateral_flexion", "neck lateral flexion to the right", "neck lateral flexion to the left"},
    {"neck_rotation", "neck rotation to the right", "neck rotation to the left"},
    {"head_flexion", "head flexion", "head extension"},
    {"girdle_elevation", "shoulder girdle elevation", "shoulder girdle depression"},
    {"girdle_protraction", "shoulder girdle protraction", "shoulder girdle retraction"},
    {"girdle_posterior_tilt", "shoulder girdle posterior tilt", "shoulder girdle anterior tilt"},
    {"shoulder_flexion", "shoulder flexion", "shoulder extension"},
    {"shoulder_adduction", "shoulder adduction", "shoulder abduction"},
    {"shoulder_internal_rotation", "shoulder medial rotation", "shoulder lateral rotation"},
    {"elbow_flexion", "elbow flexion", "elbow extension"},
    {"forearm_pronation", "forearm pronation", "forearm supination"},
    {"wrist_flexion", "wrist flexion", "wrist extension"},
    {"wrist_ulnar_deviation", "wrist ulnar deviation", "wrist radial deviation"}};

}  // namespace

std::string motionWords(std::string_view coordinate, bool increases) {
  const auto found = std::ranges::find(kWords, withoutSide(coordinate), &Words::coordinate);
  if (found != std::end(kWords)) return std::string{increases ? found->increase : found->decrease};
  return (increases ? "" : "less ") + std::string{coordinate};
}

}  // namespace sinew
