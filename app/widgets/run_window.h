#pragma once
#include <filesystem>

namespace sinew {

/// Opens the window and runs until it is closed; `argv[1]`, if given, is the folder of a case to open. Returns the
/// exit status. Needs a display.
int runWindow(int argc, char** argv, const std::filesystem::path& resource_dir);

}  // namespace sinew
