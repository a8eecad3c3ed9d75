#pragma once
#include <string>

#include "clinical/case/case.h"

namespace sinew {

// Words that several stages use in their summaries.

/// Adds `more` to `warnings`, each message after "`source`: ".
void addWarnings(Warnings& warnings, const Warnings& more, const std::string& source = {});
/// "12.34"
std::string rounded(double value, int decimals);
/// "1 landmark", "3 landmarks"
std::string counted(std::size_t n, const char* one, const char* many);
/// "bead_phantom" -> "Bead phantom"; a method of calibration that is not known stays as it is.
std::string calibrationMethodTitle(const std::string& method);

}  // namespace sinew
