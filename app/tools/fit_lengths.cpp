// sinew-fit-lengths RESOURCE_DIR OUT.csv: fits fibre and tendon lengths of the reference to its skeleton and paths.
// Run after a change of muscles.csv, muscle_paths.csv or the skeleton; the result belongs to
// resources/muscles/reference_lengths.csv. A test compares the stored file with a fresh fit.
#include <cstdio>

#include "core/error.h"
#include "core/file.h"
#include "core/rom/length_estimation.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s RESOURCE_DIR OUT.csv\n", argv[0]);
    return 2;
  }
  try {
    sinew::writeFileAtomically(argv[2], sinew::referenceLengthsCsv(argv[1]));
  } catch (const sinew::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
