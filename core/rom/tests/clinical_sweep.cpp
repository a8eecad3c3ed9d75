#include "core/rom/tests/clinical_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/error.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/muscle_role.h"
#include "core/rom/tests/movement_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kStep_deg = 3;    // cubic between samples with slopes: path lengths good to some nm
constexpr double kStride_deg = 4;  // in which the first place that holds is looked for
constexpr double kGrid_deg = 1;    // of moments with unchanged lengths: a fibre's force grows e-fold in some 15 deg
constexpr double kNearLongest = 0.9;  // of the longest length: below, a unit cannot be beyond it
constexpr double kLengthGain =
    20;  // excess of a unit that is 5 % beyond its longest length: 1, as at twice the moment

struct SweptUnit {
  int index;
  MusculotendonUnit unit;                                  ///< without path and names: copied for other lengths
  std::vector<double> length_m;                            ///< by sample
  std::vector<double> slope_begin_m_deg, slope_end_m_deg;  ///< at both ends of every interval: kinks where one halts
  std::vector<double> moment_Nm;  ///< with unchanged length, on a grid of its own; empty: asked every time
  bool nears_longest = false;     ///< with unchanged length, somewhere in the table
};

/// Where a place lies among the samples.
struct Place {
  std::size_t interval;
  double t, h_deg;  ///< share of the interval, its length
};

MusculotendonUnit scaled(const MusculotendonUnit& unit, const LengthFactor& f) {
  MusculotendonUnit u = unit;
  u.optimal_fiber_length_m *= f.fiber;
  u.tendon_slack_length_m *= f.tendon;
  return u;
}

}  // namespace

struct ClinicalSweep::Table {
  Table(const Model& model, const ClinicalTest& test, char side, double beyond_deg);

  Place place(double s) const;
  std::pair<double, double> lengthAndSlope(const SweptUnit& u, const Place& p) const;
  double momentOf_Nm(const SweptUnit& u, const MusculotendonUnit& unit, const Place& p) const;
  double structures_Nm(double s) const;
  void fillGrid();
  double onGrid(const std::vector<double>& values, double s) const;
  double excess(double s, double threshold_Nm, const LengthFactors& factors) const;
  double root(double free, double held, double threshold_Nm, const LengthFactors& factors) const;
  void addSample(const Model& model, double s, const std::vector<double>& all);

  ClinicalTest test;
  Movement movement;
  PassiveMoments passive_moments;
  std::vector<std::string> unit_names, stops;  ///< of all units; of the coordinates at their stops at the end
  std::vector<double> s_deg;                   ///< of the samples, rising
  std::vector<SweptUnit> units;
  std::vector<double> total_Nm;  ///< of all units with unchanged lengths, on that grid
};

ClinicalSweep::Table::Table(const Model& model, const ClinicalTest& tested, char side, double beyond_deg)
    : test{tested}, movement{model.skeleton, tested, side}, passive_moments{model.passive_moments} {
  const double end = movement.end_deg(), from = movement.from_deg();
  const double low = std::min(from, end) - beyond_deg, high = std::max(from, end) + beyond_deg;
  std::vector<double> marks{low, from, end, high};
  for (const Movement::Moved& m : movement.moved()) {
    const double halt = m.stop_rad * kDegPerRad / m.share;
    if (halt > low && halt < high) marks.push_back(halt);
  }
  std::ranges::sort(marks);
  s_deg.push_back(low);
  for (std::size_t i = 1; i < marks.size(); ++i) {
    const double width = marks[i] - marks[i - 1];
    if (width < 1e-9) continue;
    const int count = std::max(1, int(std::ceil(width / kStep_deg)));
    for (int k = 1; k <= count; ++k) s_deg.push_back(k == count ? marks[i] : marks[i - 1] + k * width / count);
  }
  for (const auto& unit : model.musculature.units) unit_names.push_back(unit.name);
  stops = movement.stopped(model.skeleton, end);

  const Kinematics start =
      clinicalKinematics(model.skeleton, postureFromClinical(model.skeleton, movement.clinical(from)));
  for (int u = 0; u < int(model.musculature.units.size()); ++u) {
    const MusculotendonUnit& unit = model.musculature.units[std::size_t(u)];
    const auto spanned = spannedCoordinates(unit, start);
    if (std::ranges::none_of(movement.moved(),
                             [&](const Movement::Moved& m) { return std::ranges::count(spanned, m.coordinate) > 0; }))
      continue;
    MusculotendonUnit bare = unit;
    bare.path.clear();
    bare.name.clear(), bare.group.clear(), bare.source.clear();
    units.push_back({u, std::move(bare), {}, {}, {}});
  }
  for (const double s : s_deg) addSample(model, s, s_deg);
  if (movement.moved().size() == 1) fillGrid();  // of several the moments jump where one halts
}

/// Moments with unchanged lengths: what a solver that changes a few units does not compute again.
void ClinicalSweep::Table::fillGrid() {
  const auto count = std::size_t(std::ceil((s_deg.back() - s_deg.front()) / kGrid_deg)) + 1;
  total_Nm.assign(count, 0);
  for (SweptUnit& u : units) {
    const double longest_m = longestLength_m(u.unit);
    for (const double length_m : u.length_m) u.nears_longest = u.nears_longest || length_m > kNearLongest * longest_m;
    for (std::size_t i = 0; i < count; ++i) {
      const double s = std::min(s_deg.front() + double(i) * kGrid_deg, s_deg.back());
      u.moment_Nm.push_back(momentOf_Nm(u, u.unit, place(s)));
      total_Nm[i] += u.moment_Nm.back();
    }
  }
}

/// Cubic through four neighbours (Catmull & Rom 1974).
double ClinicalSweep::Table::onGrid(const std::vector<double>& v, double s) const {
  const double x = std::clamp((s - s_deg.front()) / kGrid_deg, 0.0, double(v.size() - 1));
  const auto i = std::min(std::size_t(x), v.size() - 2);
  const double t = x - double(i), b = v[i], c = v[i + 1];
  const double a = i > 0 ? v[i - 1] : 2 * b - c, d = i + 2 < v.size() ? v[i + 2] : 2 * c - b;
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// Lengths at one sample, and their slopes on both of its sides: other coordinates may move there.
void ClinicalSweep::Table::addSample(const Model& model, double s, const std::vector<double>& all) {
  constexpr double kAside_deg = 1e-6;
  const Kinematics k = clinicalKinematics(model.skeleton, postureFromClinical(model.skeleton, movement.clinical(s)));
  for (SweptUnit& u : units) {
    const MusculotendonUnit& unit = model.musculature.units[std::size_t(u.index)];
    u.length_m.push_back(pathLength(unit, k.X_WB));
    const Eigen::VectorXd gradient = lengthGradient(unit, k);
    const auto slope = [&](double at) {
      double sum = 0;
      for (const Movement::Moved& m : movement.moved())
        if (movement.moves(m, at)) sum += m.share * gradient[m.coordinate];
      return sum * kRadPerDeg;
    };
    // `moves` looks along the movement; aside of the sample it is clear which coordinates do.
    if (s > all.front()) u.slope_end_m_deg.push_back(slope(s - kAside_deg));
    if (s < all.back()) u.slope_begin_m_deg.push_back(slope(s + kAside_deg));
  }
}

Place ClinicalSweep::Table::place(double s) const {
  const auto above = std::upper_bound(s_deg.begin() + 1, s_deg.end() - 1, s);
  const auto i = std::size_t(above - s_deg.begin()) - 1;
  const double h = s_deg[i + 1] - s_deg[i];
  return {i, (s - s_deg[i]) / h, h};
}

/// Cubic with the lengths and slopes of both ends of the interval; slope in m/deg.
std::pair<double, double> ClinicalSweep::Table::lengthAndSlope(const SweptUnit& u, const Place& p) const {
  const double a = u.length_m[p.interval], b = u.length_m[p.interval + 1], t = std::clamp(p.t, 0.0, 1.0);
  const double m0 = p.h_deg * u.slope_begin_m_deg[p.interval], m1 = p.h_deg * u.slope_end_m_deg[p.interval];
  const double c2 = 3 * (b - a) - 2 * m0 - m1, c3 = m0 + m1 - 2 * (b - a);
  return {a + t * (m0 + t * (c2 + t * c3)), (m0 + t * (2 * c2 + t * 3 * c3)) / p.h_deg};
}

double ClinicalSweep::Table::momentOf_Nm(const SweptUnit& u, const MusculotendonUnit& unit, const Place& p) const {
  const auto [length_m, slope_m_deg] = lengthAndSlope(u, p);
  return movement.direction() * slope_m_deg * kDegPerRad * equilibrium(unit, length_m, 0).force_N;
}

double ClinicalSweep::Table::structures_Nm(double s) const {
  if (passive_moments.empty()) return 0;
  double sum = 0;
  for (const Movement::Moved& m : movement.moved())
    if (movement.moves(m, s))
      sum -= movement.direction() * m.share *
             passiveMoment_Nm(passive_moments[std::size_t(m.coordinate)], movement.value_rad(m, s));
  return sum;
}

double ClinicalSweep::Table::excess(double s, double threshold_Nm, const LengthFactors& factors) const {
  const Place p = place(s);
  double moment_Nm = structures_Nm(s) + (total_Nm.empty() ? 0 : onGrid(total_Nm, s)), longest = -1;
  for (const SweptUnit& u : units) {
    const auto f = factors.find(u.index);
    if (!total_Nm.empty()) {
      if (f == factors.end() && !u.nears_longest) continue;
      moment_Nm -= onGrid(u.moment_Nm, s);  // computed below for its own length
    }
    const auto [length_m, slope_m_deg] = lengthAndSlope(u, p);
    const auto add = [&, length_m = length_m, slope_m_deg = slope_m_deg](const MusculotendonUnit& unit) {
      moment_Nm += movement.direction() * slope_m_deg * kDegPerRad * equilibrium(unit, length_m, 0).force_N;
      longest = std::max(longest, length_m / longestLength_m(unit) - 1);
    };
    f == factors.end() ? add(u.unit) : add(scaled(u.unit, f->second));
  }
  return std::max(moment_Nm / threshold_Nm - 1, kLengthGain * longest);
}

/// Between a place that is free and one that is held: secant steps that keep the bracket (Illinois).
double ClinicalSweep::Table::root(double free, double held, double threshold_Nm, const LengthFactors& factors) const {
  const auto value = [&](double s) { return excess(s, threshold_Nm, factors); };
  double low = value(free), high = value(held);
  int last = 0;
  for (int i = 0; i < 100 && std::abs(held - free) > 1e-6; ++i) {
    double next = free - low * (held - free) / (high - low);
    if (i % 3 == 2 || !std::isfinite(next)) next = 0.5 * (free + held);
    const double at = value(next);
    if (std::abs(at) < 1e-9) return next;
    if (at >= 0) {
      held = next, high = at;
      if (last > 0) low *= 0.5;
      last = 1;
    } else {
      free = next, low = at;
      if (last < 0) high *= 0.5;
      last = -1;
    }
  }
  return held;
}

ClinicalSweep::ClinicalSweep(const Model& model, const ClinicalTest& test, char side, double beyond_deg)
    : table_{std::make_unique<const Table>(model, test, side, beyond_deg)} {}
ClinicalSweep::ClinicalSweep(ClinicalSweep&&) noexcept = default;
ClinicalSweep::~ClinicalSweep() = default;

double ClinicalSweep::direction() const {
  return table_->movement.direction();
}
double ClinicalSweep::from_deg() const {
  return table_->movement.from_deg();
}
double ClinicalSweep::end_deg() const {
  return table_->movement.end_deg();
}
double ClinicalSweep::angle_deg(double s_deg) const {
  return table_->movement.angle_deg(s_deg);
}
double ClinicalSweep::placeOf_deg(double angle_deg) const {
  return table_->movement.placeOf_deg(angle_deg, table_->s_deg.front(), table_->s_deg.back());
}
bool ClinicalSweep::stretches(int unit) const {
  return std::ranges::count(table_->units, unit, &SweptUnit::index) > 0;
}

double ClinicalSweep::resistance_Nm(double s_deg, const LengthFactors& factors) const {
  const Place p = table_->place(s_deg);
  double sum = table_->structures_Nm(s_deg);
  for (const SweptUnit& u : table_->units) {
    const auto f = factors.find(u.index);
    sum += table_->momentOf_Nm(u, f == factors.end() ? u.unit : scaled(u.unit, f->second), p);
  }
  return sum;
}

double ClinicalSweep::structures_Nm(double s_deg) const {
  return table_->structures_Nm(s_deg);
}

std::vector<std::pair<double, int>> ClinicalSweep::moments_Nm(double s_deg,
                                                              const std::vector<MusculotendonUnit>& units) const {
  const Place p = table_->place(s_deg);
  std::vector<std::pair<double, int>> result;
  for (const SweptUnit& u : table_->units)
    if (const double moment_Nm = table_->momentOf_Nm(u, units[std::size_t(u.index)], p); moment_Nm != 0)
      result.emplace_back(moment_Nm, u.index);
  std::ranges::sort(result, std::greater<>{});
  return result;
}

double ClinicalSweep::length_m(int unit, double s_deg) const {
  const auto found = std::ranges::find(table_->units, unit, &SweptUnit::index);
  require(found != table_->units.end(), "ClinicalSweep: a unit that the movement stretches");
  return table_->lengthAndSlope(*found, table_->place(s_deg)).first;
}

double ClinicalSweep::excess(double s_deg, double threshold_Nm, const LengthFactors& factors) const {
  return table_->excess(s_deg, threshold_Nm, factors);
}

double ClinicalSweep::freeEnd_deg(double threshold_Nm, const LengthFactors& factors) const {
  const double direction = table_->movement.direction();
  const double far = direction > 0 ? table_->s_deg.back() : table_->s_deg.front();
  const double near = direction > 0 ? table_->s_deg.front() : table_->s_deg.back();
  const auto held = [&](double s) { return table_->excess(s, threshold_Nm, factors) >= 0; };
  double free = table_->movement.from_deg(), stopped = free;
  // Held at ease by what the movement lets go, an antagonist at its longest: the test begins where it is free.
  const auto eases = [&](double s) {
    return table_->excess(s + direction * kStride_deg, threshold_Nm, factors) <
           table_->excess(s, threshold_Nm, factors);
  };
  while (held(free) && (far - free) * direction > kStride_deg && eases(free)) free += direction * kStride_deg;
  if (!held(free)) {
    stopped = free;
  } else {  // a contracture beyond the position of ease
    free = table_->movement.from_deg();
    do {
      if (free == near) return near;
      stopped = free;
      free -= direction * kStride_deg;
      if ((free - near) * direction < 0) free = near;
    } while (held(free));
    return table_->root(free, stopped, threshold_Nm, factors);
  }
  do {
    if (stopped == far) return far;
    free = stopped;
    stopped += direction * kStride_deg;
    if ((stopped - far) * direction > 0) stopped = far;
  } while (!held(stopped));
  return table_->root(free, stopped, threshold_Nm, factors);
}

double ClinicalSweep::freeEndNear_deg(double near_deg, double threshold_Nm, const LengthFactors& factors) const {
  constexpr double kNear_deg = 1.5;
  const double free = near_deg - table_->movement.direction() * kNear_deg;
  const double held = near_deg + table_->movement.direction() * kNear_deg;
  const bool inside = std::min(free, held) >= table_->s_deg.front() && std::max(free, held) <= table_->s_deg.back();
  if (inside && excess(free, threshold_Nm, factors) < 0 && excess(held, threshold_Nm, factors) >= 0)
    return table_->root(free, held, threshold_Nm, factors);
  return freeEnd_deg(threshold_Nm, factors);
}

SimulatedTest ClinicalSweep::simulate(double threshold_Nm, const LengthFactors& factors) const {
  constexpr double kLeastShare = 0.05;  // of the threshold: less holds nothing
  const Movement& movement = table_->movement;
  SimulatedTest result{.test = table_->test.id};
  double s = freeEnd_deg(threshold_Nm, factors);
  result.stopped_by_joint = (s - movement.end_deg()) * movement.direction() > 0;
  if (result.stopped_by_joint) s = movement.end_deg();
  result.angle_deg = movement.angle_deg(s);
  result.written_deg = table_->test.written_deg(result.angle_deg);

  const double before = result.stopped_by_joint ? s - movement.direction() * 1e-6 : s;  // at the end nothing moves on
  const Place p = table_->place(before);
  result.structures_Nm = table_->structures_Nm(before);
  result.moment_Nm = result.structures_Nm;
  std::vector<std::pair<double, std::string>> shares;
  std::string at_longest;
  for (const SweptUnit& u : table_->units) {
    const auto f = factors.find(u.index);
    const MusculotendonUnit unit = f == factors.end() ? u.unit : scaled(u.unit, f->second);
    const double moment_Nm = table_->momentOf_Nm(u, unit, p);
    result.moment_Nm += moment_Nm;
    const std::string& name = table_->unit_names[std::size_t(u.index)];
    if (moment_Nm > kLeastShare * threshold_Nm) shares.emplace_back(moment_Nm, name);
    if (table_->lengthAndSlope(u, p).first > longestLength_m(unit) * (1 - 1e-7))
      at_longest = name + " (at its longest)";
  }
  std::ranges::stable_sort(shares, std::greater<>{}, &std::pair<double, std::string>::first);
  if (shares.size() > 3) shares.resize(3);
  for (const auto& [moment_Nm, name] : shares) result.limiting_muscles.push_back(name);
  if (result.stopped_by_joint) {
    result.limited_by = table_->stops;
  } else if (result.moment_Nm < 0.99 * threshold_Nm && !at_longest.empty()) {
    result.limited_by = {at_longest};
  } else {
    if (result.structures_Nm > kLeastShare * threshold_Nm)
      shares.emplace_back(result.structures_Nm, "capsule and ligaments");
    std::ranges::stable_sort(shares, std::greater<>{}, &std::pair<double, std::string>::first);
    for (const auto& [moment_Nm, name] : shares) result.limited_by.push_back(name);
  }
  return result;
}

SimulatedTest simulateTest(const Model& model, const ClinicalTest& test, char side, double threshold_Nm) {
  return ClinicalSweep{model, test, side}.simulate(threshold_Nm);
}

std::vector<std::pair<double, double>> passiveMomentCurve(const Model& model, const ClinicalTest& test, char side,
                                                          int samples) {
  const ClinicalSweep sweep{model, test, side, 1};
  std::vector<std::pair<double, double>> curve;
  for (int i = 0; i < samples; ++i) {
    const double s = std::lerp(sweep.from_deg(), sweep.end_deg(), double(i) / (samples - 1));
    curve.emplace_back(test.written_deg(sweep.angle_deg(s)), sweep.resistance_Nm(s));
  }
  return curve;
}

}  // namespace sinew
