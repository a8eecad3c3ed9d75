#include "core/error.h"
#include "core/retarget/routing/body_bones_internal.h"

namespace sinew {

BodyBones::BodyBones(const Model& reference, const BoneDistances& distances, const Model& body)
    : distances_{distances}, reference_{*reference.bones}, body_{*body.bones}, bones_(distances.bones().size()) {
  require(body_.size() == bones_.size(), "BodyBones: the bones of the reference");
}

const MeshDistance& BodyBones::operator[](int bone) const {
  const auto b = static_cast<std::size_t>(bone);
  const MeshDistance& in_reference = distances_.bones()[b].distance;
  Lazy& lazy = bones_[b];
  std::call_once(lazy.once, [&] {
    if (const auto& vertices = body_[b].mesh.vertices; vertices != reference_[b].mesh.vertices)
      lazy.distance.emplace(in_reference.movedTo(vertices));
  });
  return lazy.distance ? *lazy.distance : in_reference;
}

}  // namespace sinew
