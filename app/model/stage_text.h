#pragma once
#include <QString>

#include "app/model/case_document.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// "Ready", "Out of date", ...: one or two words for a badge.
QString stateTitle(StageState state);

/// One line under a stage's title: its key figures in human words if it ran, what was entered otherwise. No patient
/// data.
QString stageLine(const Case& c, Stage stage);

/// Why a stage cannot run or should run again; empty if there is nothing to say.
QString stateExplanation(StageState state, Stage stage);

/// "0.143 x 0.143 mm (at the detector)", "size of a pixel unknown".
QString spacingText(const Radiograph& radiograph);

/// "Frontal", "Lateral", "Oblique", "View 3": by the geometry's roles, by the order of the images before there is
/// one.
QString viewTitle(const Case& c, int view);

/// "bead_phantom" -> "Bead phantom"; a method that is not known stays as it is.
QString methodTitle(const std::string& method);

/// "femur_length" -> "Femur length", "vastus_lateralis_r" -> "Vastus lateralis, right".
QString readableName(const std::string& name);
/// "r" -> "right", "l" -> "left", "" -> "".
QString sideName(std::string_view side);

/// A figure for the screen: fixed decimals, typographic minus, "-" for NaN.
QString figure(double value, int decimals);

}  // namespace sinew
