#pragma once
/// Options that the commands around probe files share.

#include <string>

#include <CLI/CLI.hpp>

#include <ssphh/gi/probe_file.h>

namespace ssphh::app {

/// Refuses a name that does not end as a probe file's does: wrong usage, before any work.
inline CLI::Validator probe_file_name() {
  return {[](std::string& name) -> std::string {
            try {
              gi::probe_file_format(name);
              return {};
            } catch (const Error& e) {
              return e.what();
            }
          },
          ".sphl|.sphl.json"};
}

}  // namespace ssphh::app
