#pragma once
#include "app/cli/support/session.h"

namespace sinew {

/// Runs one command without a window: `sinew COMMAND ...`. Results on stdout, everything else on stderr.
/// @returns the exit status of docs/command_line.md. Throws nothing.
int runCli(int argc, const char* const* argv, ReportWriter write_report);

}  // namespace sinew
