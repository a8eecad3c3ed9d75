#include "core/geometry/isosurface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/parallel_rows.h"

namespace sinew {
namespace {

using Index = std::int64_t;

struct Lattice {
  Eigen::Vector3d lower;
  double cell_m;
  std::array<Index, 3> points;
  std::vector<float> values;

  Index at(const std::array<Index, 3>& i) const { return (i[2] * points[1] + i[1]) * points[0] + i[0]; }
  Eigen::Vector3d position(Index index) const {
    const Index x = index % points[0], y = index / points[0] % points[1], z = index / points[0] / points[1];
    return lower + cell_m * Eigen::Vector3d{double(x), double(y), double(z)};
  }
};

/// The margin of one cell around the box counts as outside, which closes the surface.
Lattice sampled(const std::function<double(const Eigen::Vector3d&)>& field, const Eigen::Vector3d& lower,
                const Eigen::Vector3d& upper, double cell_m) {
  Lattice lattice{lower - Eigen::Vector3d::Constant(cell_m), cell_m, {}, {}};
  for (int k = 0; k < 3; ++k) lattice.points[std::size_t(k)] = Index(std::ceil((upper[k] - lower[k]) / cell_m)) + 3;
  lattice.values.assign(std::size_t(lattice.points[0] * lattice.points[1] * lattice.points[2]), 1.0F);
  forEachRowBand(int(lattice.points[2]), [&](RowRange layers) {
    for (Index z = std::max(layers.begin, 1); z < std::min<Index>(layers.end, lattice.points[2] - 1); ++z)
      for (Index y = 1; y + 1 < lattice.points[1]; ++y)
        for (Index x = 1; x + 1 < lattice.points[0]; ++x) {
          const Index i = lattice.at({x, y, z});
          lattice.values[std::size_t(i)] = float(field(lattice.position(i)));
        }
  });
  return lattice;
}

class Polygonizer {
 public:
  explicit Polygonizer(const Lattice& lattice) : lattice_{lattice} {}

  /// Corners of a tetrahedron with positive volume.
  void add(std::array<Index, 4> corner) {
    const auto inside = [&](Index i) { return lattice_.values[std::size_t(i)] < 0; };
    const auto count = std::count_if(corner.begin(), corner.end(), inside);
    if (count == 0 || count == 4) return;
    // An even permutation that puts the inside corners first keeps the orientation.
    int swaps = 0;
    for (int pass = 0; pass < 3; ++pass)
      for (std::size_t i = 0; i < 3; ++i)
        if (!inside(corner[i]) && inside(corner[i + 1])) {
          std::swap(corner[i], corner[i + 1]);
          ++swaps;
        }
    if (swaps % 2) std::swap(corner[count == 3 ? 0 : 2], corner[count == 3 ? 1 : 3]);
    const auto [a, b, c, d] = corner;
    if (count == 1) {
      triangle(crossing(a, b), crossing(a, c), crossing(a, d));
    } else if (count == 3) {
      triangle(crossing(a, d), crossing(b, d), crossing(c, d));
    } else {
      triangle(crossing(a, c), crossing(a, d), crossing(b, d));
      triangle(crossing(a, c), crossing(b, d), crossing(b, c));
    }
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  void triangle(std::int32_t a, std::int32_t b, std::int32_t c) { mesh_.triangles.push_back({a, b, c}); }

  std::int32_t crossing(Index inside, Index outside) {
    const Index low = std::min(inside, outside), high = std::max(inside, outside);
    const auto [entry, is_new] =
        known_.try_emplace(low * Index(lattice_.values.size()) + high, std::int32_t(mesh_.vertices.size()));
    if (is_new) {
      const double a = double(lattice_.values[std::size_t(low)]), b = double(lattice_.values[std::size_t(high)]);
      const Eigen::Vector3d p = lattice_.position(low);
      mesh_.vertices.push_back(p + a / (a - b) * (lattice_.position(high) - p));
    }
    return entry->second;
  }

  const Lattice& lattice_;
  TriangleMesh mesh_;
  std::unordered_map<Index, std::int32_t> known_;
};

}  // namespace

TriangleMesh isosurface(const std::function<double(const Eigen::Vector3d&)>& field, const Eigen::Vector3d& lower,
                        const Eigen::Vector3d& upper, double cell_m) {
  const Lattice lattice = sampled(field, lower, upper, cell_m);
  Polygonizer polygonizer{lattice};
  // Kuhn: one tetrahedron for each order of walking along the three edges from corner to opposite corner.
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (Index z = 0; z + 1 < lattice.points[2]; ++z)
    for (Index y = 0; y + 1 < lattice.points[1]; ++y)
      for (Index x = 0; x + 1 < lattice.points[0]; ++x)
        for (int order = 0; order < 6; ++order) {
          std::array<Index, 3> walker{x, y, z};
          std::array<Index, 4> corner{lattice.at(walker), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++walker[std::size_t(kOrders[order][step])];
            corner[step + 1] = lattice.at(walker);
          }
          if (order >= 3) std::swap(corner[1], corner[2]);  // odd orders are mirror images
          polygonizer.add(corner);
        }
  return polygonizer.take();
}

}  // namespace sinew
