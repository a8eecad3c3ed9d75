#include "core/model/bone_contacts.h"

#include <algorithm>

namespace sinew {

BoneContacts::BoneContacts(const Model& model, const BoneDistances& bones, std::span<const Posture> postures,
                           double depth_m)
    : model_(model), bones_(bones), depth_m_(depth_m) {
  standing_X_WB_ = segmentPoses(model.skeleton, zeroPosture(model.skeleton));
  for (const Posture& q : postures) X_WB_.push_back(segmentPoses(model.skeleton, q));
}

/// Does a vertex of `bone` come nearer to the surface of `other` than this? Negative: deeper inside.
bool BoneContacts::comeWithin(std::size_t bone, std::size_t other, const std::vector<RigidTransform>& X_WB,
                              double gap_m) const {
  const auto& from = bones_.bones()[bone];
  const auto& to = bones_.bones()[other];
  const RigidTransform X_TF = X_WB[std::size_t(to.segment)].inverse() * X_WB[std::size_t(from.segment)];
  const double reach_m = std::max(0.0, gap_m);
  // Box of `bone` in the frame of `other`.
  const Eigen::Vector3d middle_T = X_TF * (0.5 * (from.low_B + from.high_B));
  const Eigen::Vector3d half_T = X_TF.linear().cwiseAbs() * (0.5 * (from.high_B - from.low_B));
  if (((middle_T + half_T - to.low_B).array() < -reach_m).any() ||
      ((middle_T - half_T - to.high_B).array() > reach_m).any())
    return false;
  return std::ranges::any_of((*model_.bones)[bone].mesh.vertices, [&](const Eigen::Vector3d& p_F) {
    const Eigen::Vector3d p_T = X_TF * p_F;
    if (((p_T - to.low_B).array() < -reach_m).any() || ((p_T - to.high_B).array() > reach_m).any()) return false;
    return gap_m < 0 ? to.distance.depth_m(p_T) > -gap_m : to.distance.nearest(p_T).distance_m < gap_m;
  });
}

/// By posture: do bones of these two segments collide?
const std::vector<bool>& BoneContacts::collisions(int segment, int other) {
  const auto [at, made] = by_segments_.try_emplace({segment, other}, X_WB_.size(), false);
  if (!made) return at->second;
  const auto& bones = bones_.bones();
  for (std::size_t i = 0; i < bones.size(); ++i)
    for (std::size_t j = 0; j < bones.size(); ++j) {
      if (bones[i].segment != segment || bones[j].segment != other) continue;
      if (comeWithin(i, j, standing_X_WB_, depth_m_) || comeWithin(j, i, standing_X_WB_, depth_m_)) continue;
      for (std::size_t k = 0; k < X_WB_.size(); ++k)
        if (!at->second[k])
          at->second[k] = comeWithin(i, j, X_WB_[k], -depth_m_) || comeWithin(j, i, X_WB_[k], -depth_m_);
    }
  return at->second;
}

std::vector<int> BoneContacts::posturesWithBonesApart(const MusculotendonUnit& unit) {
  const auto spanned = spannedSegments(model_.skeleton, unit);
  std::vector<bool> collide(X_WB_.size(), false);
  for (int a = 0; a < int(spanned.size()); ++a)
    for (int b = a + 1; b < int(spanned.size()); ++b) {
      if (!spanned[std::size_t(a)] || !spanned[std::size_t(b)]) continue;
      const auto& these = collisions(a, b);
      for (std::size_t k = 0; k < these.size(); ++k) collide[k] = collide[k] || these[k];
    }
  std::vector<int> apart;
  for (std::size_t k = 0; k < collide.size(); ++k)
    if (!collide[k]) apart.push_back(int(k));
  return apart;
}

}  // namespace sinew
