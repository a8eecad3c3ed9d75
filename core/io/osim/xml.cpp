#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/io/osim/xml_internal.h"

namespace sinew {

struct XmlElement::Document {
  pugi::xml_document xml;
  std::string where;
  std::vector<std::size_t> line_ends;

  std::string place(std::ptrdiff_t offset) const {
    const auto line =
        std::ranges::lower_bound(line_ends, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return where + ": line " + std::to_string(line - line_ends.begin() + 1);
  }
};

XmlElement XmlElement::root(const std::string& text, const std::string& where) {
  const auto document = std::make_shared<Document>();
  document->where = where;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') document->line_ends.push_back(i);
  const pugi::xml_parse_result result = document->xml.load_buffer(text.data(), text.size());
  if (!result) throw InputError{{document->place(result.offset), "", "well-formed XML", result.description()}};
  return {document, document->xml.document_element()};
}

std::optional<XmlElement> XmlElement::find(const char* tag) const {
  const pugi::xml_node child = node_.child(tag);
  if (!child) return std::nullopt;
  return XmlElement{document_, child};
}

std::optional<XmlElement> XmlElement::findAny(std::initializer_list<const char*> tags) const {
  for (const char* tag : tags)
    if (const auto child = find(tag)) return child;
  return std::nullopt;
}

XmlElement XmlElement::operator[](const char* tag) const {
  const auto child = find(tag);
  if (!child) fail(std::string{"an element <"} + tag + ">", "none");
  return *child;
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> list;
  for (const pugi::xml_node child : node_.children())
    if (child.type() == pugi::node_element) list.push_back({document_, child});
  return list;
}

std::string XmlElement::text() const {
  const std::string all = node_.text().get();
  const auto first = all.find_first_not_of(" \t\r\n"), last = all.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : all.substr(first, last - first + 1);
}

std::vector<std::string> XmlElement::words() const {
  std::istringstream in{text()};
  std::vector<std::string> list;
  for (std::string word; in >> word;) list.push_back(word);
  return list;
}

std::vector<double> XmlElement::numbers() const {
  std::vector<double> list;
  for (const auto& word : words()) {
    double value = 0;
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
      fail("finite numbers", "'" + word + "'");
    list.push_back(value);
  }
  return list;
}

std::vector<double> XmlElement::numbers(std::size_t count) const {
  auto list = numbers();
  if (list.size() != count) fail(std::to_string(count) + " numbers", std::to_string(list.size()));
  return list;
}

double XmlElement::number() const {
  return numbers(1).front();
}

bool XmlElement::boolean() const {
  const std::string value = text();
  if (value == "true" || value == "1") return true;
  if (value == "false" || value == "0") return false;
  fail("true or false", "'" + value + "'");
}

std::string XmlElement::where() const {
  return document_->place(node_.offset_debug());
}

std::string XmlElement::path() const {
  std::string path;
  for (pugi::xml_node n = node_; n && n.type() == pugi::node_element; n = n.parent()) {
    const std::string name = n.attribute("name").value();
    path = std::string{n.name()} + (name.empty() ? "" : " '" + name + "'") + (path.empty() ? "" : "/" + path);
  }
  return path;
}

void XmlElement::fail(const std::string& expected, const std::string& found) const {
  throw InputError{{where(), path(), expected, found}};
}

}  // namespace sinew
