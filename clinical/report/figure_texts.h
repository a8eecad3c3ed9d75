#pragma once
#include <string>
#include <vector>

#include "clinical/report/norms.h"
#include "core/skeleton/fit/bone_figure.h"
#include "core/skeleton/fit/landmark_protocol.h"

namespace sinew {

// What window, command line and report say about where a figure comes from and what would determine it.

/// "Femoral torsion right"; the title alone for a figure of the midline.
std::string nameInWords(const BoneFigure& figure, const NormTable& norms);

/// "Femur length right: 412.1 mm from the picks themselves (triangulated), 405.2 (404.0 to 406.4) by the fitted
/// bone": one sentence for every figure that is taken from the picks.
std::vector<std::string> triangulatedTexts(const std::vector<BoneFigure>& figures, const NormTable& norms);

/// One line for all figures that the same landmarks would determine, those that need the fewest first: "Femoral
/// torsion right, neck-shaft angle right: pick right femoral neck base".
std::vector<std::string> adviceTexts(const std::vector<FigureAdvice>& advice, const NormTable& norms,
                                     const std::vector<ProtocolLandmark>& protocol);

}  // namespace sinew
