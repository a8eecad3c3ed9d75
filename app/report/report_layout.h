#pragma once
#include <functional>
#include <vector>

#include "app/plot/ink.h"
#include "app/report/report_document.h"

namespace sinew {

inline constexpr double kPageWidth_mm = 210, kPageHeight_mm = 297;  // A4

/// What one page draws. Holds what it needs of the document.
using ReportPage = std::function<void(Ink&)>;

/// Cuts the document into pages: a summary page, then annexes. Every page carries title, page number and disclaimer.
std::vector<ReportPage> layOutReport(const ReportDocument& document);

}  // namespace sinew
