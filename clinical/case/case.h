#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clinical/case/stage.h"
#include "clinical/exam/physical_exam.h"
#include "core/job.h"
#include "core/skeleton/fit/fit_skeleton.h"
#include "core/skeleton/fit/side_exchange.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"
#include "imaging/rig/triangulate.h"

namespace sinew {

/// A file of the case folder, pinned by its content.
struct FileReference {
  std::string path;  ///< relative to the case folder
  std::string sha256;
  friend bool operator==(const FileReference&, const FileReference&) = default;
};

struct Patient {
  std::string id, name;    ///< never leave the case folder except in the report
  std::string sex;         ///< "F", "M", "O" or ""
  std::string birth_date;  ///< ISO 8601 or ""
  std::string diagnosis;
  std::optional<double> height_m, mass_kg;
  friend bool operator==(const Patient&, const Patient&) = default;
};

struct CaseImage {
  FileReference file;
  std::optional<double> declared_spacing_mm;  ///< stated by a person, for files without
  friend bool operator==(const CaseImage&, const CaseImage&) = default;
};

/// Images of a bead phantom in the same views, one each, and its known bead positions (CSV name,x_mm,y_mm,z_mm).
struct PhantomImages {
  std::vector<FileReference> images;
  FileReference beads;
  friend bool operator==(const PhantomImages&, const PhantomImages&) = default;
};

/// What a stage left: how it ended, from which inputs.
struct StageRecord {
  Outcome outcome = Outcome::NotRun;
  std::string input_hash;  ///< of everything the stage read; a stage is stale when today's differs
  double seconds = 0;
  Warnings warnings;
  std::string summary;  ///< key figures in one line, no patient data
  friend bool operator==(const StageRecord&, const StageRecord&) = default;
};

/// True values of a synthetic patient, kept with the case so that estimates can be compared.
struct Truth {
  std::vector<BoneFigure> figures;               ///< intervals unused
  std::map<std::string, double> length_factors;  ///< by unit
  unsigned seed = 0;
};

/// The whole document as a value. Everything a person entered, and every result. See docs/methods/case_format.md.
struct Case {
  Patient patient;
  // entered
  std::vector<CaseImage> images;            ///< view 1 (frontal), view 2 (lateral), others
  std::optional<PhantomImages> phantom;     ///< calibrate from these ...
  std::optional<BiplanarRig> imported_rig;  ///< ... or take this ...; neither: geometry from the DICOM tags
  std::vector<Sighting> sightings;
  PhysicalExam exam;
  std::optional<Truth> truth;
  // computed
  std::optional<BiplanarRig> rig;
  std::optional<Triangulation> landmarks;
  std::vector<SideExchange> exchanged_sides;  ///< names of left and right exchanged, as the landmarks stage found
  std::optional<SkeletonFit> skeleton;
  std::optional<FileReference> musculature;  ///< retargeted to the skeleton, before the exam; named by its content
  std::optional<FileReference> model;        ///< results/model.json: after musculature and exam
  std::optional<ExamFit> exam_fit;
  std::optional<FileReference> report;  ///< results/report.pdf
  std::map<Stage, StageRecord> stages;
};
/// Equality of the stored form: two cases are equal if case.json would be.
bool operator==(const Case& a, const Case& b);

}  // namespace sinew
