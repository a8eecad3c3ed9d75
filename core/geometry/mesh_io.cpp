#include "core/geometry/mesh_io.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/error.h"
#include "core/file.h"

namespace sinew {
namespace {

static_assert(std::endian::native == std::endian::little, "mesh files are little endian");
constexpr std::string_view kMagic = "SINEWMSH";
constexpr std::uint32_t kVersion = 1;
constexpr double kSteps = 65535;

template <class T>
void put(std::string& out, T value) {
  static_assert(std::is_trivially_copyable_v<T>);
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}
void put(std::string& out, const std::string& text) {
  put(out, static_cast<std::uint16_t>(text.size()));
  out += text;
}

/// Reads forward through a file's bytes; never past the end.
class ByteReader {
 public:
  ByteReader(const std::string& bytes, std::string where) : bytes_{bytes}, where_{std::move(where)} {}
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  std::string text(std::size_t size) { return {take(size), size}; }
  bool atEnd() const { return position_ == bytes_.size(); }
  /// A count of things of `size` bytes that the rest of the file can hold.
  std::uint32_t count(std::size_t size) {
    const auto n = get<std::uint32_t>();
    if (n > (bytes_.size() - position_) / size) truncated();
    return n;
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size() - position_) truncated();
    position_ += size;
    return bytes_.data() + position_ - size;
  }
  [[noreturn]] void truncated() const {
    throw InputError{{where_, "byte " + std::to_string(position_), "more data", "end of file"}};
  }
  const std::string& bytes_;
  std::string where_;
  std::size_t position_ = 0;
};

void putMesh(std::string& out, const NamedMesh& named) {
  const TriangleMesh& mesh = named.mesh;
  require(!mesh.vertices.empty(), "a stored mesh has vertices");
  put(out, named.bone);
  put(out, named.segment);
  put(out, static_cast<std::uint32_t>(mesh.vertices.size()));
  put(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  Eigen::Vector3d lower = mesh.vertices.front(), upper = lower;
  for (const auto& v : mesh.vertices) {
    lower = lower.cwiseMin(v);
    upper = upper.cwiseMax(v);
  }
  for (const double x : {lower.x(), lower.y(), lower.z(), upper.x(), upper.y(), upper.z()})
    put(out, static_cast<float>(x));
  const Eigen::Vector3d size = (upper - lower).cwiseMax(1e-9);
  for (const auto& v : mesh.vertices)
    for (int i = 0; i < 3; ++i)
      put(out, static_cast<std::uint16_t>(std::lround((v[i] - lower[i]) / size[i] * kSteps)));
  for (const auto& t : mesh.triangles)
    for (const auto index : t) put(out, static_cast<std::uint32_t>(index));
}

NamedMesh getMesh(ByteReader& in, const std::string& where) {
  NamedMesh named;
  named.bone = in.text(in.get<std::uint16_t>());
  named.segment = in.text(in.get<std::uint16_t>());
  const auto vertex_count = in.count(3 * sizeof(std::uint16_t));
  const auto triangle_count = in.count(3 * sizeof(std::uint32_t));
  Eigen::Vector3d lower, upper;
  for (Eigen::Vector3d* corner : {&lower, &upper})
    for (int i = 0; i < 3; ++i) (*corner)[i] = in.get<float>();
  if (!lower.allFinite() || !upper.allFinite())
    throw InputError{{where, named.bone, "a finite bounding box", "none"}};
  named.mesh.vertices.resize(vertex_count);
  for (auto& v : named.mesh.vertices)
    for (int i = 0; i < 3; ++i) v[i] = lower[i] + (upper[i] - lower[i]) * in.get<std::uint16_t>() / kSteps;
  named.mesh.triangles.resize(triangle_count);
  for (auto& t : named.mesh.triangles)
    for (auto& index : t) {
      const auto i = in.get<std::uint32_t>();
      if (i >= vertex_count)
        throw InputError{
            {where, named.bone, "a vertex index below " + std::to_string(vertex_count), std::to_string(i)}};
      index = static_cast<std::int32_t>(i);
    }
  return named;
}

}  // namespace

void writeMeshes(const std::vector<NamedMesh>& meshes, const std::filesystem::path& file) {
  std::string out{kMagic};
  put(out, kVersion);
  put(out, static_cast<std::uint32_t>(meshes.size()));
  for (const auto& mesh : meshes) putMesh(out, mesh);
  writeFileAtomically(file, out);
}

std::vector<NamedMesh> readMeshes(const std::filesystem::path& file) {
  const std::string bytes = readFile(file), where = file.string();
  ByteReader in{bytes, where};
  if (!bytes.starts_with(kMagic)) throw InputError{{where, "", "a mesh file (SINEWMSH)", "something else"}};
  in.text(kMagic.size());
  if (const auto version = in.get<std::uint32_t>(); version != kVersion)
    throw InputError{{where, "version", std::to_string(kVersion), std::to_string(version)}};
  std::vector<NamedMesh> meshes(in.count(12));
  for (auto& mesh : meshes) mesh = getMesh(in, where);
  if (!in.atEnd()) throw InputError{{where, "", "the end of the file after the last mesh", "more bytes"}};
  return meshes;
}

std::string objText(const TriangleMesh& mesh) {
  std::string text;
  for (const auto& v : mesh.vertices) text += fmt::format("v {:.7g} {:.7g} {:.7g}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

}  // namespace sinew
