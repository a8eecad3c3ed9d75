#include "core/geometry/bone_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/file.h"
#include "core/strict_json.h"

namespace sinew {
namespace {

constexpr double kMm = 1e-3;  // millimetres of the file to metres

Eigen::Vector3d vectorIn(const JsonReader& json) {
  const auto v = json.numbers(3);
  return {v[0], v[1], v[2]};
}

Eigen::Vector3d directionOr(const JsonReader& part, std::string_view field, const Eigen::Vector3d& fallback) {
  const auto json = part.find(field);
  if (!json) return fallback;
  const Eigen::Vector3d direction = vectorIn(*json);
  if (direction.norm() < 1e-6) json->fail("a direction", "zero");
  return direction;
}

double lengthOr(const JsonReader& part, std::string_view field, double fallback_m) {
  const auto json = part.find(field);
  return json ? json->numberIn(0, 1000) * kMm : fallback_m;
}

Eigen::Matrix3d axesOf(const JsonReader& part) {
  const Eigen::Vector3d u = directionOr(part, "u_axis", Eigen::Vector3d::UnitX());
  const Eigen::Vector3d v = directionOr(part, "v_axis", Eigen::Vector3d::UnitY());
  if (u.normalized().cross(v.normalized()).norm() < 1e-3)
    part.fail("u_axis and v_axis that are not parallel", "parallel ones");
  return axesFrom(u, v);
}

Eigen::Vector3d positiveSizes(const JsonReader& json) {
  const Eigen::Vector3d sizes = vectorIn(json) * kMm;
  if (sizes.minCoeff() <= 0) json.fail("three lengths > 0");
  return sizes;
}

/// Stations [x, y, z, r] or [x, y, z, u radius, v radius] or with the section's own u direction appended.
std::unique_ptr<Primitive> readTube(const JsonReader& part) {
  const Eigen::Vector3d u = directionOr(part, "u_axis", Eigen::Vector3d::UnitZ());
  std::vector<TubeStation> stations;
  for (const auto& item : part["stations_mm"].items()) {
    const auto n = item.numbers();
    if (n.size() != 4 && n.size() != 5 && n.size() != 8) item.fail("4, 5 or 8 numbers", std::to_string(n.size()));
    TubeStation s{kMm * Eigen::Vector3d{n[0], n[1], n[2]}, kMm * n[3], kMm * n[n.size() == 4 ? 3 : 4], u};
    if (n.size() == 8) s.u = {n[5], n[6], n[7]};
    if (!(s.u_radius_m > 0 && s.v_radius_m > 0 && s.u.norm() > 1e-6)) item.fail("radii > 0 and a direction");
    if (!stations.empty() && (s.center - stations.back().center).norm() < 1e-6) item.fail("a new place");
    stations.push_back(s);
  }
  if (stations.size() < 2) part["stations_mm"].fail("at least 2 stations", std::to_string(stations.size()));
  return makeTube(stations);
}

std::unique_ptr<Primitive> readSheet(const JsonReader& part) {
  std::vector<std::vector<SheetPoint>> rows;
  for (const auto& row : part["rows_mm"].items()) {
    rows.emplace_back();
    for (const auto& item : row.items()) {
      const auto n = item.numbers(4);
      if (n[3] <= 0) item.fail("half thickness > 0");
      rows.back().push_back({kMm * Eigen::Vector3d{n[0], n[1], n[2]}, kMm * n[3]});
    }
    if (rows.back().size() < 2 || rows.back().size() != rows.front().size()) row.fail("rows of equal length >= 2");
  }
  if (rows.size() < 2) part["rows_mm"].fail("at least 2 rows", std::to_string(rows.size()));
  return makeSheet(rows);
}

std::unique_ptr<Primitive> readPrimitive(const JsonReader& part) {
  const std::string shape = part["shape"].oneOf({"sphere", "ellipsoid", "box", "drum", "tube", "sheet"});
  if (shape == "tube") return readTube(part);
  if (shape == "sheet") return readSheet(part);
  const Eigen::Vector3d center = vectorIn(part["center_mm"]) * kMm;
  if (shape == "sphere") return makeSphere(center, part["radius_mm"].positive() * kMm);
  if (shape == "ellipsoid") return makeEllipsoid(center, positiveSizes(part["radii_mm"]), axesOf(part));
  const Eigen::Vector3d half = positiveSizes(part["half_mm"]);
  const double rounding_m = lengthOr(part, "rounding_mm", 1 * kMm);
  if (rounding_m >= half.minCoeff()) part["half_mm"].fail("sizes larger than rounding_mm");
  if (shape == "box") return makeBox(center, half, axesOf(part), rounding_m);
  const auto waist = part.find("waist");
  return makeDrum(center, half, axesOf(part), rounding_m, waist ? waist->numberIn(0, 0.5) : 0.0);
}

SurfacePart readPart(const JsonReader& json, double blend_m) {
  json.allowOnly({"what", "shape", "join", "blend_mm", "center_mm", "radius_mm", "radii_mm", "half_mm", "rounding_mm",
                  "waist", "u_axis", "v_axis", "stations_mm", "rows_mm"});
  json["what"].text();  // every part says what it is
  SurfacePart part;
  if (const auto join = json.find("join")) {
    const std::string name = join->oneOf({"add", "cut", "keep"});
    part.join = name == "add" ? JoinKind::Add : name == "cut" ? JoinKind::Cut : JoinKind::Keep;
  }
  part.blend_m = lengthOr(json, "blend_mm", blend_m);
  part.primitive = readPrimitive(json);
  return part;
}

BoneShape readBone(const JsonReader& json) {
  json.allowOnly({"name", "segment", "comment", "symmetric", "voxel_mm", "triangles", "blend_mm", "pieces"});
  BoneShape bone;
  bone.name = json["name"].text();
  bone.segment = json["segment"].text();
  bone.voxel_m = json["voxel_mm"].numberIn(0.3, 5) * kMm;
  bone.triangles = json["triangles"].integer(100, 100000);
  const auto symmetric = json.find("symmetric");
  const double blend_m = lengthOr(json, "blend_mm", 4 * kMm);
  for (const auto& piece : json["pieces"].items()) {
    std::vector<SurfacePart> parts;
    for (const auto& part : piece.items()) parts.push_back(readPart(part, blend_m));
    if (parts.empty() || parts.front().join != JoinKind::Add) piece.fail("parts of which the first is added");
    bone.pieces.emplace_back(std::move(parts), symmetric && symmetric->boolean());
  }
  if (bone.pieces.empty()) json["pieces"].fail("at least one piece");
  return bone;
}

}  // namespace

double BoneShape::distance(const Eigen::Vector3d& p) const {
  double d = std::numeric_limits<double>::infinity();
  for (const auto& piece : pieces) d = std::min(d, piece.distance(p));
  return d;
}

std::vector<BoneShape> readBoneShapes(const std::string& text, const std::string& where) {
  const Json root = parseJson(text, where);
  const JsonReader json{root, where};
  json.expectFormat("sinew.bones", 1);
  json.allowOnly({"format", "version", "frame", "source", "bones"});
  std::vector<BoneShape> bones;
  for (const auto& bone : json["bones"].items()) bones.push_back(readBone(bone));
  return bones;
}

std::vector<BoneShape> loadBoneShapes(const std::filesystem::path& resource_dir) {
  const auto folder = resource_dir / "skeleton" / "bones";
  std::vector<std::filesystem::path> files;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator{folder, missing})
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty()) throw InputError{folder.string() + ": expected bone descriptions (*.json), found none"};
  std::sort(files.begin(), files.end());
  std::vector<BoneShape> bones;
  for (const auto& file : files)
    for (auto& bone : readBoneShapes(readFile(file), file.string())) bones.push_back(std::move(bone));
  return bones;
}

}  // namespace sinew
