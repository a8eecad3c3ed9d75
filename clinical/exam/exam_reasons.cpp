#include <algorithm>
#include <cmath>
#include <cstdio>

#include "clinical/exam/exam_problem_internal.h"

namespace sinew {
namespace {

std::string degrees(double value, int decimals = 0) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f deg", decimals, value);
  return text;
}

std::optional<double> measuredOf(const PhysicalExam& exam, const ClinicalTest& test, char side) {
  for (const auto& entry : exam.entries)
    if (entry.side == side && (entry.test == test.id || std::ranges::count(test.aliases, entry.test) > 0))
      return entry.measured_deg;
  return std::nullopt;
}

std::string normText(const MeasuredTest& t) {
  const double mean = t.test->written_deg(t.norm.mean_deg);
  if (!std::isfinite(mean)) return "the SD of its measurement";
  std::string text = "the norm, " + degrees(mean);
  if (std::isfinite(t.norm.sd_deg))
    text += " +- " + degrees(std::max(t.norm.sd_deg, t.test->form->measurement_sd_deg));
  return text;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

/// Another test that pulls the same muscles the other way.
const MeasuredTest* opponent(const SideResult& side, std::size_t i) {
  const auto missed = [&](std::size_t k) {  // > 0: held too early
    const MeasuredTest& t = (*side.tests)[k];
    const double angle_deg = (*side.after)[k].angle_deg;
    return t.sweep->direction() * (t.measured_place - t.sweep->placeOf_deg(angle_deg));
  };
  const MeasuredTest* worst = nullptr;
  double most = 0.5;
  for (std::size_t k = 0; k < side.tests->size(); ++k) {
    const bool shares = std::ranges::any_of(
        (*side.tests)[i].groups, [&](int g) { return std::ranges::count((*side.tests)[k].groups, g) > 0; });
    if (k == i || !shares || missed(k) * missed(i) > 0 || std::abs(missed(k)) < most) continue;
    most = std::abs(missed(k));
    worst = &(*side.tests)[k];
  }
  return worst;
}

}  // namespace

std::vector<const TestContradiction*> contradictionsOf(const PhysicalExam& exam, const ClinicalTests& tests,
                                                       char side) {
  std::vector<const TestContradiction*> broken;
  for (const TestContradiction& rule : tests.contradictions) {
    const auto first = measuredOf(exam, tests.test(rule.first), side);
    const auto second = measuredOf(exam, tests.test(rule.second), side);
    if (!first || !second) continue;
    const double value = rule.sum ? *first + *second : *first - *second;
    if (value < rule.least_deg || value > rule.most_deg) broken.push_back(&rule);
  }
  return broken;
}

std::string residualReason(const SideResult& side, std::size_t i, const ClinicalTests& all) {
  const MeasuredTest& t = (*side.tests)[i];
  const ExamAim& aim = (*side.aims)[i];
  const SimulatedTest& after = (*side.after)[i];
  const double direction = t.sweep->direction();
  const double own_deg = t.test->written_deg(t.sweep->angle_deg(aim.own_place));
  if (aim.in_norm) return "inside " + normText(t) + ": lengths left as they are";
  if (aim.unattainable || (t.measured_place - t.sweep->end_deg()) * direction > 0)
    return "beyond what the joint allows (" +
           (after.limited_by.empty() ? "end of the movement" : joined(after.limited_by)) + " at " +
           degrees(after.written_deg) + ")";
  for (const int g : t.groups) {
    const double f = (*side.factors)[std::size_t(g)];
    if (f < kLeastFactor + 1e-3 || f > kMostFactor - 1e-3)
      return "length factor of " + (*side.groups)[std::size_t(g)].group->title + " at its bound";
  }
  for (const TestContradiction& rule : all.contradictions) {
    if (rule.first != t.test->id && rule.second != t.test->id) continue;
    const std::string& other = rule.first == t.test->id ? rule.second : rule.first;
    const auto found = std::ranges::find_if(*side.tests, [&](const MeasuredTest& m) { return m.test->id == other; });
    if (found == side.tests->end()) continue;
    const double a = rule.first == t.test->id ? t.measured_deg : found->measured_deg;
    const double b = rule.first == t.test->id ? found->measured_deg : t.measured_deg;
    const double value = rule.sum ? a + b : a - b;
    if (value < rule.least_deg || value > rule.most_deg)
      return "contradicts " + found->test->title + ": " + rule.text;
  }
  if (aim.faded)
    return "outside of " + normText(t) + ", but this body by itself has " + degrees(own_deg) +
           ": lengths change by at most 1.2 % a degree beyond the norm";
  if (const MeasuredTest* other = opponent(side, i)) return "weighed against " + other->test->title;
  if (!after.limited_by.empty()) return "held by " + joined(after.limited_by) + "; lengths pulled to 1 by the prior";
  return "nothing holds within the movement";
}

}  // namespace sinew
