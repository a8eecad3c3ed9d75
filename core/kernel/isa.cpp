#include "core/kernel/isa.h"

#include <algorithm>
#include <cstdlib>

#include "core/error.h"

namespace sinew {
namespace {

bool hasV3() {
#if !defined(__x86_64__)
  return false;
#elif defined(__clang__)  // does not know the levels by name here
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#else
  return __builtin_cpu_supports("x86-64-v3");
#endif
}

bool hasV4() {
#if !defined(__x86_64__)
  return false;
#elif defined(__clang__)
  return hasV3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return __builtin_cpu_supports("x86-64-v4");
#endif
}

}  // namespace

std::string_view isaName(Isa isa) {
  constexpr std::string_view kNames[] = {"baseline", "v3", "v4"};
  return kNames[static_cast<int>(isa)];
}

std::vector<Isa> supportedIsas() {
  std::vector<Isa> isas{Isa::Baseline};
  if (hasV3()) isas.push_back(Isa::V3);
  if (hasV4()) isas.push_back(Isa::V4);
  return isas;
}

Isa chosenIsa() {
  const auto supported = supportedIsas();
  const char* wanted = std::getenv("SINEW_ISA");
  if (wanted == nullptr || *wanted == '\0') return supported.back();
  const auto found = std::ranges::find(supported, std::string_view{wanted}, isaName);
  if (found != supported.end()) return *found;
  std::string names;
  for (const Isa isa : supported) names += (names.empty() ? "" : ", ") + std::string{isaName(isa)};
  throw InputError{{"environment", "SINEW_ISA", "one of " + names, std::string{"'"} + wanted + "'"}};
}

}  // namespace sinew
