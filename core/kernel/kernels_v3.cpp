// Compiled for x86-64-v3: AVX2 and FMA; see CMakeLists.txt.
#include "core/kernel/kernels_internal.h"

namespace sinew {

constinit const KernelTable kKernelsV3 = kernelTable<32>();

}  // namespace sinew
