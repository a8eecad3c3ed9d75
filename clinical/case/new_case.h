#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "clinical/case/case.h"
#include "core/date.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// Files of a bead phantom that a person supplies: an image a view, frontal first, and its bead positions.
struct PhantomFiles {
  std::vector<std::filesystem::path> images;
  std::filesystem::path beads;
};

/// What a person states for a new case.
struct NewCase {
  Patient patient;                            ///< empty fields are taken from the frontal image's tags
  std::vector<std::filesystem::path> images;  ///< frontal, lateral, others
  std::optional<double> declared_spacing_mm;  ///< for files that carry no pixel size
  std::optional<PhantomFiles> phantom;        ///< at most one of phantom and rig
  std::optional<BiplanarRig> rig;
  std::vector<Sighting> sightings;
  PhysicalExam exam;
};

struct MadeCase {
  Case c;
  Warnings doubts;  ///< of the images' tags; nothing of it names the patient
};

/// Makes the case folder: copies the files under names without patient data and stores the case. Where the tags say
/// that another image than the first is the frontal one it becomes view 1.
/// @throws InputError if an image cannot be read as a radiograph, there are fewer than two or one twice, something
/// stated cannot be (see setPatient()), or the folder holds a case or other files already; then nothing was written.
MadeCase makeCase(const NewCase& wanted, const std::filesystem::path& folder, const Date& today);

/// Copies another radiograph into the case folder under a name made from its content, so that undo still finds the
/// file it replaces. @throws InputError if it cannot be read as a radiograph.
CaseImage importRadiograph(const std::filesystem::path& source, const std::filesystem::path& folder, int view,
                           std::optional<double> declared_spacing_mm);

/// Copies the files of a phantom into the case folder, named likewise.
PhantomImages importPhantom(const PhantomFiles& files, const std::filesystem::path& folder);

/// Name, id, sex and birth date as the file states them, for the fields that `patient` leaves empty. Returns what was
/// left out because it cannot be: a birth date that is no day.
Warnings fillFromTags(Patient& patient, const RadiographTags& tags);

}  // namespace sinew
