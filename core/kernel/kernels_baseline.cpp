// Compiled for every x86-64 processor (SSE2), and the only one on other processors; see CMakeLists.txt.
#include "core/kernel/kernels_internal.h"

namespace sinew {

constinit const KernelTable kKernelsBaseline = kernelTable<16>();

}  // namespace sinew
