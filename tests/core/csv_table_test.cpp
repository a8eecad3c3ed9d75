#include "core/csv_table.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/file.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

class CsvTableTest : public testing::Test {
 protected:
  CsvTable read(const std::string& content) {
    writeFileAtomically(folder_ / "t.csv", content);
    return CsvTable{folder_ / "t.csv", "sinew.test", 1, {"name", "x_m"}};
  }
  std::string complaint(const std::string& content) {
    try {
      read(content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  test::TemporaryFolder folder_;
};

TEST_F(CsvTableTest, ReadsCellsByColumnAndCountsLinesOfTheFile) {
  const auto table = read("# sinew.test 1: a table\n\nname,x_m,note\n# remark\n\"a, b\",0.5,\nc,x,n\n");
  ASSERT_EQ(table.rowCount(), 2u);
  EXPECT_EQ(table.text(0, "name"), "a, b");
  EXPECT_EQ(table.number(0, "x_m"), 0.5);
  EXPECT_EQ(table.where(1), "t.csv: line 6");
  EXPECT_THROW(table.number(1, "x_m"), InputError);
  EXPECT_THROW(table.required(0, "note"), InputError);
  EXPECT_THROW(table.text(0, "z_m"), std::logic_error);
}

TEST_F(CsvTableTest, NamesWhatIsWrongWithTheFile) {
  EXPECT_THAT(complaint("name,x_m\n"), HasSubstr("t.csv: line 1: format: expected '# sinew.test 1:"));
  EXPECT_THAT(complaint("# sinew.test 2: newer\nname,x_m\n"), HasSubstr("format"));
  EXPECT_THAT(complaint("# sinew.test 1: t\nname\n"), HasSubstr("header: expected one column 'x_m', found 0"));
  EXPECT_THAT(complaint("# sinew.test 1: t\nname,x_m,x_m\n"), HasSubstr("found 2"));
  EXPECT_THAT(complaint("# sinew.test 1: t\nname,x_m\na\n"), HasSubstr("t.csv: line 3: cells: expected 2, found 1"));
  EXPECT_THAT(complaint(""), HasSubstr("header"));
}

TEST_F(CsvTableTest, ReadsTablesOfOthersWithoutAFormatLine) {
  writeFileAtomically(folder_ / "t.csv", "name,x_m\n# remark\na,1\n");
  const CsvTable table{folder_ / "t.csv", {"name"}};
  EXPECT_EQ(table.number(0, "x_m"), 1);
  EXPECT_TRUE(table.hasColumn("x_m"));
  EXPECT_FALSE(table.hasColumn("y_m"));
  EXPECT_THROW((CsvTable{folder_ / "t.csv", {"y_m"}}), InputError);
}

}  // namespace
}  // namespace sinew
