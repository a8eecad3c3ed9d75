#pragma once
#include "app/plot/ink.h"
#include "clinical/report/report.h"

namespace sinew {

/// Passive moment over the angle of one test: before (dashed) and after (solid) the lengths were fitted, the moment
/// at which the examiner stops, the measured angle, the norm's band.
void drawMomentPlot(Ink& ink, const QRectF& box_mm, const PassiveMomentPlot& plot);

/// What the lines mean; drawn once a page.
void drawMomentLegend(Ink& ink, const QRectF& box_mm);

}  // namespace sinew
