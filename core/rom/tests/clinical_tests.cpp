#include "core/rom/tests/clinical_tests.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/model/rom_preset.h"
#include "core/rom/tests/threshold.h"
#include "core/skeleton/clinical_angles.h"
#include "core/text.h"

namespace sinew {

double TestNorm::outside_deg(double angle_deg) const {
  return std::max({0.0, accept_min_deg - angle_deg, angle_deg - accept_max_deg});
}

std::map<std::string, double> ClinicalTest::sidedPosture(const Skeleton& skeleton, char side) const {
  std::map<std::string, double> sided;
  const auto put = [&](const std::string& name, char s, double value) {
    sided[skeleton.coordinates[std::size_t(sidedCoordinate(skeleton, name, s))].name] = value;
  };
  for (const auto& [name, value] : contralateral_deg) put(name, side == 'r' ? 'l' : 'r', value);
  for (const auto& [name, value] : posture_deg) put(name, side, value);
  for (const auto& [name, share] : moves) put(name, side, share * from_deg);
  return sided;
}

Posture ClinicalTest::posture(const Skeleton& skeleton, char side) const {
  return postureFromDegrees(skeleton, sidedPosture(skeleton, side));
}

const ClinicalTest& ClinicalTests::test(std::string_view id) const {
  std::vector<std::string> known;
  for (const auto& t : tests) {
    if (t.id == id || std::ranges::count(t.aliases, id) > 0) return t;
    known.push_back(t.id);
  }
  throw InputError{
      {"clinical_tests.json", "test", "a known test", "'" + std::string{id} + "'" + didYouMean(id, known)}};
}

const LengthGroup& ClinicalTests::group(std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& g : groups) {
    if (g.name == name) return g;
    known.push_back(g.name);
  }
  throw InputError{{"clinical_tests.json", "group", "a known muscle group",
                    "'" + std::string{name} + "'" + didYouMean(name, known)}};
}

std::vector<const ClinicalTest*> ClinicalTests::form() const {
  std::vector<const ClinicalTest*> rows;
  for (const auto& test : tests)
    if (test.form) rows.push_back(&test);
  return rows;
}

TestNorm normOf(const ClinicalTest& test, const NormGroup& who) {
  // The youngest adult: tests that have an entry for adults only there (no preset's) are found without an age too.
  constexpr double kAdult_y = 18;
  const double age_y = who.age_y.value_or(kAdult_y);
  for (const AgeNorm& n : test.norms_by_age)
    if (age_y >= n.from_y && age_y < n.to_y && (n.sex.empty() || n.sex == who.sex)) {
      if (!who.age_y && n.to_y <= 25) continue;  // adolescents: not meant without an age
      return n.norm;
    }
  const auto found = test.norms.find(who.preset);
  if (found == test.norms.end()) return {};
  TestNorm norm = found->second;
  if (who.age_y && age_y < kAdult_y) norm.source = "adults, none for the age: " + norm.source;
  return norm;
}

std::vector<double> examinerMoments_Nm(const ClinicalTests& tests, const Skeleton& skeleton, double mass_kg) {
  std::vector<double> by_coordinate(skeleton.coordinates.size(), std::numeric_limits<double>::infinity());
  for (const ClinicalTest& test : tests.tests) {
    if (test.moves.size() != 1) continue;
    for (const char side : {'r', 'l'}) {
      double& moment_Nm = by_coordinate[std::size_t(sidedCoordinate(skeleton, test.moves.begin()->first, side))];
      if (std::isinf(moment_Nm)) moment_Nm = scaledThreshold_Nm(test, mass_kg);
    }
  }
  return by_coordinate;
}

}  // namespace sinew
