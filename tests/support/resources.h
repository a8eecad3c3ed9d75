#pragma once
#include <cstdlib>
#include <filesystem>

namespace sinew::test {

inline std::filesystem::path resourceDir() {
  return SINEW_RESOURCE_DIR;
}

/// Tables that tests compare with; part of the repository.
inline std::filesystem::path testDataDir() {
  return SINEW_TEST_DATA_DIR;
}

/// Folder of real files that are not part of the product; tests skip with a message when it is absent.
inline std::filesystem::path externalData() {
  const char* set = std::getenv("SINEW_EXTERNAL_DATA");
  return set ? set : SINEW_DEFAULT_EXTERNAL_DATA;
}

}  // namespace sinew::test

/// First line of a test that needs a real file.
#define SINEW_NEEDS_EXTERNAL(relative)                                   \
  const auto external_file = ::sinew::test::externalData() / (relative); \
  if (!std::filesystem::exists(external_file)) GTEST_SKIP() << external_file << " is not there"
