#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A file of comma-separated values with a header line, as the resource folder keeps them. The first line reads
/// "# FORMAT VERSION: description"; further lines that start with '#' and empty lines are comments.
class CsvTable {
 public:
  /// @throws InputError if the file cannot be read, is of another format or version, lacks one of `columns`, names a
  /// column twice, or has a line whose number of cells differs from the header's.
  CsvTable(const std::filesystem::path& file, std::string_view format, int version,
           const std::vector<std::string>& columns);

  /// A table from elsewhere: no format line is asked for; otherwise the same.
  CsvTable(const std::filesystem::path& file, const std::vector<std::string>& columns);

  bool hasColumn(std::string_view column) const;
  std::size_t rowCount() const { return rows_.size(); }
  /// Cell as text. `column` is one of the header's (a bug of the caller otherwise).
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Cell as text that must not be empty. @throws InputError.
  const std::string& required(std::size_t row, std::string_view column) const;
  /// Cell as a finite number. @throws InputError naming file, line and column.
  double number(std::size_t row, std::string_view column) const;
  /// "muscles.csv: line 12", for messages about a row.
  std::string where(std::size_t row) const;

 private:
  struct Row {
    int line;
    std::vector<std::string> cells;
  };
  std::size_t columnIndex(std::string_view column) const;
  /// `start` must begin the first line.
  void read(const std::filesystem::path& file, const std::string& start, const std::vector<std::string>& columns);

  std::string file_;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

}  // namespace sinew
