#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/csv_table.h"
#include "core/geometry/bone_shapes.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

/// How far muscle ends lie from the bones of their segment; printed bone by bone.
TEST(AttachmentDistance, MostMuscleEndsLieNearABone) {
  const auto shapes = loadBoneShapes(test::resourceDir());
  const CsvTable table{test::resourceDir() / "muscles" / "muscle_paths.csv",
                       "sinew.muscle_paths",
                       1,
                       {"role", "anchors", "x_m", "y_m", "z_m"}};
  std::map<std::string, std::array<int, 2>> count;  // by segment: all, near
  std::array<int, 2> total{};
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const std::string& segment = table.text(row, "anchors");
    if (table.text(row, "role") == "via") continue;
    const Eigen::Vector3d p{table.number(row, "x_m"), table.number(row, "y_m"), table.number(row, "z_m")};
    double nearest = 1;
    for (const auto& shape : shapes)
      if (shape.segment == segment) nearest = std::min(nearest, std::abs(shape.distance(p)));
    if (nearest == 1) continue;
    const bool near = nearest < 0.005;
    for (auto* c : {&count[segment], &total}) {
      ++(*c)[0];
      (*c)[1] += near;
    }
  }
  for (const auto& [name, c] : count)
    std::printf("%-12s %3d of %3d muscle ends within 5 mm\n", name.c_str(), c[1], c[0]);
  ASSERT_GT(total[0], 200);
  EXPECT_GT(total[1], 0.6 * total[0]);
}

}  // namespace
}  // namespace sinew
