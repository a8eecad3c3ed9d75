#pragma once
#include <filesystem>

namespace sinew {

/// Opens the window and runs until it is closed; `argv[1]`, if given, is the folder of a case to open. Returns the
/// exit status. Needs a display. @throws InputError, before anything is shown, if that folder holds no case.
int runWindow(int argc, char** argv, const std::filesystem::path& resource_dir);

}  // namespace sinew
