#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "clinical/case/case.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// What a person states for a new case.
struct NewCase {
  Patient patient;                            ///< empty fields are taken from the frontal image's tags
  std::vector<std::filesystem::path> images;  ///< frontal, lateral, others
  std::optional<double> declared_spacing_mm;  ///< for files that carry no pixel size
};

/// Makes the case folder: copies the images under names without patient data and stores the case.
/// @throws InputError if an image cannot be read as a radiograph or the folder holds a case already; then nothing was
/// written.
Case makeCase(const NewCase& wanted, const std::filesystem::path& folder);

/// Copies another radiograph into the case folder under a name made from its content, so that undo still finds the
/// file it replaces. @throws InputError if it cannot be read as a radiograph.
CaseImage importRadiograph(const std::filesystem::path& source, const std::filesystem::path& folder, int view,
                           std::optional<double> declared_spacing_mm);

/// Name and id as the file states them, for the fields that `patient` leaves empty.
void fillFromTags(Patient& patient, const RadiographTags& tags);

}  // namespace sinew
