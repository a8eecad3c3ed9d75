// Prints the tables of deformed bones of docs/validation.md: estimate against truth for deformities that are made by
// laws of their own, outside the model's family of shapes.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.h"
#include "tests/benchmarks/deformity_study.h"
#include "tests/support/synthetic_views.h"

namespace {

void print(const sinew::DeformityStudy& study, const char* only) {
  std::printf("\n### %s, %+.0f %s\n\n", study.deformity.c_str(), study.amount, study.unit.c_str());
  std::printf(
      "%d draws, %d not converged, a bone outside the model said in %d, %d true picks left out, median %.0f ms.\n\n",
      study.draws, study.not_converged, study.outside, study.left_out, study.median_ms);
  std::printf("| figure | unit | determined | triangulated | bias | SD | 95 %% half width | coverage |\n");
  std::printf("|---|---|---:|---:|---:|---:|---:|---:|\n");
  for (const auto& row : study.rows)
    if (!only || row.quantity == only)
      std::printf("| %s | %s | %d of %d | %d | %+.2f | %.2f | %.2f | %.0f %% |\n", row.quantity.c_str(),
                  row.unit.c_str(), row.determined, row.determined + row.undetermined, row.triangulated, row.bias,
                  row.sd, row.half_width95, 100 * row.coverage);
}

/// One line a deformity: the worst of its lengths and axes, the worst coverage, and what is undetermined.
void printLine(const sinew::DeformityStudy& study) {
  const auto isAxis = [](const std::string& q) {
    return q == "hka" || q == "pelvic_obliquity" || q == "knee_flexion";
  };
  double mm = 0, deg = 0, other = 0, least = 1, covered = 0, all = 0;
  std::string least_of, open;
  for (const auto& row : study.rows) {
    if (row.determined > 1) {
      double& worst = row.unit == "mm" ? mm : isAxis(row.quantity) ? deg : other;
      if (std::abs(row.bias) > std::abs(worst)) worst = row.bias;
      if (row.coverage < least) least = row.coverage, least_of = row.quantity;
      covered += row.coverage * row.determined, all += row.determined;
    }
    if (2 * row.undetermined > study.draws) open += (open.empty() ? "" : ", ") + row.quantity;
  }
  std::printf("| %s | %+.0f %s | %+.2f | %+.2f | %+.2f | %.0f %% | %.0f %% %s | %d | %d | %s |\n",
              study.deformity.c_str(), study.amount, study.unit.c_str(), mm, deg, other, 100 * covered / all,
              100 * least, least_of.c_str(), study.outside, study.left_out, open.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  int draws = 30;
  bool whole = false;
  const char *only = nullptr, *deformity_filter = nullptr;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--draws") == 0 && i + 1 < argc && std::atoi(argv[i + 1]) > 1) {
      draws = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--whole") == 0) {
      whole = true;
    } else if (std::strcmp(argv[i], "--figure") == 0 && i + 1 < argc) {
      only = argv[++i];
    } else if (std::strcmp(argv[i], "--deformity") == 0 && i + 1 < argc) {
      deformity_filter = argv[++i];
    } else {
      std::fprintf(stderr,
                   "usage: sinew_deformities [--draws N] [--deformity TEXT] [--whole [--figure NAME]]\n"
                   "  30 draws unless told; --whole prints every figure instead of one line a deformity\n");
      return 2;
    }
  }
  try {
    for (const bool used : {true, false}) {
      std::printf("\n%s\n", used ? "## Looked at while the model was designed" : "## Kept aside");
      if (!whole)
        std::printf(
            "\n| deformity | amount | worst bias of lengths, mm | of axes, deg | of other angles, deg | coverage | "
            "least "
            "coverage | outside | left out | undetermined |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---|\n");
      for (const auto& deformity : sinew::deformities()) {
        if (deformity.used_for_design != used) continue;
        if (deformity_filter && deformity.name.find(deformity_filter) == std::string::npos) continue;
        for (const double amount : deformity.amounts) {
          const auto study =
              sinew::studyDeformity(SINEW_RESOURCE_DIR, sinew::test::coneBeamPair(), deformity, amount, 1, draws);
          if (whole)
            print(study, only);
          else
            printLine(study);
        }
      }
    }
  } catch (const sinew::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
