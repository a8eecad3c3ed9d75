#include "clinical/exam/exam_study.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/random_source.h"

namespace sinew {
namespace {

double factorOf(const ExamFit& fit, const std::string& group) {
  for (const GroupFactor& g : fit.groups)
    if (g.group == group && g.side == 'r') return g.factor;
  return NAN;
}

/// "inside the norm", "beyond what the joint", ...
std::string kindOf(const std::string& reason) {
  constexpr int kWords = 3;
  std::size_t end = 0;
  for (int i = 0; i < kWords && end != std::string::npos; ++i) end = reason.find_first_of(" ,:(", end + 1);
  return reason.substr(0, end);
}

}  // namespace

std::vector<FactorCurve> factorCurves(const Examiner& examiner, bool leave_in_norm, double step_deg) {
  std::vector<FactorCurve> curves;
  for (const ClinicalTest* test : examiner.tests().form()) {
    if (test->form->groups.empty()) continue;
    FactorCurve curve{.test = test->id, .group = test->form->groups.front()};
    for (double x = test->form->entry_min_deg; x <= test->form->entry_max_deg; x += step_deg) {
      PhysicalExam exam{.leave_in_norm = leave_in_norm};
      exam.entries.push_back({test->id, 'r', x});
      curve.measured_deg.push_back(x);
      curve.factor.push_back(factorOf(examiner.fit(exam, {}, false), curve.group));
    }
    const double direction = curve.factor.back() >= curve.factor.front() ? 1 : -1;
    for (std::size_t i = 1; i < curve.factor.size(); ++i) {
      const double step = direction * (curve.factor[i] - curve.factor[i - 1]);
      curve.largest_slope_per_deg = std::max(curve.largest_slope_per_deg, std::abs(step) / step_deg);
      curve.largest_step_back = std::max(curve.largest_step_back, -step);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

RandomExams randomExams(const Examiner& examiner, bool leave_in_norm, int exams, unsigned seed) {
  RandomSource random{seed};
  RandomExams study{.exams = exams};
  std::map<std::string, int> reasons;
  for (int e = 0; e < exams; ++e) {
    PhysicalExam exam{.leave_in_norm = leave_in_norm};
    for (const ClinicalTest* test : examiner.tests().form()) {
      const bool chosen = random.uniform() < 0.5;
      const double x = random.uniform(test->form->doubt_min_deg, test->form->doubt_max_deg);
      if (chosen && !test->form->groups.empty()) exam.entries.push_back({test->id, 'r', x});
    }
    const ExamFit fit = examiner.fit(exam, {}, false);
    study.not_solved += fit.outcome != Outcome::Converged;
    for (const ExamComparison& line : fit.tests) {
      if (!line.measured_deg) continue;
      ++study.tests;
      if (!(std::abs(line.residual_deg) <= kNamedResidual_deg)) {
        ++study.off;
        study.unnamed += line.reason.empty();
        ++reasons[kindOf(line.reason)];
      }
    }
  }
  study.reasons.assign(reasons.begin(), reasons.end());
  std::ranges::stable_sort(study.reasons, std::greater<>{}, &std::pair<std::string, int>::second);
  return study;
}

}  // namespace sinew
