#pragma once
#include <string>
#include <string_view>

namespace sinew {

/// What a clinician calls a movement that increases (or decreases) a clinical coordinate: "knee flexion", "hip
/// lateral rotation". Words of the joint motions where those have them; no side. A name that is not known stays as it
/// is, with "less " in front if it decreases.
std::string motionWords(std::string_view coordinate, bool increases);

}  // namespace sinew
