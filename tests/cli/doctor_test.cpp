// What `ssphh doctor` says of a machine that has everything, and of one that lacks something.

#include "commands/doctor.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "here.h"
#include "stand_in_programs.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh::app {
namespace {

using test::Path;
using test::TempDir;
using test::Variable;
using testing::HasSubstr;

DoctorRow row(const std::string& part) {
  const DoctorReport report = run_doctor();
  const auto found = std::ranges::find(report.rows, part, &DoctorRow::part);
  EXPECT_NE(found, report.rows.end()) << part;
  return found == report.rows.end() ? DoctorRow{} : *found;
}

void expect_row(const std::string& part, Health health, const std::string& found, const std::string& advice) {
  const DoctorRow seen = row(part);
  EXPECT_EQ(name_of(seen.health), name_of(health)) << part << ": " << seen.found;
  EXPECT_THAT(seen.found, HasSubstr(found)) << part;
  EXPECT_THAT(seen.advice, HasSubstr(advice)) << part;
}

TEST(Doctor, BakesAProbeHere) {
  const json::Value report = test::json_here({"doctor"});
  EXPECT_EQ(report["can_bake"], true);
  for (const json::Value& part : report["parts"].elements()) {
    test::expect_keys(part, {"part", "found", "health"});
    EXPECT_EQ(part.contains("advice"), part["health"] != "ok") << print(part);
  }
  expect_row("bake", Health::ok, "probes of builtin:cornell in ", "");
  expect_row("ssphh", Health::ok, "0.", "");
}

TEST(Doctor, TellsWhereProgramsAreOrHowToGetThem) {
  const TempDir dir;
  test::write_script(dir / "blender", "exit 0\n");
  const Path path(dir.path().string());
  expect_row("blender", Health::ok, (dir / "blender").string(), "");
  expect_row("git", Health::missing, "not in the folders of PATH", "apt install git");
}

TEST(Doctor, TellsOfFoldersThatCannotBeWritten) {
  const TempDir dir;
  write_file(dir / "file", "no folder");
  const Variable caches("XDG_CACHE_HOME", (dir / "file").c_str()),
      state("XDG_STATE_HOME", dir.path().c_str());
  expect_row("result cache", Health::missing, (dir / "file/ssphh/results").string(), "XDG_CACHE_HOME");
  expect_row("autosave", Health::ok, (dir / "ssphh/autosave").string() + " (not there yet)", "");
  EXPECT_FALSE(std::filesystem::exists(dir / "ssphh")) << "it writes nothing";
}

TEST(Doctor, OpenGlAndWindowsAreMissingWhereThereAreNone) {
  // EGL's loader finds its drivers by such files
  const Variable drivers("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent/egl.json"), x("DISPLAY", nullptr),
      wayland("WAYLAND_DISPLAY", nullptr);
  const test::ToolResult result = test::run_tool({"doctor"});
  EXPECT_EQ(result.exit_code, 0) << "bakes need neither";
  EXPECT_THAT(result.out, HasSubstr("-- opengl        EGL finds no device\n"));
  EXPECT_THAT(result.out, HasSubstr("apt install libegl1"));
  EXPECT_THAT(result.out, HasSubstr("-- window        neither DISPLAY nor WAYLAND_DISPLAY is set\n"));
  EXPECT_THAT(result.out, testing::EndsWith("\nall that a bake needs works\n"));
}

TEST(Doctor, TellsWhichLoopsAreTaken) {
  const auto loops = [](const char* avx2) {
    const Variable wanted("SSPHH_AVX2", avx2);
    return test::run_tool({"doctor"}).out;
  };
  EXPECT_THAT(loops("0"), HasSubstr("long loops by what that has\n"));
}

TEST(Doctor, WhatNoBakeWorksWithoutGivesExitCodeOne) {
  const DoctorReport report{
      {{"opengl", "none", Health::missing, "install it"}, {"bake", "dark", Health::ok, ""}}};
  EXPECT_FALSE(has_failed(report, {}));
  DoctorReport broken = report;
  broken.rows[1].health = Health::broken;
  EXPECT_TRUE(has_failed(broken, {}));
  EXPECT_EQ(to_json(broken, {})["can_bake"], false);
  EXPECT_THAT(to_text(broken, {}), HasSubstr("\n!! bake          dark\n"));
}

}  // namespace
}  // namespace ssphh::app
