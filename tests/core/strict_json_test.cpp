#include "core/strict_json.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

namespace sinew {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string complaintOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(StrictJson, NamesFileAndFieldPathOfAWrongValue) {
  const Json json = parseJson(R"({"views":[{"fx_px":1},{"fx_px":"wide"}]})", "rig.json");
  const JsonReader reader{json, "rig.json"};
  EXPECT_EQ(reader["views"].items()[0]["fx_px"].positive(), 1);
  EXPECT_EQ(complaintOf([&] { reader["views"].items()[1]["fx_px"].positive(); }),
            "rig.json: views[1].fx_px: expected a number > 0, found \"wide\"");
  EXPECT_EQ(complaintOf([&] { reader["views"].items()[0]["fy_px"].number(); }),
            "rig.json: views[0].fy_px: expected a value, found nothing");
}

TEST(StrictJson, AnswersAnUnknownMemberWithTheNearest) {
  const Json json = parseJson(R"({"measured_dge": 4})", "exam.json");
  EXPECT_THAT(complaintOf([&] {
                JsonReader(json, "exam.json").allowOnly({"test", "measured_deg"});
              }),
              AllOf(HasSubstr("'measured_dge'"), HasSubstr("nearest: measured_deg")));
}

TEST(StrictJson, RefusesOtherFormatsAndTheFuture) {
  const Json future = parseJson(R"({"format":"sinew.case","version":2})", "case.json");
  EXPECT_THAT(complaintOf([&] { JsonReader(future, "case.json").expectFormat("sinew.case", 1); }),
              AllOf(HasSubstr("version: expected version 1, found 2"), HasSubstr("newer program")));
  EXPECT_THAT(complaintOf([&] { JsonReader(future, "case.json").expectFormat("sinew.rig", 1); }),
              HasSubstr("format: expected 'sinew.rig'"));
}

TEST(StrictJson, SaysWhereATextIsDamaged) {
  EXPECT_EQ(complaintOf([] { parseJson("{\"a\": 1,\n \"b\": }", "x.json"); }),
            "x.json: line 2, column 7: expected JSON text, found a syntax error (damaged or cut off?)");
  EXPECT_THAT(complaintOf([] { parseJson("", "x.json"); }), HasSubstr("an empty file"));
  EXPECT_THAT(complaintOf([] { parseJson("{\"a\": 1e999}", "x.json"); }), HasSubstr("x.json"));
}

TEST(StrictJson, KeepsAPersonsNameOutOfComplaints) {
  const Json json = parseJson(R"({"patient":{"height_m":"Doe^Jane"}})", "case.json");
  EXPECT_THAT(complaintOf([&] { JsonReader(json, "case.json")["patient"]["height_m"].number(); }),
              Not(HasSubstr("Doe")));
}

TEST(StrictJson, ComplaintsAreOneLine) {
  const Json json = parseJson(R"({"a":"first\nsecond"})", "x.json");
  EXPECT_THAT(complaintOf([&] { JsonReader(json, "x.json")["a"].number(); }), Not(HasSubstr("\n")));
}

TEST(StrictJson, NumbersSurviveBitForBit) {
  for (const double value : {0.1, 1.0 / 3, -0.0, 5e-324, std::numeric_limits<double>::max(), 123456789.0}) {
    const Json back = parseJson(jsonText(Json{{"x", value}}), "text");
    const double read = JsonReader(back, "text")["x"].number();
    EXPECT_EQ(read, value);
    EXPECT_EQ(std::signbit(read), std::signbit(value));
  }
  const Json missing = parseJson(jsonText(Json{{"x", numberOrNull(std::nan(""))}}), "text");
  EXPECT_TRUE(std::isnan(JsonReader(missing, "text")["x"].numberOrNaN()));
}

TEST(StrictJson, LayoutIsReadable) {
  Json json;
  json["format"] = "x";
  json["points"] = {{{"name", "A"}, {"p_m", {1.5, 2.0, 3.0}}}};
  EXPECT_EQ(jsonText(json), R"({
  "format": "x",
  "points": [
    {
      "name": "A",
      "p_m": [1.5, 2.0, 3.0]
    }
  ]
}
)");
}

TEST(StrictJson, TextThatIsNotUtf8IsReplacedNotFatal) {
  EXPECT_EQ(parseJson(jsonText(Json{{"x", "a\xff"}}), "text")["x"], "a\xEF\xBF\xBD");
}

TEST(StrictJson, WholeNumbersKeepTheirBounds) {
  const Json json = parseJson(R"({"a":3,"b":3.5,"c":99999999999999999999})", "x");
  const JsonReader reader{json, "x"};
  EXPECT_EQ(reader["a"].integer(1, 3), 3);
  EXPECT_THROW(reader["a"].integer(1, 2), InputError);
  EXPECT_THROW(reader["b"].integer(1, 9), InputError);
  EXPECT_THROW(reader["c"].integer(1, 9), InputError);
}

}  // namespace
}  // namespace sinew
