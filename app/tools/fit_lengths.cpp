// sinew-fit-lengths RESOURCE_DIR OUT_DIR [PRESET]: fibre and tendon lengths of the presets, fitted to the skeleton
// and the paths. Writes OUT_DIR/reference_lengths*.csv. Run with OUT_DIR = resources/muscles after a change of
// muscles.csv, muscle_paths.csv, the skeleton, the norms or a preset (docs/methods/range_of_motion.md). A test
// compares the stored files with a fresh fit.
#include <cstdio>

#include "core/error.h"
#include "core/file.h"
#include "core/muscle/load_musculature.h"
#include "core/rom/poses/fit_preset.h"

namespace {

void fitAndWrite(const std::filesystem::path& resources, const std::filesystem::path& out, const std::string& name) {
  using namespace sinew;
  const Skeleton skeleton = loadReferenceSkeleton(resources);
  const Musculature published = loadPublishedMusculature(resources, skeleton);
  const RomPreset preset = loadRomPreset(resources, name, skeleton);
  const PresetFit fit = fitPreset(skeleton, published, preset, loadClinicalTests(resources, skeleton));
  std::printf("%s: %d rounds over the tests\n", name.c_str(), fit.rounds);
  const auto targets = preset.targets();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const SimulatedTest& r = fit.readings[i];
    std::printf("  %-20s reads %7.1f  %6.1f N m  %s\n", r.test.c_str(), r.angle_deg, r.moment_Nm,
                r.limited_by.empty() ? "" : r.limited_by.front().c_str());
  }
  writeFileAtomically(out / lengthsFile(name), lengthsCsv(fit.lengths, name + ".json"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: %s RESOURCE_DIR OUT_DIR [PRESET]\n", argv[0]);
    return 2;
  }
  try {
    for (const auto& name : sinew::romPresetNames())
      if (argc == 3 || name == argv[3]) fitAndWrite(argv[1], argv[2], name);
  } catch (const sinew::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
