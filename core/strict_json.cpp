#include "core/strict_json.h"

#include <cmath>
#include <limits>

#include "core/text.h"

namespace sinew {
namespace {

constexpr std::size_t kLineWidth = 118;

/// The parser's own message without its prefix: "line 3, column 7: ...".
std::string parseComplaint(const nlohmann::json::parse_error& error, const std::string& text) {
  std::size_t line = 1, column = 1;
  for (std::size_t i = 0; i + 1 < error.byte && i < text.size(); ++i) {
    ++column;
    if (text[i] == '\n') ++line, column = 1;
  }
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// Short description of a value for a complaint: the type, and the value of plain ones.
std::string described(const Json& value, bool show_text) {
  switch (value.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "a list of " + std::to_string(value.size());
    case Json::value_t::string: {
      if (!show_text) return "a text";
      std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
      return text.size() > 60 ? text.substr(0, 57) + "...\"" : text;
    }
    default:
      return value.dump();
  }
}

bool isPlain(const Json& value) {
  return !value.is_structured();
}

std::string oneLine(const Json& value) {
  std::string line = value.is_array() ? "[" : "{";
  for (auto it = value.begin(); it != value.end(); ++it) {
    if (it != value.begin()) line += ", ";
    if (value.is_object()) line += Json(it.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    line += it->dump(-1, ' ', false, Json::error_handler_t::replace);
    if (line.size() > kLineWidth) return line;  // too long already: the caller breaks it
  }
  return line + (value.is_array() ? "]" : "}");
}

void write(const Json& value, std::size_t indent, std::string& out) {
  if (isPlain(value)) {
    out += value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return;
  }
  bool flat = true;
  for (const auto& item : value) flat = flat && isPlain(item);
  if (flat) {
    const std::string line = oneLine(value);
    const std::size_t used = out.size() - (out.rfind('\n') + 1);
    if (used + line.size() <= kLineWidth) {
      out += line;
      return;
    }
  }
  out += value.is_array() ? '[' : '{';
  for (auto it = value.begin(); it != value.end(); ++it) {
    out += it == value.begin() ? "\n" : ",\n";
    out.append(indent + 2, ' ');
    if (value.is_object()) out += Json(it.key()).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
    write(*it, indent + 2, out);
  }
  out += '\n';
  out.append(indent, ' ');
  out += value.is_array() ? ']' : '}';
}

}  // namespace

Json parseJson(const std::string& text, const std::string& where) {
  try {
    return Json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError{{where, parseComplaint(error, text), "JSON text",
                      text.empty() ? "an empty file" : "a syntax error (damaged or cut off?)"}};
  } catch (const nlohmann::json::exception&) {  // a number out of range, text that is not UTF-8
    throw InputError{{where, "", "JSON text", "a value that cannot be represented"}};
  }
}

std::string jsonText(const Json& value) {
  std::string text;
  write(value, 0, text);
  return text + "\n";
}

Json numberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json numberOrNull(const std::optional<double>& value) {
  return value ? numberOrNull(*value) : Json(nullptr);
}

void JsonReader::expectFormat(std::string_view format, int version) const {
  const JsonReader f = (*this)["format"];
  if (f.text() != format) f.fail("'" + std::string{format} + "'");
  const JsonReader v = (*this)["version"];
  if (!v.value_->is_number_integer()) v.fail("a whole number");
  if (*v.value_ == version) return;
  const bool future = *v.value_ > version;
  v.fail("version " + std::to_string(version),
         v.value_->dump() + (future ? ": written by a newer program; update this one" : ""));
}

void JsonReader::allowOnly(std::initializer_list<std::string_view> known) const {
  if (!value_->is_object()) fail("an object");
  for (auto it = value_->begin(); it != value_->end(); ++it) {
    if (std::ranges::find(known, it.key()) != known.end()) continue;
    const std::vector<std::string> names(known.begin(), known.end());
    fail("known members only", "'" + it.key() + "'" + didYouMean(it.key(), names));
  }
}

JsonReader JsonReader::child(const Json& value, std::string_view member) const {
  return {value, where_, path_.empty() ? std::string{member} : path_ + "." + std::string{member}};
}

JsonReader JsonReader::child(const Json& value, std::size_t index) const {
  return {value, where_, path_ + "[" + std::to_string(index) + "]"};
}

JsonReader JsonReader::operator[](std::string_view member) const {
  if (!value_->is_object()) fail("an object");
  const auto it = value_->find(member);
  static const Json nothing;
  if (it == value_->end()) child(nothing, member).fail("a value", "nothing");
  return child(*it, member);
}

std::optional<JsonReader> JsonReader::find(std::string_view member) const {
  if (!value_->is_object()) fail("an object");
  const auto it = value_->find(member);
  if (it == value_->end() || it->is_null()) return std::nullopt;
  return child(*it, member);
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
  if (!value_->is_object()) fail("an object");
  std::vector<std::pair<std::string, JsonReader>> list;
  for (auto it = value_->begin(); it != value_->end(); ++it) list.emplace_back(it.key(), child(*it, it.key()));
  return list;
}

std::vector<JsonReader> JsonReader::items() const {
  if (!value_->is_array()) fail("a list");
  std::vector<JsonReader> list;
  for (std::size_t i = 0; i < value_->size(); ++i) list.push_back(child((*value_)[i], i));
  return list;
}

std::vector<JsonReader> JsonReader::items(std::size_t count) const {
  if (!value_->is_array() || value_->size() != count) fail("a list of " + std::to_string(count));
  return items();
}

std::string JsonReader::text() const {
  if (!value_->is_string()) fail("a text");
  return value_->get<std::string>();
}

bool JsonReader::boolean() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

int JsonReader::integer(int lower, int upper) const {
  const auto expected = [&] { return "a whole number " + std::to_string(lower) + " ... " + std::to_string(upper); };
  if (!value_->is_number_integer() || *value_ < lower || *value_ > upper) fail(expected());
  return value_->get<int>();
}

double JsonReader::number() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) fail("a number");
  return value_->get<double>();
}

double JsonReader::numberOrNaN() const {
  if (value_->is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!value_->is_number()) fail("a number or null");
  return number();
}

double JsonReader::positive() const {
  if (!value_->is_number() || !(number() > 0)) fail("a number > 0");
  return number();
}

double JsonReader::numberIn(double lower, double upper) const {
  if (value_->is_number() && number() >= lower && number() <= upper) return number();
  fail("a number " + brief(lower) + " ... " + brief(upper));
}

std::vector<double> JsonReader::numbers() const {
  if (!value_->is_array()) fail("a list of numbers");
  std::vector<double> list;
  list.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) {
    const Json& item = (*value_)[i];
    list.push_back(item.is_number() && std::isfinite(item.get<double>()) ? item.get<double>()
                                                                         : child(item, i).number());
  }
  return list;
}

std::vector<double> JsonReader::numbers(std::size_t count) const {
  if (!value_->is_array() || value_->size() != count) fail("a list of " + std::to_string(count) + " numbers");
  return numbers();
}

std::string JsonReader::oneOf(std::initializer_list<std::string_view> names) const {
  if (value_->is_string() && std::ranges::find(names, value_->get_ref<const std::string&>()) != names.end())
    return text();
  std::string expected;
  for (const auto name : names) expected += (expected.empty() ? "'" : ", '") + std::string{name} + "'";
  fail("one of " + expected);
}

void JsonReader::fail(const std::string& expected) const {
  fail(expected, described(*value_, !path_.starts_with("patient")));  // a person's name is not repeated in an error
}

void JsonReader::fail(const std::string& expected, const std::string& found) const {
  throw InputError{{where_, path_.empty() ? "document" : path_, expected, found}};
}

Json warningsToJson(const Warnings& warnings) {
  Json list = Json::array();
  for (const auto& w : warnings) list.push_back({{"code", w.code}, {"message", w.message}});
  return list;
}

Warnings warningsFromJson(const JsonReader& json) {
  Warnings warnings;
  for (const auto& w : json.items()) {
    w.allowOnly({"code", "message"});
    warnings.push_back({w["code"].text(), w["message"].text()});
  }
  return warnings;
}

Outcome outcomeFromJson(const JsonReader& json) {
  const std::string name = json.oneOf({"not_run", "converged", "not_converged", "cancelled"});
  for (const auto outcome : {Outcome::Converged, Outcome::NotConverged, Outcome::Cancelled})
    if (name == nameOf(outcome)) return outcome;
  return Outcome::NotRun;
}

}  // namespace sinew
