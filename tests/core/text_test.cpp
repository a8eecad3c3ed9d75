#include "core/text.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace sinew {
namespace {

using testing::ElementsAre;

TEST(SplitCsvLine, HonoursQuotesAndBlanks) {
  EXPECT_THAT(splitCsvLine(R"(a, b ,"c, ""d""",)"), ElementsAre("a", "b", "c, \"d\"", ""));
  EXPECT_THAT(splitCsvLine(""), ElementsAre(""));
}

TEST(SplitCsvLine, DropsTheByteOrderMarkOfSpreadsheets) {
  EXPECT_THAT(splitCsvLine("\xEF\xBB\xBFname,view"), testing::ElementsAre("name", "view"));
}

TEST(NearestNames, PutsTheTypoFirst) {
  const std::vector<std::string> known{"hip_flexion_r", "knee_flexion_r", "soleus_medial_r"};
  EXPECT_EQ(nearestNames("knee_flexoin_r", known, 1).front(), "knee_flexion_r");
}

TEST(NearestNames, CompletesANameThatWasCutShort) {
  const std::vector<std::string> known{"popliteus_r", "sartorius_r", "soleus_medial_r"};
  EXPECT_EQ(nearestNames("soleus_r", known, 1).front(), "soleus_medial_r");
}

TEST(ParseNumber, AcceptsNumbersAndNamesTheFieldOtherwise) {
  EXPECT_DOUBLE_EQ(parseNumber(" -1.5e2 ", "f", "x"), -150);
  for (const char* bad : {"", "12a", "nan", "inf", "1,5"}) {
    try {
      parseNumber(bad, "f.csv: line 3", "u_px");
      ADD_FAILURE() << "accepted '" << bad << "'";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("f.csv: line 3: u_px: expected a number, found"));
    }
  }
}

}  // namespace
}  // namespace sinew
