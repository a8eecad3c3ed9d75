#pragma once
#include <map>

#include "app/widgets/stages/report_page.h"

namespace sinew {

/// The page of every stage of the table. A stage that has no page of its own yet shows what its record says.
std::map<Stage, StagePage*> makeStagePages(Workspace& workspace, ReportStagePage::Renderer render_report);

}  // namespace sinew
