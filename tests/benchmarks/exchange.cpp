// Prints the table of exchanged sides in docs/validation.md: sinew_exchange [bodies]
#include <cstdio>
#include <cstdlib>

#include "tests/benchmarks/exchange_study.h"
#include "tests/support/synthetic_views.h"

int main(int argc, char** argv) {
  const int bodies = argc > 1 ? std::atoi(argv[1]) : 60;
  std::printf(
      "| picks of | exchanged | bodies | apart | recognised | named otherwise | named though together | s |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const bool deformed : {false, true})
    for (const bool slot_scan : {false, true})
      for (const auto& row : sinew::studyExchange(
               SINEW_RESOURCE_DIR, slot_scan ? sinew::test::slotScanPair() : sinew::test::coneBeamPair(), slot_scan,
               deformed, bodies)) {
        std::printf("| %s | %s | %d | %d | %d | %d | %d | %.1f |\n", row.body.c_str(), row.kind.c_str(), row.bodies,
                    row.apart, row.recognised, row.partly, row.together, row.seconds);
        std::fflush(stdout);
      }
}
