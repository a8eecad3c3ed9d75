#include "core/date.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace sinew {
namespace {

TEST(Date, ReadsTheFormsThatFormsAndFilesUse) {
  EXPECT_EQ(dateFromText("2009-05-31"), (Date{2009, 5, 31}));
  EXPECT_EQ(dateFromText("20090531"), (Date{2009, 5, 31}));
  EXPECT_EQ(dateFromText("2009.05.31"), (Date{2009, 5, 31}));  // ACR-NEMA
  EXPECT_EQ(dateFromText("2009-05"), (Date{2009, 5, 0}));
  EXPECT_EQ(dateFromText("2009"), (Date{2009, 0, 0}));
  EXPECT_EQ(dateFromText(" 20090531 "), (Date{2009, 5, 31}));  // DICOM pads
}

TEST(Date, KnowsTheCalendar) {
  EXPECT_TRUE(dateFromText("2012-02-29"));
  EXPECT_TRUE(dateFromText("2000-02-29"));
  for (const char* text :
       {"2013-02-29", "1900-02-29", "2012-02-30", "20120231", "2012-04-31", "2012-13-01", "2012-00-10", "2012-01-00",
        "00000000", "99999999", "9999-99-99", "0000-00-00", "2012-02", "1012-02-03", "3012-02-03"})
    EXPECT_EQ(dateFromText(text).has_value(), std::string_view{text} == "2012-02") << text;
}

TEST(Date, RefusesEverythingElse) {
  for (const char* text : {"", "today", "31.05.2009", "05/31/2009", "2009-5-31", "2009-05-3x", "2009-05.31",
                           "-009-05-31", "200905", "2009-05-31T10:00", "+2009531"})
    EXPECT_FALSE(dateFromText(text)) << text;
}

TEST(Date, WritesWhatItRead) {
  for (const char* text : {"2009-05-31", "2009-05", "2009"}) EXPECT_EQ(isoText(*dateFromText(text)), text);
}

TEST(Date, IsBeforeAnotherOnlyIfThatIsCertain) {
  EXPECT_TRUE(certainlyBefore({2009, 5, 30}, {2009, 5, 31}));
  EXPECT_FALSE(certainlyBefore({2009, 5, 31}, {2009, 5, 31}));
  EXPECT_FALSE(certainlyBefore({2009, 0, 0}, {2009, 5, 31}));  // some day of 2009
  EXPECT_TRUE(certainlyBefore({2008, 0, 0}, {2009, 5, 31}));
  EXPECT_FALSE(certainlyBefore({2009, 5, 0}, {2009, 5, 31}));
  EXPECT_TRUE(certainlyBefore({2009, 4, 0}, {2009, 5, 0}));
}

TEST(Date, AnEnteredDateIsWrittenAsIsoOrRefusedByName) {
  EXPECT_EQ(checkedDate("", "patient", "birth date"), "");
  EXPECT_EQ(checkedDate(" 20090531", "patient", "birth date"), "2009-05-31");
  try {
    checkedDate("2009-02-31", "patient", "birth date");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "patient: birth date: expected a day of the calendar, YYYY-MM-DD, found '2009-02-31'");
  }
}

}  // namespace
}  // namespace sinew
