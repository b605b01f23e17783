#pragma once
/// Another program, run to its end.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <ssphh/core/control.h>

namespace ssphh::app {

/// What a program took.
struct ProgramUsage {
  double seconds = 0;            ///< wall time
  double cpu_seconds = 0;        ///< of all its threads, user and system
  std::uint64_t peak_bytes = 0;  ///< largest resident set
};

/// Runs `command` (found on PATH; the folder it is in comes first on the program's own PATH, so that what is
/// installed beside it is what it finds) with its output appended to `log` (its standard output alone to
/// `result`, if that is not empty), and waits. Ctrl-C and the time limit end it with SIGKILL, its own
/// children included. Throws Error when it cannot be started, exits with another code than 0, is killed by a
/// signal or exceeds the limit: the message names the log and shows its last lines. Throws Cancelled on
/// Ctrl-C.
ProgramUsage run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                         std::chrono::seconds limit, const Control& control,
                         const std::filesystem::path& result = {});

/// The program of this name in the first folder of PATH that has one, links followed; empty: none has.
std::filesystem::path find_program(const std::string& name);

}  // namespace ssphh::app
