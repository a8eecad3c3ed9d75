#include <gmock/gmock.h>

#include <cctype>
#include <cmath>
#include <functional>
#include <map>

#include "core/foreign/foreign_evaluate.h"
#include "core/foreign/foreign_from_model.h"
#include "core/foreign/structure_deviation.h"
#include "core/io/foreign/foreign_json.h"
#include "core/io/osim/osim_forces_internal.h"
#include "core/io/osim/osim_reader.h"
#include "core/io/osim/osim_writer.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/osim_text.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

/// What OpenSim's expression reader (Lepton) makes of a text: + - * with their precedence, a minus in front, numbers,
/// q, exp, min, max. Written for this test alone, so that the text is judged and not our own reader.
class Expression {
 public:
  Expression(std::string text, double q) : text_{std::move(text)}, q_{q} {}
  double value() {
    const double result = sum();
    EXPECT_EQ(at_, text_.size()) << text_.substr(at_);
    return result;
  }

 private:
  bool take(char c) { return at_ < text_.size() && text_[at_] == c && ++at_; }
  double sum() {
    double result = product();
    while (true) {
      if (take('+'))
        result += product();
      else if (take('-'))
        result -= product();
      else
        return result;
    }
  }
  double product() {
    double result = factor();
    while (take('*')) result *= factor();
    return result;
  }
  double factor() {
    if (take('-')) return -factor();
    if (take('(')) {
      const double inside = sum();
      EXPECT_TRUE(take(')'));
      return inside;
    }
    if (std::isdigit(static_cast<unsigned char>(text_[at_]))) {
      std::size_t length = 0;
      const double number = std::stod(text_.substr(at_), &length);
      at_ += length;
      return number;
    }
    std::string word;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) word += text_[at_++];
    if (word == "q") return q_;
    EXPECT_TRUE(take('(')) << word;
    const double first = sum();
    const double second = take(',') ? sum() : 0;
    EXPECT_TRUE(take(')'));
    if (word == "exp") return std::exp(first);
    if (word == "min") return std::min(first, second);
    EXPECT_EQ(word, "max");
    return std::max(first, second);
  }

  const std::string text_;
  const double q_;
  std::size_t at_ = 0;
};

TEST(OsimForces, TheExpressionIsTheMoment) {
  PassiveMoment upper_only{20, 38.11, 0.52, 0, 1, 0}, lower_only{0, 1, 0, 5, 33.94, 0};
  std::vector<PassiveMoment> all{{50, 5.05, 2.007, 50, 21.88, -0.2094}, upper_only, lower_only};
  for (const PassiveMoment& m : reference().passive_moments)
    if (m.upper_Nm > 0) all.push_back(m);
  for (const PassiveMoment& m : all) {
    const std::string text = osim::expressionOf(m);
    for (double q = -3; q <= 3; q += 0.0471) {
      const double ours = passiveMoment_Nm(m, q);
      EXPECT_NEAR(Expression(text, q).value(), ours, 1e-9 * (1 + std::abs(ours))) << text << " at " << q;
    }
    EXPECT_EQ(osim::passiveMomentOf(text), m) << text;
  }
}

TEST(OsimForces, OtherExpressionsAreNotTakenForOurs) {
  const std::string good = osim::expressionOf({50, 5.05, 2, 50, 21.88, -0.2});
  EXPECT_TRUE(osim::passiveMomentOf(" " + good + "\n"));
  for (const std::string text : {"", "0", "-50*q", "-0.1*qdot", "50*exp(q)"})
    EXPECT_FALSE(osim::passiveMomentOf(text));
  EXPECT_FALSE(osim::passiveMomentOf(good + "-0.1*qdot"));
  EXPECT_FALSE(osim::passiveMomentOf(good.substr(0, good.size() - 1)));
}

TEST(OsimForces, TheStructuresSurviveTheFile) {
  const ForeignModel exported = foreignFromModel(reference());
  const ForeignModel back = osimFromText(osimText(exported), "export.osim");
  EXPECT_TRUE(back.warnings.empty()) << back.warnings.front().message;
  ASSERT_EQ(back.coordinate_forces.size(), 44u);
  EXPECT_TRUE(structureDeviation(reference(), back).isExact());
  EXPECT_EQ(summaryText(structureDeviation(reference(), back)), "capsules and ligaments exactly");
  // Posture for posture the same torque as ours.
  const Skeleton& s = reference().skeleton;
  const Posture q = postureFromDegrees(s, {{"hip_flexion_r", 110}, {"knee_flexion_r", 140}, {"wrist_flexion_l", 70}});
  const Eigen::VectorXd ours =
      evaluatePosture(s, reference().musculature, q, reference().passive_moments).structure_torque;
  ForeignPosture theirs = defaultPosture(back);
  const Eigen::VectorXd clinical = clinicalFromPosture(s, q);
  for (int i = 0; i < clinical.size(); ++i)
    theirs[back.coordinateIndex(s.coordinates[std::size_t(i)].name)] = clinical[i];
  const PostureEvaluation e = evaluatePosture(back, theirs);
  EXPECT_LT(ours[s.coordinateIndex("knee_flexion_r")], -14);  // 4 deg before its end of 33 N m
  for (const Coordinate& c : s.coordinates)
    EXPECT_NEAR(e.structure_torque[back.coordinateIndex(c.name)], ours[s.coordinateIndex(c.name)], 1e-9) << c.name;
}

TEST(OsimForces, AModelWithoutStructuresHasNone) {
  Model model = reference();
  model.passive_moments.clear();
  EXPECT_TRUE(foreignFromModel(model).coordinate_forces.empty());
  EXPECT_EQ(osimText(foreignFromModel(model)).find("ExpressionBased"), std::string::npos);
}

/// OpenSim's own limit, by hand: beyond the limit the stiffness rises over the transition and then stays.
TEST(OsimForces, ACoordinateLimitForceIsReadAsWhatItIs) {
  ForeignModel model = foreignFromModel(reference());
  const int knee = model.coordinateIndex("knee_flexion_r");
  constexpr double kDeg = 3.14159265358979323846 / 180;
  model.coordinate_forces = {
      {"knee_limit", knee, CoordinateLimit{120 * kDeg, 2 / kDeg, 5 * kDeg, 3 / kDeg, 10 * kDeg}}};
  const std::string text = osimText(model);
  EXPECT_NE(text.find("<upper_stiffness>2</upper_stiffness>"), std::string::npos);  // N m per degree
  EXPECT_NE(text.find("<transition>10</transition>"), std::string::npos);
  const ForeignModel back = osimFromText(text, "limit.osim");
  EXPECT_TRUE(back.warnings.empty());
  ASSERT_EQ(back.coordinate_forces.size(), 1u);
  const ForeignCoordinateForce& force = back.coordinate_forces[0];
  EXPECT_EQ(force.coordinate, back.coordinateIndex("knee_flexion_r"));
  EXPECT_NEAR(coordinateForce(force, 60 * kDeg), 0, 1e-12);
  EXPECT_NEAR(coordinateForce(force, 135 * kDeg), -2 * 15, 1e-9);       // beyond the transition
  EXPECT_NEAR(coordinateForce(force, 125 * kDeg), -2 * 0.5 * 5, 1e-9);  // in its middle half of the stiffness
  EXPECT_NEAR(coordinateForce(force, -10 * kDeg), 3 * 15, 1e-9);
  // And through our own file.
  const Json json = foreignModelToJson(back);
  const ForeignModel stored = foreignModelFromJson(JsonReader{json, "stored"});
  ASSERT_EQ(stored.coordinate_forces.size(), 1u);
  EXPECT_EQ(std::get<CoordinateLimit>(stored.coordinate_forces[0].law), std::get<CoordinateLimit>(force.law));
}

TEST(OsimForces, OtherExpressionsAreNamed) {
  ForeignModel model = foreignFromModel(reference());
  model.coordinate_forces.resize(1);
  std::string text = osimText(model);
  const auto begin = text.find("<expression>") + 12, end = text.find("</expression>");
  text.replace(begin, end - begin, "-5*q");
  const ForeignModel back = osimFromText(text, "other.osim");
  EXPECT_TRUE(back.coordinate_forces.empty());
  ASSERT_EQ(back.warnings.size(), 1u);
  EXPECT_THAT(back.warnings[0].message, testing::HasSubstr("ExpressionBasedCoordinateForce"));
}

}  // namespace
}  // namespace sinew
