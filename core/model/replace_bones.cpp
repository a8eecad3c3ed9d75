#include "core/model/replace_bones.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/geometry/mesh_check.h"
#include "core/geometry/mesh_distance.h"
#include "core/muscle/muscle_path.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kReach_m = 0.030;        // of a bone: path points further away are not guided by its surface
constexpr double kLargestStep_m = 0.010;  // an attachment that moves further deserves a look
constexpr double kSameCenter_m = 1e-6;    // a landmark that coincides with a joint centre names it
constexpr double kLargestSize = 4;        // ratio of sizes: a wrong unit is off by 10 at least

std::string millimetres(double value_m) {
  return fixed(1e3 * value_m, 1) + " mm";
}

double diagonal_m(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& v : mesh.vertices) box.extend(v);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Welded, closed and turned outwards.
TriangleMesh soundMesh(const SuppliedBone& supplied, const BoneMesh& old, Warnings& warnings) {
  TriangleMesh mesh = welded(supplied.mesh);
  const MeshDefects defects = meshDefects(mesh);
  if (mesh.triangles.empty() || !defects.closed())
    throw InputError{{supplied.bone, "surface", "a closed surface",
                      mesh.triangles.empty()
                          ? "no triangles"
                          : std::to_string(defects.open_edges) + " open edges and " +
                                std::to_string(defects.shared_edges) + " edges of more than two triangles"}};
  const double ratio = diagonal_m(mesh) / diagonal_m(old.mesh);
  if (!(ratio < kLargestSize && ratio > 1 / kLargestSize))
    throw InputError{{supplied.bone, "size",
                      "about " + millimetres(diagonal_m(old.mesh)) + " across; is the unit right?",
                      millimetres(diagonal_m(mesh))}};
  if (!defects.sound()) {
    mesh = turnedOutwards(mesh);
    warnings.push_back({"bone_surface_turned", supplied.bone + ": some triangles faced inwards and were turned"});
  }
  return mesh;
}

using Pairs = std::vector<std::pair<int, Eigen::Vector3d>>;  // landmark of the model, p_S

/// The point of `pairs` that is the segment's own origin, if any.
const std::pair<int, Eigen::Vector3d>* originAmong(const Skeleton& s, const Pairs& pairs) {
  const auto found = std::ranges::find_if(
      pairs, [&](const auto& pair) { return s.landmarks[std::size_t(pair.first)].p_BL.norm() < kSameCenter_m; });
  return found == pairs.end() ? nullptr : &*found;
}

SegmentFit fitSegment(const Skeleton& s, int segment, const Pairs& pairs) {
  SegmentFit fit;
  fit.segment = s.segments[std::size_t(segment)].name;
  fit.landmarks = int(pairs.size());
  if (pairs.empty()) return fit;
  const auto n = Eigen::Index(pairs.size());
  Eigen::Matrix3Xd p_S(3, n), p_B(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    p_S.col(i) = pairs[std::size_t(i)].second;
    p_B.col(i) = s.landmarks[std::size_t(pairs[std::size_t(i)].first)].p_BL;
  }
  const auto spread = [&](const Eigen::Matrix3Xd& p) {  // the second largest: 0 on a line
    const Eigen::Matrix3Xd centred = p.colwise() - p.rowwise().mean();
    return Eigen::JacobiSVD<Eigen::Matrix3Xd>{centred}.singularValues()[1] / std::sqrt(double(n));
  };
  constexpr double kLeastSpread_m = 0.003;
  if (n < 3 || spread(p_S) < kLeastSpread_m || spread(p_B) < kLeastSpread_m)
    throw InputError{{fit.segment, "landmarks", "three or more that do not lie in a line", std::to_string(n)}};
  fit.X_BS = RigidTransform{Eigen::umeyama(p_S, p_B, false)};
  if (const auto* origin = originAmong(s, pairs)) fit.X_BS.translation() = -(fit.X_BS.linear() * origin->second);
  fit.rms_m = std::sqrt(((fit.X_BS * p_S) - p_B).squaredNorm() / double(n));
  return fit;
}

/// Landmarks and the joints that they name take their new places.
void moveLandmarks(Skeleton& s, int segment, const RigidTransform& X_BS, const Pairs& pairs,
                   std::vector<MovedJoint>& joints) {
  for (const auto& [index, p_S] : pairs) {
    Landmark& landmark = s.landmarks[std::size_t(index)];
    const Eigen::Vector3d old = landmark.p_BL, now = X_BS * p_S;
    landmark.p_BL = now;
    for (Joint& joint : s.joints) {
      if (joint.parent != segment || (joint.X_PJ.translation() - old).norm() > kSameCenter_m) continue;
      joint.X_PJ.translation() = now;
      joints.push_back({joint.name, (now - old).norm()});
    }
    for (PatellaDriver& patella : s.patellae)
      if (patella.femur == segment && (patella.p_FK - old).norm() < kSameCenter_m) patella.p_FK = now;
  }
}

/// Distances to the bones of one segment, before and after.
struct SegmentSurfaces {
  struct Bone {
    std::string name;
    std::unique_ptr<const MeshDistance> before, after;  ///< after: null if not replaced
  };
  std::vector<Bone> bones;

  const Bone* nearest(const Eigen::Vector3d& p) const {
    const auto closer = [&](const Bone& a, const Bone& b) {
      return std::abs(a.before->nearest(p).distance_m) < std::abs(b.before->nearest(p).distance_m);
    };
    const auto found = std::ranges::min_element(bones, closer);
    return found == bones.end() ? nullptr : &*found;
  }
};

/// `p` moved to where it has the same signed distance from the new surface as it had from the old.
Eigen::Vector3d resnapped(const Eigen::Vector3d& p, double distance_m, const MeshDistance& surface) {
  const MeshDistance::Nearest nearest = surface.nearest(p);
  Eigen::Vector3d outwards = p - nearest.point;
  if (nearest.distance_m < 0) outwards = -outwards;
  constexpr double kOnSurface_m = 1e-7;
  outwards = outwards.norm() > kOnSurface_m ? outwards.normalized() : nearest.normal;
  return nearest.point + distance_m * outwards;
}

/// Index of a bone by name. @throws InputError with the nearest names.
std::size_t boneIndex(const std::vector<BoneMesh>& bones, const std::string& name) {
  const auto found = std::ranges::find(bones, name, &BoneMesh::bone);
  if (found != bones.end()) return std::size_t(found - bones.begin());
  std::vector<std::string> known;
  for (const auto& bone : bones) known.push_back(bone.bone);
  throw InputError{{"supplied bones", "name", "a bone of the model", "'" + name + "'" + didYouMean(name, known)}};
}

/// Supplied landmarks by segment; every segment with a supplied bone has an entry.
std::map<int, Pairs> pairsBySegment(const Model& model, const std::map<std::size_t, const SuppliedBone*>& chosen,
                                    const std::vector<SuppliedLandmark>& landmarks, Warnings& warnings) {
  std::map<int, Pairs> pairs;
  for (const auto& [index, bone] : chosen) pairs[(*model.bones)[index].segment];
  for (const auto& supplied : landmarks) {
    const int index = model.skeleton.landmarkIndex(supplied.name);
    const auto segment = pairs.find(model.skeleton.landmarks[std::size_t(index)].segment);
    if (segment == pairs.end()) {
      warnings.push_back({"landmark_without_bone", supplied.name + ": no bone of its segment is replaced; not used"});
      continue;
    }
    if (std::ranges::count(segment->second, index, &Pairs::value_type::first))
      throw InputError{{"supplied landmarks", supplied.name, "one line a landmark", "two"}};
    segment->second.emplace_back(index, supplied.p_S);
  }
  return pairs;
}

/// Moves the path points that a replaced bone guides. @return what moved.
std::vector<MovedAttachment> resnapPaths(const Model& before, Model& after,
                                         const std::map<int, SegmentSurfaces>& surfaces) {
  const auto X_WB = segmentPoses(before.skeleton, zeroPosture(before.skeleton));
  std::vector<MovedAttachment> moved;
  for (MusculotendonUnit& unit : after.musculature.units)
    for (std::size_t i = 0; i < unit.path.size(); ++i)
      for (const Anchor& anchor : unit.path[i].anchors) {
        const auto segment = surfaces.find(anchor.segment);
        const auto* bone = segment == surfaces.end() ? nullptr : segment->second.nearest(anchor.p_B);
        if (!bone || !bone->after) continue;
        const double distance_m = bone->before->nearest(anchor.p_B).distance_m;
        if (distance_m > kReach_m) continue;
        const Eigen::Vector3d step_B = resnapped(anchor.p_B, distance_m, *bone->after) - anchor.p_B;
        moved.push_back({unit.name, int(i), bone->name, step_B.norm()});
        const Eigen::Vector3d step_W = X_WB[std::size_t(anchor.segment)].linear() * step_B;
        for (Anchor& a : unit.path[i].anchors)  // a blended point moves as one
          a.p_B += X_WB[std::size_t(a.segment)].linear().transpose() * step_W;
        break;
      }
  return moved;
}

void scaleLengths(const Model& before, Model& after) {
  const auto X_WB = segmentPoses(before.skeleton, zeroPosture(before.skeleton));
  const auto X_WB_now = segmentPoses(after.skeleton, zeroPosture(after.skeleton));
  for (std::size_t u = 0; u < after.musculature.units.size(); ++u) {
    MusculotendonUnit& unit = after.musculature.units[u];
    const double ratio = pathLength(unit, X_WB_now) / pathLength(before.musculature.units[u], X_WB);
    unit.optimal_fiber_length_m *= ratio;
    unit.tendon_slack_length_m *= ratio;
  }
}

void warnOfLongSteps(BoneReplacement& result) {
  for (const SegmentFit& fit : result.fits)
    if (fit.rms_m > kLargestStep_m)
      result.warnings.push_back({"bone_fit_poor", fit.segment + ": landmarks lie " + millimetres(fit.rms_m) +
                                                      " (rms) from their places after the fit"});
  for (const MovedJoint& joint : result.joints)
    if (joint.moved_m > kLargestStep_m)
      result.warnings.push_back({"joint_moved", joint.joint + ": its centre moved " + millimetres(joint.moved_m)});
  for (const MovedAttachment& a : result.attachments)
    if (a.moved_m > kLargestStep_m)
      result.warnings.push_back({"attachment_moved", a.unit + ", path point " + std::to_string(a.point) + " on " +
                                                         a.bone + ": moved " + millimetres(a.moved_m)});
}

}  // namespace

BoneReplacement replaceBones(const Model& model, const std::vector<SuppliedBone>& supplied,
                             const std::vector<SuppliedLandmark>& landmarks) {
  BoneReplacement result;
  result.model = model;
  std::map<std::size_t, const SuppliedBone*> chosen;
  for (const auto& bone : supplied)
    if (!chosen.emplace(boneIndex(*model.bones, bone.bone), &bone).second)
      throw InputError{{"supplied bones", bone.bone, "one surface a bone", "two"}};

  const auto pairs = pairsBySegment(model, chosen, landmarks, result.warnings);
  std::map<int, RigidTransform> X_BS;
  for (const auto& [segment, list] : pairs) {
    result.fits.push_back(fitSegment(model.skeleton, segment, list));
    X_BS[segment] = result.fits.back().X_BS;
    moveLandmarks(result.model.skeleton, segment, X_BS[segment], list, result.joints);
  }

  std::map<int, SegmentSurfaces> surfaces;
  auto bones = std::make_shared<std::vector<BoneMesh>>(*model.bones);
  for (std::size_t i = 0; i < bones->size(); ++i) {
    BoneMesh& bone = (*bones)[i];
    if (!pairs.contains(bone.segment)) continue;
    SegmentSurfaces::Bone surface{bone.bone, std::make_unique<const MeshDistance>(bone.mesh), nullptr};
    if (const auto found = chosen.find(i); found != chosen.end()) {
      bone.mesh = soundMesh(*found->second, bone, result.warnings);
      for (auto& v : bone.mesh.vertices) v = X_BS[bone.segment] * v;
      bone.supplied = true;
      surface.after = std::make_unique<const MeshDistance>(bone.mesh);
    }
    surfaces[bone.segment].bones.push_back(std::move(surface));
  }
  result.model.bones = bones;
  result.attachments = resnapPaths(model, result.model, surfaces);
  scaleLengths(model, result.model);
  warnOfLongSteps(result);
  return result;
}

}  // namespace sinew
