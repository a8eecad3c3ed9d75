#pragma once
#include <vector>

#include "clinical/exam/physical_exam.h"
#include "core/rom/tests/clinical_sweep.h"

namespace sinew {

/// The tests of the form on one body, simulated once, so that many examinations of it can be fitted: what applyExam()
/// is made of, and what studies use. Model and tests must outlive it.
class Examiner {
 public:
  /// @throws InputError for a mass that is not > 0. A cancelled job leaves it unusable.
  Examiner(const Model& model, const ClinicalTests& tests, const ExamSubject& subject, const Job& job = {});
  /// @param with_intervals costs most of the time.
  ExamFit fit(const PhysicalExam& exam, const Job& job = {}, bool with_intervals = true) const;

  const ClinicalTests& tests() const { return tests_; }
  /// Tests of the form, by row.
  const std::vector<ClinicalSweep>& sweeps(char side) const { return side == 'r' ? right_ : left_; }

 private:
  const Model& model_;
  const ClinicalTests& tests_;
  ExamSubject subject_;
  std::vector<ClinicalSweep> right_, left_;  ///< by row of the form
};

}  // namespace sinew
