#pragma once
#include <map>
#include <string>

#include "clinical/exam/physical_exam.h"
#include "clinical/synthetic/synthetic_case.h"

namespace sinew {

struct SyntheticExam {
  PhysicalExam exam;
  std::map<std::string, double> length_factors;  ///< by unit, of the muscles that are short
  std::string diagnosis;
};

/// Contractures of a body of this shape, and what an examiner finds: hamstrings (factor 0.86-0.92) and hip flexors
/// (0.72-0.76) short on both sides, each side its own, gastrocnemius on one (0.88-0.91); every test of the form
/// on both sides, simulated on the model of the patient's mass and age with these lengths at the threshold of its
/// mass, with the options' noise, rounded to whole degrees.
SyntheticExam drawExam(const RetargetReference& reference, const ShapeParameters& shape, const Patient& patient,
                       const SyntheticOptions& options);

}  // namespace sinew
