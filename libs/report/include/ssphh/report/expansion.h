#pragma once
/// From a plan to command lines, each named by a hash of everything that decides its result.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <ssphh/report/plan.h>

namespace ssphh::report {

/// A command line that is run once, however many cells need it.
struct Job {
  std::string key;                   ///< 32 hexadecimal digits
  std::string scene;                 ///< name in the plan
  std::vector<std::string> words;    ///< outputs by their bare names, earlier outputs as "@KEY/NAME"
  std::vector<std::string> outputs;  ///< bare names after -o, --output, --png or --save
  std::vector<std::size_t> needs;    ///< jobs whose outputs it reads; all come before it
};

/// One run of a method: its steps and where its pictures will be, as "KEY/NAME".
struct CellRun {
  std::vector<std::size_t> jobs;
  std::vector<std::string> pictures;  ///< one picture, two halves, or none
};

/// A scene with a method and its parameters.
struct Cell {
  std::size_t scene = 0;
  int method = -1;  ///< −1: the reference
  Parameters parameters;
  std::string label;
  std::vector<CellRun> runs;  ///< one for each repetition
};

struct Expansion {
  std::vector<Job> jobs;
  std::vector<Cell> cells;  ///< by scene; its reference first
};

struct ExpandContext {
  std::filesystem::path folder;                     ///< of the plan: files in it are found from there first
  std::string version;                              ///< of the tool
  std::map<std::string, std::string> scene_hashes;  ///< by name; of the content that can change a result
  int threads = 0;                                  ///< passed on when not 0
};

/// A key changes with the tool's version, the words, the content of the scene and of every file named, the
/// earlier steps whose outputs are read, the seed and the number of threads; it does not depend on where
/// files lie or in which order the plan has its keys. Scenes without a hash are left out. Throws Error for a
/// picture that no step writes, a scene without words, and a method without a variant or repetition.
Expansion expand(const Plan& plan, const ExpandContext& context);

/// `words` with paths for files: outputs in `work`, earlier outputs in `cache`.
std::vector<std::string> command_line(const Job& job, const std::filesystem::path& cache,
                                      const std::filesystem::path& work);

/// The scene's words with paths for the files that lie in the plan's folder.
std::vector<std::string> scene_words(const PlanScene& scene, const std::filesystem::path& folder);

}  // namespace ssphh::report
