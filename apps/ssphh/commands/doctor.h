#pragma once
/// `ssphh doctor`: what this machine offers to the tool, and whether all that a bake needs works.

#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/core/json.h>

#include "options/settings.h"

namespace ssphh::app {

/// `missing`: some commands do not work, or not well; `broken`: no bake does.
enum class Health { ok, missing, broken };
constexpr auto enum_table(Health) {
  using enum Health;
  return std::to_array<EnumName<Health>>({{ok, "ok"}, {missing, "missing"}, {broken, "broken"}});
}

struct DoctorRow {
  std::string part;   ///< what was looked at
  std::string found;  ///< what is there, or why there is none
  Health health = Health::ok;
  std::string advice;  ///< what to do; empty where all is well
};

struct DoctorOptions {
  Settings settings;  ///< that are in force
};

struct DoctorReport {
  std::vector<DoctorRow> rows;
};

/// Bakes a probe, opens an OpenGL context, and looks for programs and folders; writes nothing. What does not
/// work is a row, not an Error. Throws Cancelled when asked to stop.
DoctorReport run_doctor(const DoctorOptions& options = {}, const Control& control = {});
bool has_failed(const DoctorReport& report, const DoctorOptions& options);

json::Value to_json(const DoctorReport& report, const DoctorOptions& options);
std::string to_text(const DoctorReport& report, const DoctorOptions& options);

}  // namespace ssphh::app
