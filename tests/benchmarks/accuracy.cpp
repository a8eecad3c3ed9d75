// Prints the accuracy tables of docs/validation.md: estimate against truth over bodies drawn from the population.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.h"
#include "tests/benchmarks/accuracy_study.h"
#include "tests/support/synthetic_views.h"

namespace {

void print(const char* rig, const char* noise, const sinew::AccuracyStudy& study) {
  std::printf("\n### %s, %s\n\n", rig, noise);
  std::printf("%d bodies, %d not converged, median %.0f ms of processor time a fit.\n\n", study.bodies,
              study.not_converged, study.median_ms);
  std::printf("| figure | unit | determined | bias | SD | largest error | 95 %% half width | coverage |\n");
  std::printf("|---|---|---:|---:|---:|---:|---:|---:|\n");
  for (const auto& row : study.rows)
    std::printf("| %s | %s | %d of %d | %+.3f | %.3f | %.3f | %.3f | %.1f %% |\n", row.quantity.c_str(),
                row.unit.c_str(), row.determined, row.determined + row.undetermined, row.bias, row.sd, row.max,
                row.half_width95, 100 * row.coverage);
}

}  // namespace

int main(int argc, char** argv) {
  int seeds = 200;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--seeds") == 0 && i + 1 < argc && std::atoi(argv[i + 1]) > 0) {
      seeds = std::atoi(argv[++i]);
    } else {
      std::fprintf(stderr, "usage: sinew_accuracy [--seeds N]   (N >= 1, 200 unless told)\n");
      return 2;
    }
  }
  try {
    struct Rig {
      const char* name;
      std::vector<sinew::View> views;
    };
    const Rig rigs[] = {{"Cone-beam pair", sinew::test::coneBeamPair()},
                        {"Slot-scan pair", sinew::test::slotScanPair()}};
    for (const auto& rig : rigs)
      for (const double noise_mm : {0.0, 1.0})
        print(rig.name, noise_mm > 0 ? "picking noise of 1 mm SD in each view" : "noise-free",
              sinew::studyAccuracy(SINEW_RESOURCE_DIR, rig.views, noise_mm, seeds));
  } catch (const sinew::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
