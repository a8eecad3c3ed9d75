#include "core/model/passive_json.h"

#include "core/model/skeleton_json.h"

namespace sinew {
namespace {

Json endToJson(double moment_Nm, double rate_per_rad, double angle_rad) {
  return {{"moment_Nm", moment_Nm}, {"rate_per_rad", rate_per_rad}, {"angle_rad", angle_rad}};
}

void readEnd(const JsonReader& json, double& moment_Nm, double& rate_per_rad, double& angle_rad) {
  json.allowOnly({"moment_Nm", "rate_per_rad", "angle_rad"});
  moment_Nm = json["moment_Nm"].positive();
  rate_per_rad = json["rate_per_rad"].positive();
  angle_rad = json["angle_rad"].number();
}

}  // namespace

Json passiveMomentToJson(const PassiveMoment& m) {
  Json json = Json::object();
  if (m.upper_Nm > 0) json["upper"] = endToJson(m.upper_Nm, m.upper_rate_per_rad, m.upper_rad);
  if (m.lower_Nm > 0) json["lower"] = endToJson(m.lower_Nm, m.lower_rate_per_rad, m.lower_rad);
  return json;
}

PassiveMoment passiveMomentFromJson(const JsonReader& json) {
  json.allowOnly({"upper", "lower"});
  PassiveMoment m;
  if (const auto upper = json.find("upper")) readEnd(*upper, m.upper_Nm, m.upper_rate_per_rad, m.upper_rad);
  if (const auto lower = json.find("lower")) readEnd(*lower, m.lower_Nm, m.lower_rate_per_rad, m.lower_rad);
  return m;
}

Json passiveMomentsToJson(const PassiveMoments& moments, const Skeleton& skeleton) {
  Json json = Json::object();
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (const Json entry = passiveMomentToJson(moments[i]); !entry.empty())
      json[skeleton.coordinates[i].name] = entry;
  return json;
}

PassiveMoments passiveMomentsFromJson(const JsonReader& json, const Skeleton& skeleton) {
  const auto members = json.members();
  if (members.empty()) return {};
  PassiveMoments moments(skeleton.coordinates.size());
  for (const auto& [name, entry] : members) {
    const int i = namedIndex(entry, name, [&](const std::string& n) { return skeleton.coordinateIndex(n); });
    const Joint& joint = skeleton.joints[std::size_t(skeleton.coordinates[std::size_t(i)].joint)];
    if (joint.type == JointType::Free) entry.fail("a coordinate of a joint", "'" + name + "' of the free root");
    moments[std::size_t(i)] = passiveMomentFromJson(entry);
  }
  return moments;
}

}  // namespace sinew
