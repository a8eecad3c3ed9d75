#include "core/skeleton/shape/body_description.h"

#include <gmock/gmock.h>

#include <numbers>

#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/shape/shape_json.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;
using testing::UnorderedElementsAre;

constexpr double kDeg = std::numbers::pi / 180;

BodyDescription read(const std::string& text) {
  const Json json = parseJson(text, "shape.json");
  return bodyFromJson(JsonReader{json, "shape.json"});
}

std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(BodyDescription, EmptyFileIsTheReference) {
  BodyDescription reference;
  reference.name.clear();
  EXPECT_EQ(read("{}"), reference);
  EXPECT_EQ(read(R"({"format": "sinew.shape", "version": 1, "trunk": {}})"), reference);
}

TEST(BodyDescription, BothSidesAreSaidAtOnceAndOneSideWins) {
  // Both orders: what is said of one side holds whether it comes first or last.
  for (const char* text : {R"({"femur": {"elongation": 1.2, "torsion_deg": 30}, "femur_l": {"elongation": 0.9}})",
                           R"({"femur_l": {"elongation": 0.9}, "femur": {"elongation": 1.2, "torsion_deg": 30}})"}) {
    const ShapeParameters shape = read(text).shape;
    EXPECT_EQ(shape.sides[0].femur.elongation, 1.2);
    EXPECT_EQ(shape.sides[1].femur.elongation, 0.9);
    EXPECT_NEAR(shape.sides[0].femur.torsion_rad, 30 * kDeg, 1e-15);
    EXPECT_NEAR(shape.sides[1].femur.torsion_rad, 30 * kDeg, 1e-15);
  }
}

TEST(BodyDescription, FlatAndNestedFieldsAreTheSame) {
  const auto flat =
      read(R"({"femur_r.elongation": 1.2, "trunk.bend_deg": -5, "foot.scale": 0.8, "trunk.mass": 1.1})");
  const auto nested =
      read(R"({"femur_r": {"elongation": 1.2}, "trunk": {"bend_deg": -5, "mass": 1.1}, "foot": {"scale": 0.8}})");
  EXPECT_EQ(flat, nested);
  EXPECT_EQ(flat.shape.sides[0].femur.elongation, 1.2);
  EXPECT_EQ(flat.shape.sides[1].femur.elongation, 1);
  EXPECT_EQ(flat.shape.sides[1].foot_scale, 0.8);
}

TEST(BodyDescription, ReadsEveryParameterInItsOwnUnit) {
  for (const auto& parameter : shapeParameterNames()) {
    const auto reference = toVector(ShapeParameters{});
    const std::size_t i =
        std::size_t(std::ranges::find(shapeParameterNames(), parameter) - shapeParameterNames().begin());
    const auto given = [&](const std::string& unit, const std::string& number) {
      return toVector(read("{\"" + parameter + unit + "\": " + number + "}").shape)[i];
    };
    switch (shapeUnit(parameter)) {
      case ShapeUnit::Ratio:
        EXPECT_EQ(reference[i], 1) << parameter;
        EXPECT_EQ(given("", "1.25"), 1.25) << parameter;
        break;
      case ShapeUnit::Angle:
        EXPECT_EQ(reference[i], 0) << parameter;
        EXPECT_NEAR(given("_deg", "10"), 10 * kDeg, 1e-15) << parameter;
        EXPECT_EQ(given("_rad", "0.1"), 0.1) << parameter;
        break;
      case ShapeUnit::Length:
        EXPECT_EQ(reference[i], 0) << parameter;
        EXPECT_NEAR(given("_mm", "12"), 0.012, 1e-15) << parameter;
        EXPECT_EQ(given("_m", "0.012"), 0.012) << parameter;
        break;
    }
  }
}

TEST(BodyDescription, MassesOfTheTrunkAndOfOneSegment) {
  const PhysicsFactors physics =
      read(R"({"femur_r.mass": 3, "femur": {"mass": 2.5}, "trunk": {"mass_ratio": 2}, "thorax.mass": 1.5,
               "strength": {"quadriceps": 0.8}})")
          .physics;
  EXPECT_THAT(physics.mass_factors,
              UnorderedElementsAre(Pair("femur_r", 3), Pair("femur_l", 2.5), Pair("thorax", 1.5)));
  EXPECT_THAT(physics.mass_ratios,
              UnorderedElementsAre(Pair("lumbar", 2), Pair("scapula_r", 2), Pair("scapula_l", 2)));
  EXPECT_THAT(physics.strength_factors, UnorderedElementsAre(Pair("quadriceps", 0.8)));
}

TEST(BodyDescription, SavedAndLoadedIsTheSame) {
  const test::TemporaryFolder folder;
  BodyDescription body = read(R"({
    "name": "test", "about": "for a test", "age_years": 9, "pelvis.width": 1.1, "trunk": {"elongation": 0.9, "bend_deg": 12, "mass": 1.2},
    "femur": {"elongation": 1.3, "neck_shaft_deg": 5}, "tibia_r": {"torsion_deg": 7}, "tibia_l": {"torsion_deg": -7, "varus_deg": 12},
    "hip_l": {"lateral_mm": 15, "superior_mm": 8}, "femur_r.neck_length_mm": -12, "femur_l.bow_sagittal_deg": 9,
    "hand_l.scale": 0.7, "ulna": {"mass_ratio": 1.4}, "humerus_l.mass": 0.6,
    "strength": {"quadriceps": 0.8, "soleus_medial_r": 1.5}, "sources": {"femur.elongation": "a guess"}})");
  saveBodyDescription(body, folder.path() / "body.json");
  const BodyDescription back = loadBodyDescription(folder.path() / "body.json");
  const auto a = toVector(body.shape), b = toVector(back.shape);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-15) << shapeParameterNames()[i];
  body.shape = back.shape;  // degrees cost the last bit
  EXPECT_EQ(body, back);
}

TEST(BodyDescription, WrongNamesAreAnsweredWithTheNearest) {
  EXPECT_THAT(complaint(R"({"femr": {"elongation": 1}})"), AllOf(HasSubstr("'femr'"), HasSubstr("femur")));
  EXPECT_THAT(complaint(R"({"femur": {"elongaton": 1}})"),
              AllOf(HasSubstr("'femur.elongaton'"), HasSubstr("nearest: femur.elongation")));
  EXPECT_THAT(complaint(R"({"femur.torsion": 10})"), HasSubstr("femur.torsion_deg"));  // an angle without a unit
  EXPECT_THAT(complaint(R"({"humerus.varus_deg": 1})"), HasSubstr("expected a field of a body"));
  EXPECT_THAT(complaint(R"({"hip_r.lateral": 10})"), HasSubstr("hip_r.lateral_mm"));  // a length without a unit
  EXPECT_THAT(complaint(R"({"hip_r.lateral_deg": 10})"), HasSubstr("hip_r.lateral_mm"));
  EXPECT_THAT(complaint(R"({"patella.mass": 1})"), HasSubstr("expected a field of a body"));
  EXPECT_THAT(complaint(R"({"sources": {"femrus": "x"}})"), HasSubstr("femur"));
}

TEST(BodyDescription, ValuesOutsideTheirBoundsAreRefused) {
  EXPECT_EQ(complaint(R"({"femur_r": {"elongation": 5}})"),
            "shape.json: femur_r.elongation: expected a number 0.2 ... 4, found 5");
  EXPECT_EQ(complaint(R"({"femur": {"torsion_deg": -100}})"),
            "shape.json: femur.torsion_deg: expected a number -90 ... 90, found -100");
  for (const char* text :
       {R"({"femur.elongation": 0})", R"({"femur.elongation": -1})", R"({"femur.elongation": "long"})",
        R"({"femur.elongation": null})", R"({"femur": 1.2})", R"({"femur.mass": 0})",
        R"({"strength": {"soleus": -1}})", R"({"format": "sinew.model", "version": 1})",
        R"({"format": "sinew.shape", "version": 2})", "[]"})
    EXPECT_THAT(complaint(text), AllOf(HasSubstr("shape.json"), HasSubstr("expected"))) << text;
}

TEST(BodyDescription, TheSameThingTwiceIsRefused) {
  EXPECT_THAT(complaint(R"({"femur_r": {"elongation": 1}, "femur_r.elongation": 2})"), HasSubstr("a second one"));
  EXPECT_THAT(complaint(R"({"femur": {"torsion_deg": 1, "torsion_rad": 0.1}})"), HasSubstr("a second one"));
  EXPECT_THAT(complaint(R"({"femur": {"mass": 1, "mass_ratio": 2}})"), HasSubstr("a second one"));
}

TEST(ShapeJson, OlderFilesWithoutTheBendsOfTheLegsStillLoadAndMeanNone) {
  ShapeParameters shape;
  shape.sides[0].femur.varus_rad = 0.2;
  shape.sides[1].tibia.elongation = 0.9;
  Json json = shapeToJson(shape);
  for (const std::string side : {"r", "l"})
    for (const char* later : {"femur.procurvatum_rad", "femur.neck_length_m", "femur.neck_varus_rad",
                              "femur.neck_retroversion_rad", "femur.bow_frontal_rad", "femur.bow_sagittal_rad",
                              "tibia.varus_rad", "tibia.procurvatum_rad", "tibia.distal_varus_rad",
                              "tibia.distal_procurvatum_rad", "hip.lateral_m", "hip.superior_m", "hip.anterior_m"}) {
      std::string name = later;
      name.insert(name.find('.'), "_" + side);
      ASSERT_EQ(json.erase(name), 1u) << name;
    }
  EXPECT_EQ(json.size(), 48u);  // what the first files had
  EXPECT_EQ(shapeFromJson(JsonReader{json, "old.json"}), shape);
  json.erase("femur_r.varus_rad");
  EXPECT_THROW(shapeFromJson(JsonReader{json, "old.json"}), InputError);
}

TEST(ShapePresets, AreThePapersTable) {
  struct Row {
    const char* name;
    double trunk[3], femur[3], tibia[3], humerus[3], ulna[3], neck[2];  // elongation, expansion or torsion, mass
  };
  constexpr Row rows[] = {
      {"alien", {1, 1, 1}, {2.5, 0, 2.5}, {2.5, 0, 2.5}, {2.5, -10, 2.5}, {2.5, 10, 2.5}, {2, 2}},
      {"hulk", {1, 2, 1}, {0.8, 10, 0.8}, {0.8, 10, 0.8}, {1.8, 10, 1.8}, {1.4, 0, 1.4}, {1, 1}},
      {"dwarf", {2, 0.6, 2}, {0.6, -10, 0.6}, {0.6, 10, 0.6}, {0.6, 0, 0.6}, {0.6, 0, 0.6}, {1, 1}}};
  for (const Row& row : rows) {
    const BodyDescription body = loadShapePreset(test::resourceDir(), row.name);
    EXPECT_EQ(body.name, row.name);
    EXPECT_EQ(body.shape.trunk_elongation, row.trunk[0]);
    EXPECT_EQ(body.shape.trunk_expansion, row.trunk[1]);
    EXPECT_EQ(body.physics.mass_ratios.at("lumbar"), row.trunk[2]);
    EXPECT_EQ(body.physics.mass_ratios.at("thorax"), row.trunk[2]);
    EXPECT_EQ(body.shape.neck_elongation, row.neck[0]);
    EXPECT_EQ(body.physics.mass_ratios.at("neck"), row.neck[1]);
    for (int side = 0; side < 2; ++side) {
      const SideShape& s = body.shape.sides[std::size_t(side)];
      const auto expectBone = [&](const std::string& bone, const LimbBoneShape& found, const double(&expected)[3]) {
        LimbBoneShape wanted;
        wanted.elongation = expected[0];
        wanted.torsion_rad = expected[1] * kDeg;
        EXPECT_EQ(found, wanted) << row.name << " " << bone;
        EXPECT_EQ(body.physics.mass_ratios.at(bone + (side == 0 ? "_r" : "_l")), expected[2])
            << row.name << " " << bone;
      };
      expectBone("femur", s.femur, row.femur);
      expectBone("tibia", s.tibia, row.tibia);
      expectBone("humerus", s.humerus, row.humerus);
      expectBone("ulna", s.ulna, row.ulna);
    }
  }
  EXPECT_EQ(loadShapePreset(test::resourceDir(), "human").shape, ShapeParameters{});
  EXPECT_THAT(loadShapePreset(test::resourceDir(), "human").physics.mass_ratios, IsEmpty());
}

TEST(ShapePresets, EachHasSourcesAndAnUnknownNameIsAnsweredWithTheNearest) {
  for (const auto& name : shapePresetNames()) {
    EXPECT_FALSE(loadShapePreset(test::resourceDir(), name).sources.empty()) << name;
    EXPECT_EQ(loadBody(name, test::resourceDir()), loadShapePreset(test::resourceDir(), name));
  }
  for (const auto& load : {loadShapePreset(test::resourceDir(), "child")}) {
    EXPECT_LT(load.shape.sides[0].femur.torsion_rad,
              0);  // more anteversion: the knee turned inwards against the neck
    EXPECT_GT(load.shape.sides[0].femur.neck_shaft_rad, 0);
    EXPECT_GT(load.shape.head_scale, load.shape.trunk_elongation);
  }
  EXPECT_EQ(loadShapePreset(test::resourceDir(), "child").physics.age_years, 7);
  EXPECT_THAT([] { loadBody("alein", test::resourceDir()); },
              testing::ThrowsMessage<InputError>(AllOf(HasSubstr("'alein'"), HasSubstr("alien"))));
}

}  // namespace
}  // namespace sinew
