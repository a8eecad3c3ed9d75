#include "core/rom/poses/pose_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/file.h"
#include "core/posture/validity.h"
#include "core/strict_json.h"

namespace sinew {
namespace {

static_assert(std::endian::native == std::endian::little, "pose files are little-endian");
constexpr char kMagic[] = "SINEWPOS";
constexpr std::size_t kMagicBytes = 8;
constexpr std::uint32_t kLongestHeader = 1 << 20;

std::vector<std::string> namesOf(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const auto& c : skeleton.coordinates) names.push_back(c.name);
  return names;
}

/// Opened file, read up to the first posture.
struct PoseFile {
  std::ifstream in;
  std::string where, source;
  std::size_t count = 0;
};

PoseFile openPoseFile(const std::filesystem::path& file, const Skeleton& skeleton) {
  PoseFile pf{std::ifstream{file, std::ios::binary}, file.filename().string(), {}, 0};
  if (!pf.in) throw InputError{{file.string(), "", "a readable pose set", "no such file"}};
  char magic[kMagicBytes];
  std::uint32_t header_bytes = 0;
  pf.in.read(magic, kMagicBytes);
  pf.in.read(reinterpret_cast<char*>(&header_bytes), sizeof header_bytes);
  if (!pf.in || std::memcmp(magic, kMagic, kMagicBytes) != 0)
    throw InputError{{pf.where, "", "a pose set (it begins with SINEWPOS)", "another file"}};
  if (header_bytes > kLongestHeader)
    throw InputError{{pf.where, "header", "at most 1 MiB", std::to_string(header_bytes) + " bytes"}};
  std::string text(header_bytes, '\0');
  pf.in.read(text.data(), header_bytes);
  if (!pf.in) throw InputError{{pf.where, "header", std::to_string(header_bytes) + " bytes", "the end of the file"}};
  const Json document = parseJson(text, pf.where);
  const JsonReader json{document, pf.where};
  json.expectFormat("sinew.pose_set", 1);
  json.allowOnly({"format", "version", "source", "coordinates", "count"});
  pf.source = json["source"].text();
  pf.count = static_cast<std::size_t>(json["count"].integer(0, 100'000'000));
  const auto names = namesOf(skeleton);
  const auto in_file = json["coordinates"].items(names.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    if (in_file[i].text() != names[i]) in_file[i].fail("'" + names[i] + "'", "'" + in_file[i].text() + "'");
  const auto begin = pf.in.tellg();
  pf.in.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::size_t>(pf.in.tellg() - begin);
  if (bytes != pf.count * names.size() * sizeof(float))
    throw InputError{{pf.where, "postures", std::to_string(pf.count * names.size() * sizeof(float)) + " bytes",
                      std::to_string(bytes) + " bytes"}};
  pf.in.seekg(begin);
  return pf;
}

}  // namespace

PoseMirror::PoseMirror(const Skeleton& skeleton) {
  from_.resize(skeleton.coordinates.size());
  sign_.assign(skeleton.coordinates.size(), 1);
  for (const Joint& joint : skeleton.joints) {
    std::string other = joint.name;
    if (other.ends_with("_r") || other.ends_with("_l")) other.back() = other.back() == 'r' ? 'l' : 'r';
    const int source = skeleton.joints[skeleton.jointIndex(other)].first_coordinate;
    for (int i = 0; i < joint.coordinate_count; ++i) from_[joint.first_coordinate + i] = source + i;
    const int r = joint.first_coordinate + (joint.type == JointType::Free ? 3 : 0);
    if (joint.type == JointType::Free) sign_[joint.first_coordinate + 2] = -1;  // a translation turns its Z
    if (joint.type != JointType::Revolute) sign_[r] = sign_[r + 1] = -1;        // a turn keeps it
  }
}

Posture PoseMirror::operator()(const Posture& q) const {
  Posture m(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) m[i] = sign_[i] * q[from_[i]];
  return m;
}

PoseSet::PoseSet(const Skeleton& skeleton, std::string source)
    : names_{namesOf(skeleton)}, source_{std::move(source)} {}

void PoseSet::add(const Posture& q) {
  require(q.size() == static_cast<Eigen::Index>(names_.size()), "PoseSet: one entry a coordinate");
  for (const double x : q) values_.push_back(static_cast<float>(x));
}

void PoseSet::append(const PoseSet& other) {
  require(other.names_ == names_, "PoseSet: sets of one skeleton");
  values_.insert(values_.end(), other.values_.begin(), other.values_.end());
}

Posture PoseSet::posture(std::size_t i) const {
  const auto n = static_cast<Eigen::Index>(names_.size());
  return Eigen::Map<const Eigen::VectorXf>(values_.data() + i * names_.size(), n).cast<double>();
}

void PoseSet::read(std::size_t first, PoseTable& table) const {
  require(first + table.poseCount() <= size() && table.entryCount() == names_.size(),
          "PoseSet::read: within the set");
  const float* value = &values_[first * names_.size()];
  for (std::size_t pose = 0; pose < table.poseCount(); ++pose)
    for (std::size_t entry = 0; entry < table.entryCount(); ++entry) table(pose, entry) = *value++;
}

void PoseSet::visit(const PoseVisitor& visit) const {
  const auto n = static_cast<Eigen::Index>(names_.size());
  for (std::size_t i = 0; i < size(); i += kPoseBlock) {
    const auto columns = static_cast<Eigen::Index>(std::min<std::size_t>(kPoseBlock, size() - i));
    visit(Eigen::Map<const Eigen::MatrixXf>(values_.data() + i * names_.size(), n, columns).cast<double>());
  }
}

void PoseSet::save(const std::filesystem::path& file) const {
  const Json header{
      {"format", "sinew.pose_set"}, {"version", 1}, {"source", source_}, {"coordinates", names_}, {"count", size()}};
  const std::string text = jsonText(header);
  const auto header_bytes = static_cast<std::uint32_t>(text.size());
  std::string content{kMagic, kMagicBytes};
  content.append(reinterpret_cast<const char*>(&header_bytes), sizeof header_bytes);
  content += text;
  content.append(reinterpret_cast<const char*>(values_.data()), values_.size() * sizeof(float));
  writeFileAtomically(file, content);
}

PoseFileHeader readPoseFileHeader(const std::filesystem::path& file, const Skeleton& skeleton) {
  const PoseFile pf = openPoseFile(file, skeleton);
  return {pf.source, pf.count};
}

void visitPoseFile(const std::filesystem::path& file, const Skeleton& skeleton, const PoseVisitor& visit) {
  PoseFile pf = openPoseFile(file, skeleton);
  const Eigen::Index n = skeleton.coordinateCount();
  for (std::size_t i = 0; i < pf.count; i += kPoseBlock) {
    Eigen::MatrixXf block(n, static_cast<Eigen::Index>(std::min<std::size_t>(kPoseBlock, pf.count - i)));
    pf.in.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(block.size() * sizeof(float)));
    if (!pf.in) throw InputError{{pf.where, "postures", "readable data", "a read error"}};
    if (!block.allFinite())
      throw InputError{{pf.where, "postures " + std::to_string(i + 1) + " ff.", "finite numbers", "others"}};
    visit(block.cast<double>());
  }
}

PoseSet loadPoseSet(const std::filesystem::path& file, const Skeleton& skeleton) {
  PoseSet set{skeleton, openPoseFile(file, skeleton).source};
  visitPoseFile(file, skeleton, [&](const Eigen::MatrixXd& postures) {
    for (const double x : postures.reshaped()) set.values_.push_back(static_cast<float>(x));
  });
  return set;
}

PoseSet withMirrorImages(const PoseSet& set, const Skeleton& skeleton) {
  const PoseMirror mirror{skeleton};
  PoseSet doubled{skeleton, set.source() + "; mirrored"};
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Posture q = set.posture(i);
    doubled.add(q);
    doubled.add(mirror(q));
  }
  return doubled;
}

PoseSet subsampled(const PoseSet& set, int step, const Skeleton& skeleton) {
  require(step >= 1, "subsampled: a step of at least 1");
  PoseSet part{skeleton, set.source() + "; every " + std::to_string(step) + ". posture"};
  for (std::size_t i = 0; i < set.size(); i += static_cast<std::size_t>(step)) part.add(set.posture(i));
  return part;
}

PoseSet withoutOutliers(const PoseSet& set, const Skeleton& skeleton, double tolerance_rad, std::size_t& rejected) {
  Skeleton widest = skeleton;
  for (Coordinate& c : widest.coordinates) {
    c.stop_min_rad = c.athlete_min_rad - tolerance_rad;
    c.stop_max_rad = c.athlete_max_rad + tolerance_rad;
  }
  for (Joint& joint : widest.joints) joint.edited = {};
  PoseSet kept{skeleton, set.source() + "; without outliers"};
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Posture q = set.posture(i);
    if (q.allFinite() &&
        std::ranges::all_of(stopMargins(widest, q), [](const ConstraintMargin& m) { return m.holds(); }))
      kept.add(q);
  }
  rejected = set.size() - kept.size();
  return kept;
}

}  // namespace sinew
