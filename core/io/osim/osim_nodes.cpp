#include <cmath>
#include <set>
#include <string_view>

#include "core/io/osim/osim_nodes_internal.h"
#include "core/text.h"

namespace sinew::osim {

std::string number(double value) {
  return brief(value, 17);
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

/// z first, then the others from what is left: exact at the pole too, where z is any number.
Eigen::Vector3d xyzAngles(const Eigen::Matrix3d& R) {
  const double z = std::atan2(-R(0, 1), R(0, 0)), c = std::cos(z), s = std::sin(z);
  const Eigen::Vector3d x_column = R * Eigen::Vector3d{c, -s, 0}, y_column = R * Eigen::Vector3d{s, c, 0};
  return {std::atan2(y_column.z(), y_column.y()), std::atan2(R(0, 2), x_column.x()), z};
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
