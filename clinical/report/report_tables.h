#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "clinical/report/norms.h"
#include "clinical/report/report.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

// The tables of the report, each from the part of the case that it shows.

inline constexpr const char* kNotMeasured = "not measured";
inline constexpr const char* kUndetermined = "undetermined";
inline constexpr const char* kNoNorm = "no norm";

/// "12.3", "-4"; "not measured" for NaN.
std::string numberText(double value, int decimals = 0);
/// With its sign: "+3", "-4", "0".
std::string signedText(double value, int decimals = 0);
/// "Right" or "Left".
std::string sideText(char side);
/// A date from DICOM ("20260504") as 2026-05-04; what is no day says so.
std::string dateText(const std::string& date);
/// A name from DICOM ("Hong^Gildong=...=...") as people write it.
std::string personText(const std::string& dicom_name);

/// Right, left, difference, norm and z-scores of every figure: sides in this order in every table. A midline figure
/// stands in the right column and spans into the left one (kSpan).
ReportTable boneTable(const SkeletonFit& fit, const NormTable& norms, const NormQuery& who);

/// Measured, norm, simulated before and after, residual, threshold, what limits: a row a test and side of which
/// something was entered; the others are named below.
ReportTable examTable(const ExamFit& fit, const PhysicalExam& exam, const ClinicalTests& protocol);

/// Length factor a group and side with its interval, fibre alone, strength, and which tests it limits.
ReportTable muscleTable(const ExamFit& fit, const ClinicalTests& protocol);

// Annexes.
ReportTable definitionTable(const SkeletonFit& fit, const NormTable& norms);
/// Why residuals are what they are.
ReportTable residualTable(const ExamFit& fit, const ClinicalTests& protocol);
ReportTable protocolTable(const ExamFit& fit, const ClinicalTests& protocol);
ReportTable landmarkTable(const Case& c);
ReportTable lengthFactorTable(const ExamFit& fit);
ReportTable truthTable(const Case& c);
ReportTable provenanceTable(const Case& c, const std::filesystem::path& case_dir);
ReportTable resourceTable(const std::filesystem::path& resource_dir);

std::vector<PassiveMomentPlot> passiveMomentPlots(const Case& c, const Model& before, const ClinicalTests& protocol);

}  // namespace sinew
