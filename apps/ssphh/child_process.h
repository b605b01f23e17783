#pragma once
/// Another program, run to its end.

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <ssphh/core/control.h>

namespace ssphh::app {

/// Runs `command` (found on PATH) with its output appended to `log`, and waits. Ctrl-C and the time limit end
/// it with SIGKILL, its own children included. Throws Error when it cannot be started, exits with another
/// code than 0, is killed by a signal or exceeds the limit: the message names the log and shows its last
/// lines. Throws Cancelled on Ctrl-C.
void run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                 std::chrono::seconds limit, const Control& control);

/// Whether a program of this name is on PATH.
bool program_exists(const std::string& name);

}  // namespace ssphh::app
