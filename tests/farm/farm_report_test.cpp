/// `ssphh report` with a farm, and jobs that were set aside.

#include <map>

#include "farm_process.h"
#include "joined.h"
#include "places.h"

namespace ssphh::test {
namespace {

namespace fs = std::filesystem;

/// Pictures and probe files of a cache of runs, by KEY/NAME.
std::map<std::string, std::vector<std::byte>> results_in(const fs::path& cache) {
  std::map<std::string, std::vector<std::byte>> files;
  for (const auto& entry : fs::recursive_directory_iterator(cache)) {
    const fs::path path = entry.path();
    if (path.extension() == ".exr" || path.extension() == ".sphl")
      files[(path.parent_path().filename() / path.filename()).string()] = read_file(path);
  }
  return files;
}

TEST(FarmReport, RunsOfAFarmHaveTheKeysAndTheBitsOfLocalOnes) {
  const TempDir dir;
  const std::string plan = test::source_dir() / "plans/tiny.json";
  const auto report = [&](const std::string& name, const std::vector<std::string>& more) {
    return run_json(test::joined(
        {"report", plan, "-o", (dir / name / "out").string(), "--cache", (dir / name / "cache").string()},
        more));
  };
  EXPECT_EQ(report("here", {})["run"], 9);
  const auto far = report("far", {"--local", "2"});
  EXPECT_EQ(far["run"], 9);
  EXPECT_EQ(far["failed"], 0);
  const auto here = results_in(dir / "here/cache");
  EXPECT_EQ(here.size(), 11u) << "two halves and their mean, six and one pictures, one probe file";
  EXPECT_EQ(results_in(dir / "far/cache"), here);

  int on_farm = 0;
  for (const auto& entry : fs::directory_iterator(dir / "far/cache")) {
    const auto record = parse_json(read_text_file(entry.path() / "run.json"));
    on_farm += record["machine"].string().ends_with("and a farm");
  }
  EXPECT_EQ(on_farm, 9);
}

TEST(FarmCommand, ParkedJobsAreShownReleasedAndDropped) {
  const TempDir dir;
  FarmProcesses farm(0, {"--attempts", "1"});
  // Its disk is a file: it fails every job that needs a scene, and a job may fail once.
  farm.start_worker();
  ASSERT_TRUE(farm.worker(0).wait_for_stderr("worker-ready"));
  fs::remove_all(farm.dir() / "cache0");
  write_file(farm.dir() / "cache0", "no folder");
  const SmallBake bake(dir, "2");
  const ToolResult failed = run_tool(bake.on(farm.endpoint(), dir / "out.sphl"));
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_THAT(failed.err, testing::HasSubstr("failed on 1 worker"));

  const std::vector<std::string> to = {"--broker", farm.endpoint()};
  const auto farm_command = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "farm");
    words.insert(words.end(), to.begin(), to.end());
    return words;
  };
  const auto parked = run_json(farm_command({"parked"}))["jobs"];
  ASSERT_GE(parked.size(), 1u);
  EXPECT_THAT(parked[0]["failures"][0].string(), testing::HasSubstr("cache0"));
  expect_failure(farm_command({"release"}), "--all");
  expect_failure(farm_command({"release", "99999"}), "job 99999 is not set aside");
  EXPECT_EQ(run_json(farm_command({"drop", print(parked[0]["job"])}))["dropped"], 1);
  EXPECT_EQ(run_json(farm_command({"release", "--all"}))["released"], parked.size() - 1);
  EXPECT_EQ(run_json(farm_command({"drop", "--all"}))["dropped"].is_number(), true);
}

}  // namespace
}  // namespace ssphh::test
