// Compiled for x86-64-v4: AVX-512; see CMakeLists.txt.
#include "core/kernel/kernels_internal.h"

namespace sinew {

constinit const KernelTable kKernelsV4 = kernelTable<64>();

}  // namespace sinew
