#pragma once

namespace sinew {

enum class Precision {
  Double,
  Single  ///< twice as many lanes: about twice as fast, lengths within 0.01 mm
};

}  // namespace sinew
