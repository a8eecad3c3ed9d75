#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clinical/case/case.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

// What a person does to a case, as free functions over the value: used inside CaseDocument::edit(), tested without a
// window.

const Sighting* findSighting(const Case& c, std::string_view name, int view);

/// Places or moves a landmark in one view. A new sighting takes `sigma_px`, a moved one keeps its own.
void setSighting(Case& c, const std::string& name, int view, const Eigen::Vector2d& uv_px, double sigma_px);
void removeSighting(Case& c, std::string_view name, int view);

/// Gives the picks that were found exchanged the names of the other side.
void exchangeSides(Case& c);

/// The usual placement error of this case: median of its sightings' sigma, 1 px without any.
double typicalSigma_px(const Case& c);

/// Landmarks to pick, in the protocol's order, then those that only the case knows (another protocol's, beads).
std::vector<std::string> landmarkNames(const Case& c, const std::vector<std::string>& protocol);

/// The form's line for a test and side; nullptr if nothing was entered.
const ExamEntry* findExamEntry(const Case& c, std::string_view test, char side);

/// @throws InputError if the value is outside what the test can give: test, expected range, found.
void setMeasured(Case& c, const ClinicalTests& protocol, const std::string& test, char side,
                 std::optional<double> measured_deg);
void setExamNote(Case& c, const std::string& test, char side, const std::string& note);
/// nullopt: the protocol's own threshold. @throws InputError unless 1 <= threshold <= 200 N m.
void setThreshold(Case& c, const std::string& test, char side, std::optional<double> threshold_Nm);

/// Geometry from a file or another program; the phantom is set aside.
void useImportedRig(Case& c, const BiplanarRig& rig);
/// Geometry by calibration; an imported one is set aside.
void usePhantom(Case& c, const PhantomImages& phantom);
/// Geometry from the DICOM tags of the two radiographs.
void useImageTags(Case& c);

enum class RigSource { Phantom, Imported, ImageTags };
RigSource rigSource(const Case& c);

}  // namespace sinew
