#include <cmath>
#include <cstdio>
#include <set>
#include <string_view>

#include "core/io/osim_nodes_internal.h"

namespace sinew::osim {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value == 0 ? 0.0 : value);
  return text;
}

void leaf(Node parent, const char* tag, const std::string& text) {
  parent.append_child(tag).text().set(text.c_str());
}

Node named(Node parent, const std::string& tag, const std::string& name) {
  Node node = parent.append_child(tag.c_str());
  node.append_attribute("name").set_value(name.c_str());
  return node;
}

Node openSet(Node parent, const char* tag, const std::string& name) {
  Node set = name.empty() ? parent.append_child(tag) : named(parent, tag, name);
  Node objects = set.append_child("objects");
  set.append_child("groups");
  return objects;
}

Eigen::Vector3d xyzAngles(const Eigen::Matrix3d& R) {
  const double y = std::atan2(R(0, 2), std::hypot(R(0, 0), R(0, 1)));
  if (std::abs(R(0, 2)) > 1 - 1e-12) return {std::atan2(R(0, 2) * R(1, 0), R(1, 1)), y, 0};  // z and x are one turn
  return {std::atan2(-R(1, 2), R(2, 2)), y, std::atan2(-R(0, 1), R(0, 0))};
}

std::vector<std::string> legalNames(const std::vector<std::string>& names) {
  std::set<std::string> taken;
  std::vector<std::string> legal;
  for (std::string name : names) {
    for (char& c : name)
      if (std::string_view{"\\/*+<>&\"' \t\r\n"}.find(c) != std::string_view::npos) c = '_';
    if (name.empty()) name = "unnamed";
    std::string unique = name;
    for (int i = 2; !taken.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    legal.push_back(unique);
  }
  return legal;
}

}  // namespace sinew::osim
