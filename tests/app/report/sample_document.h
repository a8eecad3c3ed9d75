#pragma once
#include "app/report/report_document.h"
#include "clinical/report/report_tables.h"

namespace sinew::test {

/// A skeleton fit as a case would store it: every figure on both sides, the left tibial torsion undetermined.
SkeletonFit sampleFit();

/// A full document from that fit, an invented examination and plain pictures.
ReportDocument sampleDocument();

}  // namespace sinew::test
