#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace sinew {

/// One element of an XML document, and where it stands: every complaint names file, line and the way to the element.
class XmlElement {
 public:
  /// Parses a document. @throws InputError: where (with line), expected, found, if it is not well-formed XML.
  static XmlElement root(const std::string& text, const std::string& where);

  std::string tag() const { return node_.name(); }
  std::string attribute(const char* name) const { return node_.attribute(name).value(); }
  std::string name() const { return attribute("name"); }

  std::optional<XmlElement> find(const char* tag) const;
  XmlElement operator[](const char* tag) const;  ///< required
  std::vector<XmlElement> children() const;
  /// First child that is there.
  std::optional<XmlElement> findAny(std::initializer_list<const char*> tags) const;
  bool has(const char* tag) const { return static_cast<bool>(node_.child(tag)); }

  std::string text() const;                ///< without blanks around it
  std::vector<std::string> words() const;  ///< separated by blanks
  double number() const;                   ///< finite
  std::vector<double> numbers() const;
  std::vector<double> numbers(std::size_t count) const;  ///< exactly so many
  bool boolean() const;

  /// File and line; the way down from the document's element.
  std::string where() const;
  std::string path() const;
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;

 private:
  struct Document;
  XmlElement(std::shared_ptr<const Document> document, pugi::xml_node node)
      : document_{std::move(document)}, node_{node} {}

  std::shared_ptr<const Document> document_;
  pugi::xml_node node_;
};

}  // namespace sinew
