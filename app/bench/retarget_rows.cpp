#include "app/bench/retarget_rows.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "app/bench/dart_routing.h"
#include "app/experiments/characters.h"
#include "app/experiments/experiment_shapes.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

constexpr std::uint64_t kSeed = 7;

BenchRow row(int number, const std::string& id, const std::string& task, const std::string& item, double target,
             const std::string& peer) {
  return {.number = number,
          .id = id,
          .task = task,
          .item = item,
          .real = "double",
          .lanes = 1,
          .target_ratio = target,
          .peer_name = peer,
          .ours = {},
          .peer = std::nullopt};
}

/// Units that stand for all in repeated measurements of something slow.
struct UnitSample {
  std::vector<std::size_t> units;
  double share = 0;  ///< of the time that all take
};

/// Some take a thousand times as long as others, so that the share is found by a descent of every unit.
UnitSample sampleOf(DartRouting& dart, DartRouting::Differences differences, std::size_t all) {
  constexpr std::size_t kEvery = 12;
  UnitSample sample;
  double some_s = 0, all_s = 0;
  for (std::size_t u = 0; u < all; ++u) {
    const std::clock_t before = std::clock();
    dart.descend(u, differences);
    const double taken_s = double(std::clock() - before) / CLOCKS_PER_SEC;
    all_s += taken_s;
    if (u % kEvery != kEvery / 2) continue;
    some_s += taken_s;
    sample.units.push_back(u);
  }
  sample.share = some_s / all_s;
  return sample;
}

}  // namespace

RetargetRows::RetargetRows(const std::filesystem::path& resource_dir, const std::vector<int>& wanted)
    : reference_{loadRetargetReference(resource_dir)}, asymmetric_{randomShapes(1, {}, kSeed).front()} {
  slider_.sides[0].femur.elongation = 1.05;
  const auto asked = [&](int number) { return wanted.empty() || std::ranges::count(wanted, number) > 0; };
  if (asked(7)) addRouting();
  if (asked(8)) addPeakTorque();
  if (asked(14)) addWholeBody();
}

void RetargetRows::addRouting() {
  const auto naive = std::make_shared<const Model>(deformedModel(reference_->model(), asymmetric_));
  const auto routed = [reference = reference_, naive](RetargetMethod method) {
    Model model = *naive;
    return route(reference->model(), reference->routing(), model, {.method = method}).units;
  };
  const std::vector<UnitRouting> solved = routed(RetargetMethod::Sinew);
  const EnergyTotals ours = energyTotals(solved), paper = energyTotals(routed(RetargetMethod::Paper));
  if (!(ours.end <= paper.end)) throw std::runtime_error{"row 7 is not timed: the descent reaches a lower energy"};

  const Workload work{[routed] { routed(RetargetMethod::Sinew); }, 1};
  BenchRow descent = row(7, "7", "routing of all units, body without symmetry", "body", 6,
                         "gradient descent, finite differences, our energy");
  descent.ours = work;
  descent.peer = Workload{[routed] { routed(RetargetMethod::Paper); }, 1};
  rows_.push_back(descent);

  addRoutingOnDart(naive, work, solved);
}

/// The paper's method on a physics engine, as it is written down and with all differences of a gradient in one pass.
void RetargetRows::addRoutingOnDart(const std::shared_ptr<const Model>& naive, const Workload& ours,
                                    const std::vector<UnitRouting>& solved) {
  struct Way {
    DartRouting::Differences differences;
    std::string id, name;
  };
  const auto dart = std::make_shared<DartRouting>(*reference_, *naive);
  for (std::size_t u = 0; dart->isThere() && u < solved.size(); ++u)
    if (std::abs(dart->startEnergy(u) - solved[u].start.paper({})) > 1e-9 * (1 + solved[u].start.paper({})))
      throw std::runtime_error{"row 7 is not timed: the energy of " + solved[u].unit + " differs with DART"};
  for (const Way& way : {Way{DartRouting::Differences::OneByOne, "7 DART", "every energy by itself"},
                         Way{DartRouting::Differences::OnePass, "7 DART, one pass", "all differences in one pass"}}) {
    BenchRow on_dart =
        row(7, way.id, "the same", "body", 80, DartPeer::version() + ", gradient descent, " + way.name);
    on_dart.ours = ours;
    if (dart->isThere()) {
      const UnitSample sample = sampleOf(*dart, way.differences, solved.size());
      on_dart.peer = Workload{[dart, sample, differences = way.differences] {
                                for (const std::size_t u : sample.units) dart->descend(u, differences);
                              },
                              sample.share};
      on_dart.peer_name += "; " + std::to_string(sample.units.size()) + " of " + std::to_string(solved.size()) +
                           " units measured, " + std::to_string(std::lround(100 * sample.share)) +
                           " % of what all take once";
    }
    rows_.push_back(on_dart);
  }
}

void RetargetRows::addPeakTorque() {
  auto model = std::make_shared<Model>(retarget(*reference_, asymmetric_, {.peak_torque = false}).model);
  const auto geometryOf = [reference = reference_](const Model& m) {
    return TorqueGeometry{m, reference->torquePostures(), reference->unitsOfMotion(), reference->motions()};
  };
  const auto geometry = std::make_shared<const TorqueGeometry>(geometryOf(*model));
  const auto optimized = [reference = reference_, model, geometry] {
    Musculature musculature = model->musculature;
    return optimizePeakTorque(*geometry, reference->motions(), reference->peakThetas(), musculature);
  };
  // A gradient by finite differences needs the torques once a ratio.
  const double evaluations = double(optimized().iterations) * double(model->musculature.units.size() + 1);
  BenchRow peak = row(
      8, "8", "peak torque: all ratios", "optimisation", 1000,
      "finite differences, geometry recomputed: 1 evaluation measured, times " + std::to_string(long(evaluations)));
  peak.items = evaluations;
  peak.ours = {[optimized] { optimized(); }, evaluations};
  peak.peer = Workload{[geometryOf, model] {
                         const TorqueGeometry again = geometryOf(*model);
                         for (std::size_t m = 0; m < again.motionCount(); ++m)
                           motionTorque_Nm(model->musculature, again, m);
                       },
                       1};
  rows_.push_back(peak);
}

void RetargetRows::addWholeBody() {
  const auto body = [reference = reference_](const ShapeParameters& shape, RetargetMethod method) {
    return Workload{[reference, shape, method] { retarget(*reference, shape, {.method = method}); }, 1};
  };
  const std::string peer = "routing and ratios by gradient descent";
  BenchRow whole =
      row(14, "14 retargeting", "shape, routing, lengths over 72,000 postures, peak torque; body without symmetry",
          "body", 10, peer);
  whole.ours = body(asymmetric_, RetargetMethod::Sinew);
  whole.peer = body(asymmetric_, RetargetMethod::Paper);
  BenchRow equal_sides = row(14, "14 equal sides", "the same, both sides alike", "body", 10, peer);
  const ShapeParameters femora = withFemora(1.2, 0.2);
  equal_sides.ours = body(femora, RetargetMethod::Sinew);
  equal_sides.peer = body(femora, RetargetMethod::Paper);
  BenchRow femur = row(14, "14 one femur", "the same, one femur longer by 5 %, everything anew", "body", 10, peer);
  femur.ours = body(slider_, RetargetMethod::Sinew);
  femur.peer = body(slider_, RetargetMethod::Paper);
  ShapeParameters before = slider_;
  before.sides[0].femur.elongation = 1.02;
  const auto previous = std::make_shared<const Retargeted>(retarget(*reference_, before));
  BenchRow slider = row(14, "14 slider", "that femur after a drag from 2 to 5 %", "body", 10, peer);
  slider.ours = {
      [reference = reference_, shape = slider_, previous] { retarget(*reference, shape, {}, {}, *previous); }, 1};
  slider.peer = femur.peer;
  rows_.insert(rows_.end(), {whole, equal_sides, femur, slider});
}

}  // namespace sinew
