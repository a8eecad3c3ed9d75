#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Instruction sets that the kernels are compiled for: every x86-64 (2 doubles in a register), x86-64-v3 (AVX2 and
/// FMA: 4), x86-64-v4 (AVX-512: 8). On other processors Baseline is the only one.
enum class Isa { Baseline, V3, V4 };

/// "baseline", "v3", "v4".
std::string_view isaName(Isa isa);
/// Those that this processor and operating system can run, narrowest first; never empty.
std::vector<Isa> supportedIsas();
/// The widest supported, or what the environment variable SINEW_ISA names.
/// @throws InputError if it names none, or one that this processor does not have.
Isa chosenIsa();

/// Postures in one register.
struct KernelLanes {
  int doubles = 0, floats = 0;
  int single = 1;  ///< where one posture is evaluated alone
};
KernelLanes kernelLanes(Isa isa);

}  // namespace sinew
