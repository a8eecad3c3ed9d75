#include "core/kernel/batch.h"

#include "core/error.h"
#include "core/kernel/compiled_arrays_internal.h"

namespace sinew {
namespace {

constexpr std::size_t kRegisterDoubles = 8;  // of 64 bytes

void checkPostures(const CompiledModel& model, const PoseTable& postures) {
  require(postures.entryCount() == static_cast<std::size_t>(model.coordinateCount()) || postures.poseCount() == 0,
          "one entry a coordinate");
}

/// Tables are reused: a loop over many batches allocates once.
void fit(PoseTable& table, std::size_t poses, std::size_t entries) {
  if (table.poseCount() != poses || table.entryCount() != entries) table = PoseTable{poses, entries};
}

}  // namespace

const KernelTable& kernels(Isa isa) {
#ifdef SINEW_X86_64_KERNELS
  if (isa == Isa::V3) return kKernelsV3;
  if (isa == Isa::V4) return kKernelsV4;
#endif
  require(isa == Isa::Baseline, "kernels of another processor");
  return kKernelsBaseline;
}

KernelLanes kernelLanes(Isa isa) {
  return {kernels(isa).double_lanes, kernels(isa).float_lanes};
}

KernelScratch::KernelScratch(const CompiledModel& model)
    : memory_(scratchRegisters(model.arrays().view<double>()) * kRegisterDoubles) {}

void batchPoses(const CompiledModel& model, const PoseTable& postures, PoseTable& X_WB) {
  checkPostures(model, postures);
  fit(X_WB, postures.poseCount(), 12 * static_cast<std::size_t>(model.segmentCount()));
  KernelScratch scratch{model};
  const auto view = model.arrays().view<double>();
  const auto kernel = kernels(model.isa()).poses;
  for (std::size_t b = 0; b < postures.blockCount(); ++b)
    kernel(view, postures.block(b), scratch.get(), X_WB.block(b));
}

void batchLengths(const CompiledModel& model, const PoseTable& postures, PoseTable& lengths_m, Precision precision) {
  checkPostures(model, postures);
  fit(lengths_m, postures.poseCount(), static_cast<std::size_t>(model.unitCount()));
  KernelScratch scratch{model};
  const KernelTable& kernel = kernels(model.isa());
  const auto in_double = model.arrays().view<double>();
  const auto in_single = model.arrays().view<float>();
  for (std::size_t b = 0; b < postures.blockCount(); ++b)
    if (precision == Precision::Double)
      kernel.lengths(in_double, postures.block(b), scratch.get(), lengths_m.block(b));
    else
      kernel.lengths_float(in_single, postures.block(b), scratch.get(), lengths_m.block(b));
}

void batchGradients(const CompiledModel& model, const PoseTable& postures, PoseTable& lengths_m,
                    PoseTable& gradients) {
  checkPostures(model, postures);
  fit(lengths_m, postures.poseCount(), static_cast<std::size_t>(model.unitCount()));
  fit(gradients, postures.poseCount(), model.gradientCoordinate().size());
  KernelScratch scratch{model};
  const auto view = model.arrays().view<double>();
  const auto kernel = kernels(model.isa()).gradients;
  for (std::size_t b = 0; b < postures.blockCount(); ++b)
    kernel(view, postures.block(b), scratch.get(), lengths_m.block(b), gradients.block(b));
}

PostureKernel::PostureKernel(CompiledModel model)
    : model_{std::move(model)},
      scratch_(scratchRegisters(model_.arrays().view<double>()) * kRegisterDoubles),
      lengths_m_(static_cast<std::size_t>(model_.unitCount())),
      gradients_(model_.gradientCoordinate().size()) {}

void PostureKernel::evaluate(const Posture& posture) {
  require(posture.size() == model_.coordinateCount(), "one entry a coordinate");
  kernels(model_.isa())
      .single_gradients(model_.arrays().view<double>(), posture.data(), scratch_.data(), lengths_m_.data(),
                        gradients_.data());
}

}  // namespace sinew
