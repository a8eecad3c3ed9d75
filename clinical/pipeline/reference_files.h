#pragma once
#include <array>

namespace sinew {

/// Files of the resources that the reference model is made of, and those of `more`: for StageRow::resources.
template <class... Names>
constexpr auto referenceModelAnd(Names... more) {
  return std::array<const char*, 8 + sizeof...(more)>{"muscles/muscle_paths.csv",
                                                      "muscles/muscles.csv",
                                                      "muscles/reference_lengths.csv",
                                                      "rom/average-adult.json",
                                                      "skeleton/bone_meshes.bin",
                                                      "skeleton/landmarks.csv",
                                                      "skeleton/passive_moments.json",
                                                      "skeleton/reference_skeleton.json",
                                                      more...};
}

}  // namespace sinew
