#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "clinical/exam/exam_problem_internal.h"
#include "clinical/exam/examiner.h"
#include "core/rom/tests/threshold.h"

namespace sinew {
namespace {

constexpr double kUnchanged = 1e-4;                         // a factor nearer to 1 than this is no change
constexpr std::string_view kAdultPreset = "average-adult";  // whose norms an adult patient has

const ExamEntry* entryOf(const PhysicalExam& exam, const ClinicalTest& test, char side) {
  for (const ExamEntry& e : exam.entries)
    if (e.side == side && (e.test == test.id || std::ranges::count(test.aliases, e.test) > 0)) return &e;
  return nullptr;
}

/// What is known about one side before anything is solved.
struct Side {
  char side;
  std::vector<const ClinicalTest*> form;
  const std::vector<ClinicalSweep>* sweeps;  ///< by row of the form
  std::vector<const ExamEntry*> entry;       ///< by row; nullptr: none
  std::vector<double> threshold_Nm;          ///< by row
  std::vector<TestNorm> norm;                ///< by row
  std::vector<FreeGroup> groups;             ///< that measured tests may change
  std::vector<MeasuredTest> measured;        ///< those tests
  std::vector<std::size_t> row;              ///< of every measured test
};

FreeGroup freeGroup(const Model& model, const LengthGroup& group, char side) {
  FreeGroup free{.group = &group, .units = {}};
  double length_m = 0, fiber_m = 0;
  for (const auto& name : group.units) {
    free.units.push_back(model.musculature.unitIndex(name + "_" + side));
    const auto& unit = model.musculature.units[std::size_t(free.units.back())];
    length_m += unit.optimal_fiber_length_m + unit.tendon_slack_length_m;
    fiber_m += unit.optimal_fiber_length_m;
  }
  free.mean_length_m = length_m / double(group.units.size());
  free.mean_fiber_share = fiber_m / length_m;
  return free;
}

/// Groups of every measured test, and the tests with them.
void gatherMeasured(const Model& model, const ClinicalTests& tests, Side& s) {
  const auto counts = [&](std::size_t i) {
    return s.entry[i] && s.entry[i]->measured_deg && !s.form[i]->form->groups.empty();
  };
  for (const auto& group : tests.groups)
    for (std::size_t i = 0; i < s.form.size(); ++i)
      if (counts(i) && std::ranges::count(s.form[i]->form->groups, group.name) > 0) {
        s.groups.push_back(freeGroup(model, group, s.side));
        break;
      }
  for (std::size_t i = 0; i < s.form.size(); ++i) {
    if (!counts(i)) continue;
    MeasuredTest m{.test = s.form[i], .sweep = &(*s.sweeps)[i], .threshold_Nm = s.threshold_Nm[i], .norm = s.norm[i]};
    m.measured_deg = *s.entry[i]->measured_deg;
    m.measured_place = m.sweep->placeOf_deg(m.test->form->angle_deg(m.measured_deg));
    for (const auto& name : m.test->form->groups)
      m.groups.push_back(
          int(std::ranges::find_if(s.groups, [&](const FreeGroup& g) { return g.group->name == name; }) -
              s.groups.begin()));
    s.measured.push_back(std::move(m));
    s.row.push_back(i);
  }
}

Side sideOf(const Model& model, const PhysicalExam& exam, const ClinicalTests& tests, const ExamSubject& subject,
            char side, const std::vector<ClinicalSweep>& sweeps) {
  Side s{.side = side, .form = tests.form(), .sweeps = &sweeps};
  const NormGroup who{std::string{kAdultPreset}, subject.age_y, subject.sex};
  for (const ClinicalTest* test : s.form) {
    s.entry.push_back(entryOf(exam, *test, side));
    const ExamEntry* entry = s.entry.back();
    s.threshold_Nm.push_back(entry && entry->threshold_Nm ? *entry->threshold_Nm
                                                          : scaledThreshold_Nm(*test, subject.mass_kg));
    s.norm.push_back(normOf(*test, who));
  }
  gatherMeasured(model, tests, s);
  return s;
}

struct SideFit {
  Outcome outcome = Outcome::Converged;
  std::vector<ExamAim> aims;                ///< by measured test
  std::vector<double> factors, fiber_only;  ///< by group; empty if there is no solution
  std::vector<FactorInterval> intervals;    ///< by group; empty if there are none
};

/// What each group's own test asks of it alone: a start for muscles that hold at once, or nowhere.
std::vector<double> askedAlone(const Side& s, const std::vector<ExamAim>& aims) {
  std::vector<double> factors(s.groups.size(), 1.0);
  for (std::size_t i = 0; i < s.measured.size(); ++i)
    if (!aims[i].in_norm)
      factors[std::size_t(s.measured[i].groups.front())] = aims[i].faded ? aims[i].faded_to : aims[i].asked;
  return factors;
}

/// From unchanged lengths; once more from what the tests ask each by itself, where that leaves much unmet.
SideFit solve(const Side& s, bool leave_in_norm, double length_sd_m, bool with_intervals, const Job& job) {
  SideFit fit;
  if (s.measured.empty()) return fit;
  SideProblem problem{.tests = &s.measured, .groups = &s.groups};
  problem.prior_means.assign(s.groups.size(), 1.0);
  SideProblem as_measured = problem;
  for (const MeasuredTest& m : s.measured) {
    fit.aims.push_back(aimOf(m, s.groups, leave_in_norm));
    problem.places.push_back(fit.aims.back().place);
    problem.sds_deg.push_back(fit.aims.back().sd_deg);
    problem.faded_to.push_back(fit.aims.back().faded_to);
    as_measured.places.push_back(m.measured_place);
  }
  const std::vector<double> ones(s.groups.size(), 1.0);
  SideSolution both = solveSide(problem, ones, job);
  constexpr double kStuck = 2;  // cost of one residual of two SD: the start may have had no slope to follow
  if (!both.usable() || both.cost > kStuck) {
    const SideSolution other = solveSide(problem, askedAlone(s, fit.aims), job);
    if (other.usable() && (!both.usable() || other.cost < 0.9 * both.cost)) both = other;
  }
  fit.outcome = both.outcome;
  fit.factors = both.factors;
  if (!both.usable()) return fit;
  problem.scaled = Scaled::FiberOnly;
  fit.fiber_only = solveSide(problem, ones, job).factors;
  if (with_intervals) fit.intervals = factorIntervals(as_measured, both.factors, length_sd_m, job);
  if (job.cancelled()) fit.outcome = Outcome::Cancelled;
  return fit;
}

std::vector<LengthChange> changesOf(const ClinicalTests& tests, const ClinicalTest& test, char side,
                                    const std::map<std::string, double>& factors) {
  std::vector<LengthChange> changes;
  for (const auto& name : test.form->groups)
    for (const auto& unit : tests.group(name).units) {
      const auto factor = factors.find(unit + "_" + side);
      changes.push_back({unit + "_" + side, factor == factors.end() ? 1.0 : factor->second});
    }
  return changes;
}

std::string comparedOnly(const ClinicalTest& test, const SimulatedTest& after) {
  std::string text = "compared only: no muscle length is fitted to it (" + test.limited_by + ")";
  if (!after.limited_by.empty()) text += "; on the model it ends at " + after.limited_by.front();
  return text;
}

/// A measurement that no choice of lengths could meet: said, not left to be found in a table.
void warnIfUnmet(const ClinicalTest& test, const ExamComparison& line, Warnings& warnings) {
  if (!line.measured_deg || !(std::abs(line.residual_deg) > test.form->measurement_sd_deg)) return;
  char text[96];
  std::snprintf(text, sizeof text, " (%s): measured %.0f deg, the fitted model gives %.0f deg",
                line.side == 'r' ? "right" : "left", *line.measured_deg, line.simulated_after_deg);
  warnings.push_back({"exam_not_met", test.title + text + ": " + line.reason});
}

void addGroups(const ClinicalTests& tests, const Side& s, const SideFit& fit, ExamFit& result) {
  for (const auto& group : tests.groups) {
    GroupFactor row{.group = group.name, .side = s.side};
    const auto found = std::ranges::find_if(s.groups, [&](const FreeGroup& g) { return g.group == &group; });
    if (found != s.groups.end() && !fit.factors.empty()) {
      const auto g = std::size_t(found - s.groups.begin());
      row.tested = true;
      row.factor = fit.factors[g];
      if (!fit.fiber_only.empty()) row.fiber_only_factor = fit.fiber_only[g];
      if (!fit.intervals.empty()) {
        // What was left at the norm, or faded, lies inside: the interval is that of the measurements themselves.
        row.lower95 = std::min(fit.intervals[g].lower, row.factor);
        row.upper95 = std::max(fit.intervals[g].upper, row.factor);
        row.determined = fit.intervals[g].determined;
      }
      for (const int unit : found->units) {
        const auto k = std::size_t(std::ranges::find(found->units, unit) - found->units.begin());
        if (std::abs(row.factor - 1) > kUnchanged) result.length_factors[group.units[k] + "_" + s.side] = row.factor;
      }
      if (row.factor < kLeastFactor + 1e-3 || row.factor > kMostFactor - 1e-3)
        result.warnings.push_back({"length_factor_at_bound", group.title + (s.side == 'r' ? ", right" : ", left") +
                                                                 ": length factor at its bound; muscle lengths alone "
                                                                 "cannot meet this examination"});
    }
    result.groups.push_back(row);
  }
}

void addLines(const ClinicalTests& tests, const Side& s, const SideFit& fit, ExamFit& result) {
  const bool solved = s.measured.empty() || !fit.factors.empty();
  const LengthFactors factors =
      fit.factors.empty() ? LengthFactors{} : lengthFactors(s.groups, fit.factors, Scaled::FiberAndTendon);
  std::vector<SimulatedTest> after;
  for (std::size_t i = 0; i < s.form.size(); ++i)
    after.push_back((*s.sweeps)[i].simulate(s.threshold_Nm[i], factors));
  std::vector<SimulatedTest> after_measured;
  for (const std::size_t i : s.row) after_measured.push_back(after[i]);
  const SideResult side{&s.measured, &s.groups, &fit.aims, &fit.factors, &after_measured};
  for (std::size_t i = 0; i < s.form.size(); ++i) {
    const ClinicalTest& test = *s.form[i];
    ExamComparison line{.test = test.id, .side = s.side};
    line.threshold_Nm = s.threshold_Nm[i];
    line.norm_mean_deg = test.written_deg(s.norm[i].mean_deg);
    line.norm_sd_deg = s.norm[i].sd_deg;
    line.simulated_before_deg = (*s.sweeps)[i].simulate(line.threshold_Nm).written_deg;
    if (solved) line.simulated_after_deg = after[i].written_deg;
    line.stopped_by_joint = after[i].stopped_by_joint;
    line.limiting_muscles = after[i].limiting_muscles;
    line.limited_by = after[i].limited_by;
    line.changed = changesOf(tests, test, s.side, result.length_factors);
    if (s.entry[i] && s.entry[i]->measured_deg) {
      line.measured_deg = s.entry[i]->measured_deg;
      line.residual_deg = *line.measured_deg - line.simulated_after_deg;
      const auto found = std::ranges::find(s.row, i);
      if (std::abs(line.residual_deg) > kNamedResidual_deg)
        line.reason = found == s.row.end() ? comparedOnly(test, after[i])
                                           : residualReason(side, std::size_t(found - s.row.begin()), tests);
      if (solved) warnIfUnmet(test, line, result.warnings);
    }
    result.tests.push_back(std::move(line));
  }
}

}  // namespace

Examiner::Examiner(const Model& model, const ClinicalTests& tests, const ExamSubject& subject, const Job& job)
    : model_{model}, tests_{tests}, subject_{subject} {
  if (!(subject.mass_kg > 0)) throw InputError{{"exam", "mass_kg", "a number > 0", std::to_string(subject.mass_kg)}};
  const auto form = tests.form();
  for (const char side : {'r', 'l'}) {
    auto& sweeps = side == 'r' ? right_ : left_;
    for (const ClinicalTest* test : form) {
      if (job.cancelled()) return;
      job.report((side == 'r' ? 0 : 0.5) + 0.5 * double(sweeps.size()) / double(form.size()),
                 "simulating " + test->title + (side == 'r' ? ", right" : ", left"));
      sweeps.emplace_back(model, *test, side);
    }
  }
}

ExamFit Examiner::fit(const PhysicalExam& exam, const Job& job, bool with_intervals) const {
  ExamFit result{.left_in_norm = exam.leave_in_norm};
  result.warnings = checkExam(exam, tests_);
  if (job.cancelled()) return {.outcome = Outcome::Cancelled};
  int sides = 0, unsolved = 0;
  for (const char side : {'r', 'l'}) {
    job.report(side == 'r' ? 0 : 0.5, side == 'r' ? "solving muscle lengths, right" : "solving muscle lengths, left");
    const Side s = sideOf(model_, exam, tests_, subject_, side, side == 'r' ? right_ : left_);
    const SideFit fit = solve(s, exam.leave_in_norm, tests_.length_sd_m, with_intervals, job);
    if (job.cancelled() || fit.outcome == Outcome::Cancelled) return {.outcome = Outcome::Cancelled};
    sides += !s.measured.empty();
    if (!s.measured.empty() && fit.factors.empty()) {
      ++unsolved;
      result.warnings.push_back({"exam_side_not_solved", std::string{side == 'r' ? "right" : "left"} +
                                                             ": no lengths were found; this side keeps its own"});
    } else if (fit.outcome != Outcome::Converged) {
      result.warnings.push_back({"exam_not_converged", std::string{side == 'r' ? "right" : "left"} +
                                                           ": the solver ran out of iterations; the best lengths "
                                                           "until then were kept"});
    }
    addGroups(tests_, s, fit, result);
    addLines(tests_, s, fit, result);
  }
  // One side that fails does not throw the other away.
  result.outcome = unsolved > 0 && unsolved == sides ? Outcome::NotConverged : Outcome::Converged;
  return result;
}

ExamFit applyExam(const Model& model, const PhysicalExam& exam, const ClinicalTests& tests,
                  const ExamSubject& subject, const Job& job) {
  const auto start = std::chrono::steady_clock::now();
  const auto share = [&](double from, double to) {
    return Job{[&job, from, to](double done, std::string_view what) { job.report(std::lerp(from, to, done), what); },
               job.stop};
  };
  checkExam(exam, tests);  // before anything is simulated
  const Examiner examiner{model, tests, subject, share(0, 0.5)};
  ExamFit result = examiner.fit(exam, share(0.5, 1));
  if (result.outcome == Outcome::Cancelled) return result;
  job.report(1, "examination met by muscle lengths");
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace sinew
