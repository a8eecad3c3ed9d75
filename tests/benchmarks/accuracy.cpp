// Prints the accuracy tables of docs/validation.md: estimate against truth over bodies drawn from the population,
// with what goes wrong between a body and its picks.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.h"
#include "tests/benchmarks/accuracy_study.h"

namespace {

using sinew::AccuracyStudy;
using sinew::Disturbance;

struct Result {
  Disturbance disturbance;
  AccuracyStudy study;
};

void printErrors(const Result& result) {
  const AccuracyStudy& study = result.study;
  std::printf("\n#### %s\n\n", result.disturbance.name.c_str());
  std::printf("| figure | unit | determined | bias | SD | largest error | 95 %% half width | coverage |\n");
  std::printf("|---|---|---:|---:|---:|---:|---:|---:|\n");
  for (const auto& row : study.rows)
    std::printf("| %s | %s | %d of %d | %+.3f | %.3f | %.3f | %.3f | %.1f %% |\n", row.quantity.c_str(),
                row.unit.c_str(), row.determined, row.determined + row.undetermined, row.bias, row.sd, row.max,
                row.half_width95, 100 * row.coverage);
}

/// One line a disturbance: a number of every figure.
template <class Number>
void printTable(const std::vector<Result>& results, const char* title, const char* format, Number number) {
  std::printf("\n%s\n\n| disturbance |", title);
  for (const auto& row : results.front().study.rows) std::printf(" %s |", row.quantity.c_str());
  std::printf("\n|---|");
  for (std::size_t i = 0; i < results.front().study.rows.size(); ++i) std::printf("---:|");
  std::printf("\n");
  for (const Result& result : results) {
    std::printf("| %s |", result.disturbance.name.c_str());
    for (const auto& row : result.study.rows) std::printf(format, number(row));
    std::printf("\n");
  }
}

void printWarnings(const std::vector<Result>& results) {
  std::printf(
      "\nBodies with a warning, and medians of what the residuals say of the picks:\n\n"
      "| disturbance | all figures | not converged | patient moved | a joint moved | outlier | pick scale | "
      "definition scale | blur mm | ms a fit |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const auto& [disturbance, s] : results)
    std::printf("| %s | %.1f %% | %d | %d | %d | %d | %.2f | %.2f | %.2f | %.0f |\n", disturbance.name.c_str(),
                100 * s.coverage(), s.not_converged, s.movement_warnings, s.joint_warnings, s.outlier_warnings,
                s.pick_scale, s.definition_scale, s.blur_mm, s.median_ms);
}

struct Options {
  int bodies = 60, first_seed = 1;
  bool further = false, errors = false;
  std::string only;  ///< part of a disturbance's name
};

Options optionsFrom(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0; };
    if (is("--bodies") && i + 1 < argc && std::atoi(argv[i + 1]) > 0) {
      options.bodies = std::atoi(argv[++i]);
    } else if (is("--first-seed") && i + 1 < argc) {
      options.first_seed = std::atoi(argv[++i]);
    } else if (is("--only") && i + 1 < argc) {
      options.only = argv[++i];
    } else if (is("--further")) {
      options.further = true;
    } else if (is("--errors")) {
      options.errors = true;
    } else {
      std::fprintf(stderr,
                   "usage: sinew_accuracy [--bodies N] [--first-seed N] [--further] [--errors] [--only NAME]\n"
                   "  60 bodies from seed 1; --further: the disturbances that no prior was chosen with;\n"
                   "  --errors: bias, spread and width of every figure\n");
      std::exit(2);
    }
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = optionsFrom(argc, argv);
  try {
    for (const auto& rig : {sinew::coneBeamRig(), sinew::slotScanRig()}) {
      std::vector<Result> results;
      for (const auto& disturbance : options.further ? sinew::furtherDisturbances() : sinew::requiredDisturbances()) {
        const bool movement =
            disturbance.yaw_deg != 0 || disturbance.knees_deg != 0 || disturbance.sway_mm != std::array<double, 3>{};
        if (rig.simultaneous && (movement || disturbance.nominal || disturbance.k1 != 0)) continue;
        if (disturbance.name.find(options.only) == std::string::npos) continue;
        results.push_back({disturbance, sinew::studyAccuracy(SINEW_RESOURCE_DIR, rig, disturbance, options.first_seed,
                                                             options.bodies)});
      }
      if (results.empty()) continue;
      std::printf("\n### %s\n\n%d bodies, seeds from %d, picks of 1 mm SD in each view.\n", rig.name.c_str(),
                  options.bodies, options.first_seed);
      printTable(results, "Coverage of the 95 % intervals:", " %.1f |",
                 [](const auto& row) { return 100 * row.coverage; });
      printTable(results, "Half width of the 95 % intervals, mm and deg:", " %.2f |",
                 [](const auto& row) { return row.half_width95; });
      printWarnings(results);
      if (options.errors)
        for (const Result& result : results) printErrors(result);
    }
  } catch (const sinew::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
