#pragma once

namespace sinew {

constexpr const char* kVersion = "0.1.0";
constexpr const char* kDisclaimer = "Research use only - not a medical device, not a basis for treatment.";

}  // namespace sinew
