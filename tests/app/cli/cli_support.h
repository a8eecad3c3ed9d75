#pragma once
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "core/strict_json.h"
#include "tests/support/resources.h"
#include "tests/support/run_program.h"

namespace sinew::test {

/// Runs the real program with these arguments.
inline ProgramResult sinewProgram(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), SINEW_EXECUTABLE);
  return runProgram(arguments);
}

/// Standard output as the one JSON document that it has to be.
inline Json documentOf(const ProgramResult& result) {
  return parseJson(result.out, "stdout");
}

/// The four beads of the real biplane wrist pair as a sightings file. @returns its text.
std::string wristSightings(const std::filesystem::path& beads_csv);

}  // namespace sinew::test
