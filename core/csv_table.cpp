#include "core/csv_table.h"

#include <algorithm>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace sinew {

CsvTable::CsvTable(const std::filesystem::path& file, std::string_view format, int version,
                   const std::vector<std::string>& columns)
    : file_{file.filename().string()} {
  read(file, "# " + std::string{format} + " " + std::to_string(version) + ":", columns);
}

CsvTable::CsvTable(const std::filesystem::path& file, const std::vector<std::string>& columns)
    : file_{file.filename().string()} {
  read(file, "", columns);
}

void CsvTable::read(const std::filesystem::path& file, const std::string& start,
                    const std::vector<std::string>& columns) {
  std::istringstream lines{readFile(file)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (number == 1 && !line.starts_with(start))
      throw InputError{{file_ + ": line 1", "format", "'" + start + " ...'", "'" + line.substr(0, 60) + "'"}};
    if (line.starts_with('#') || line.find_first_not_of(" \t\r") == std::string::npos) continue;
    auto cells = splitCsvLine(line);
    if (header_.empty()) {
      header_ = std::move(cells);
    } else {
      if (cells.size() != header_.size())
        throw InputError{{file_ + ": line " + std::to_string(number), "cells", std::to_string(header_.size()),
                          std::to_string(cells.size())}};
      rows_.push_back({number, std::move(cells)});
    }
  }
  for (const auto& column : columns)
    if (const auto n = std::ranges::count(header_, column); n != 1)
      throw InputError{{file_, "header", "one column '" + column + "'", std::to_string(n)}};
}

bool CsvTable::hasColumn(std::string_view column) const {
  return std::ranges::find(header_, column) != header_.end();
}

std::size_t CsvTable::columnIndex(std::string_view column) const {
  const auto found = std::ranges::find(header_, column);
  require(found != header_.end(), "CsvTable: column that was asked for at construction");
  return static_cast<std::size_t>(found - header_.begin());
}

const std::string& CsvTable::text(std::size_t row, std::string_view column) const {
  return rows_.at(row).cells[columnIndex(column)];
}

const std::string& CsvTable::required(std::size_t row, std::string_view column) const {
  const std::string& cell = text(row, column);
  if (cell.empty()) throw InputError{{where(row), std::string{column}, "a value", "an empty cell"}};
  return cell;
}

double CsvTable::number(std::size_t row, std::string_view column) const {
  return parseNumber(text(row, column), where(row), std::string{column});
}

std::string CsvTable::where(std::size_t row) const {
  return file_ + ": line " + std::to_string(rows_.at(row).line);
}

}  // namespace sinew
