#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "app/bench/bench_rows.h"
#include "core/retarget/routing/routing.h"

namespace sinew {

class RetargetReference;

/// Rows 7, 8 and the retargeting of row 14. All processors work; CPU times are those of all threads together.
class RetargetRows {
 public:
  /// Prepares the reference: seconds. @throws std::runtime_error as BenchRows.
  RetargetRows(const std::filesystem::path& resource_dir, const std::vector<int>& wanted);
  const std::vector<BenchRow>& rows() const { return rows_; }

 private:
  void addRouting();
  void addRoutingOnDart(const std::shared_ptr<const Model>& naive, const Workload& ours,
                        const std::vector<UnitRouting>& solved);
  void addPeakTorque();
  void addWholeBody();

  std::shared_ptr<const RetargetReference> reference_;
  ShapeParameters asymmetric_, slider_;
  std::vector<BenchRow> rows_;
};

}  // namespace sinew
