#include "clinical/report/supported_bones.h"

#include <algorithm>
#include <set>

namespace sinew {

std::vector<BoneMesh> supportedBones(const Model& model, const std::vector<Sighting>& sightings) {
  std::set<std::string> seen;
  for (const auto& s : sightings) seen.insert(s.name);
  std::set<int> segments;
  for (const auto& landmark : model.skeleton.landmarks)
    if (seen.contains(landmark.name)) segments.insert(landmark.segment);
  for (const auto& patella : model.skeleton.patellae)
    if (segments.contains(patella.femur)) segments.insert(patella.segment);
  std::vector<BoneMesh> bones;
  std::ranges::copy_if(*model.bones, std::back_inserter(bones),
                       [&](const BoneMesh& bone) { return segments.contains(bone.segment); });
  return bones;
}

}  // namespace sinew
