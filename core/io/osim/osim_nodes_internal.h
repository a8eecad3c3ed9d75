#pragma once
#include <Eigen/Core>
#include <functional>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace sinew::osim {

// Elements as OpenSim writes them.

using Node = pugi::xml_node;

std::string number(double value);

template <class Range>
std::string numbers(const Range& values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : " ") + number(v);
  return text;
}

/// <tag>text</tag>
void leaf(Node parent, const char* tag, const std::string& text);
/// <tag name="name">
Node named(Node parent, const std::string& tag, const std::string& name);
/// <XSet name="xset"><objects>..</objects><groups/></XSet>; the answer is <objects>. Without a name where it is
/// empty.
Node openSet(Node parent, const char* tag, const std::string& name = {});

/// Angles of the intrinsic x-y-z sequence.
Eigen::Vector3d xyzAngles(const Eigen::Matrix3d& R);

/// Legal and different names for a list.
std::vector<std::string> legalNames(const std::vector<std::string>& names);

template <class List, class Name>
std::vector<std::string> legalNames(const List& list, Name name) {
  std::vector<std::string> names;
  for (const auto& item : list) names.push_back(std::invoke(name, item));
  return legalNames(names);
}

}  // namespace sinew::osim
