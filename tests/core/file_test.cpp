#include "core/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/error.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

TEST(Sha256, AgreesWithThePublishedExample) {  // FIPS 180-2, appendix B.1
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(WriteFileAtomically, ReplacesAndLeavesNoTemporaryFile) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "a.txt", "first");
  writeFileAtomically(folder / "a.txt", "second");
  EXPECT_EQ(readFile(folder / "a.txt"), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder.path()}, {}), 1);
}

TEST(WriteFileAtomically, IsReadableForWhomTheUserAllowsIt) {
  using std::filesystem::perms;
  const test::TemporaryFolder folder;
  const auto modeOf = [&](const char* name) { return std::filesystem::status(folder / name).permissions(); };
  const mode_t before = ::umask(077);
  writeFileAtomically(folder / "private.txt", "a");
  ::umask(022);
  writeFileAtomically(folder / "public.txt", "a");
  writeFileAtomically(folder / "private.txt", "b");
  ::umask(before);
  EXPECT_EQ(modeOf("private.txt"), perms{0600});
  EXPECT_EQ(modeOf("public.txt"), perms{0644});
}

TEST(WriteFileAtomically, KeepsTheOldFileWhenItCannotWrite) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "target");
  writeFileAtomically(folder / "target/inside", "old");
  EXPECT_THROW(writeFileAtomically(folder / "target", "new"), InputError);  // a folder cannot be replaced
  EXPECT_EQ(readFile(folder / "target/inside"), "old");
}

TEST(ReadFile, RefusesWhatIsMissingOrTooLarge) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(readFile(folder / "missing"), InputError);
  writeFileAtomically(folder / "big", std::string(100, 'x'));
  EXPECT_THROW(readFile(folder / "big", 99), InputError);
}

}  // namespace
}  // namespace sinew
