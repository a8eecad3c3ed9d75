#pragma once
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/job.h"

namespace sinew {

/// JSON as the product writes it: members keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// Parses a whole document. @throws InputError in one line: `where`, line and column.
Json parseJson(const std::string& text, const std::string& where);

/// Text for people and for diff: two blanks a level; a list or object of plain values that fits stays on one line.
/// Bytes that are not UTF-8 are replaced. Ends with a line break.
std::string jsonText(const Json& value);

/// A number; null for NaN and infinity, which JSON does not have.
Json numberOrNull(double value);
Json numberOrNull(const std::optional<double>& value);

/// One value of a document, and where it stands in it: every complaint names file and field path.
/// Reading is strict: a wrong type, a missing or an unknown member is an InputError, so that nothing is lost
/// silently.
class JsonReader {
 public:
  /// `value` must outlive the reader.
  JsonReader(const Json& value, std::string where, std::string path = {})
      : value_{&value}, where_{std::move(where)}, path_{std::move(path)} {}

  /// The object's "format" is `format` and its "version" is `version`, nothing newer or older.
  void expectFormat(std::string_view format, int version) const;
  /// The value is an object and has no other members than these.
  void allowOnly(std::initializer_list<std::string_view> members) const;

  JsonReader operator[](std::string_view member) const;           ///< required member
  std::optional<JsonReader> find(std::string_view member) const;  ///< nullopt if absent or null
  std::vector<std::pair<std::string, JsonReader>> members() const;
  std::vector<JsonReader> items() const;
  std::vector<JsonReader> items(std::size_t count) const;  ///< exactly so many

  std::string text() const;
  bool boolean() const;
  int integer(int lower, int upper) const;
  double number() const;       ///< finite
  double numberOrNaN() const;  ///< null reads NaN
  double positive() const;     ///< finite and > 0
  double numberIn(double lower, double upper) const;
  std::vector<double> numbers() const;                   ///< list of finite numbers
  std::vector<double> numbers(std::size_t count) const;  ///< exactly so many
  /// One of `names`; the error lists them.
  std::string oneOf(std::initializer_list<std::string_view> names) const;

  const std::string& where() const { return where_; }
  const std::string& path() const { return path_; }
  /// Complains about this value: where, path, expected, found.
  [[noreturn]] void fail(const std::string& expected) const;
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

 private:
  JsonReader child(const Json& value, std::string_view member) const;
  JsonReader child(const Json& value, std::size_t index) const;

  const Json* value_;
  std::string where_, path_;
};

// What every module's results carry.
Json warningsToJson(const Warnings& warnings);
Warnings warningsFromJson(const JsonReader& json);
Outcome outcomeFromJson(const JsonReader& json);

}  // namespace sinew
