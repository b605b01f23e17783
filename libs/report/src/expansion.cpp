#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/hash.h>
#include <ssphh/report/expansion.h>

#include "command_words.h"

namespace ssphh::report {
namespace {

namespace fs = std::filesystem;

// Part of every key: raise it when what is kept of a run changes.
constexpr int cache_format = 1;

bool names_output(const std::string& word) {
  return word == "-o" || word == "--output" || word == "--png" || word == "--save";
}

std::string stem_of(const std::string& name) {
  return name.substr(0, name.find('.'));
}

// OUT.exr also stands for OUT.albedo.exr and OUT.a.exr: files that a command writes beside its output.
bool is_written_by(const Job& job, const std::string& name) {
  return std::ranges::any_of(job.outputs, [&](const std::string& output) {
    return name == output || (name.find('.') != std::string::npos && stem_of(name) == stem_of(output) &&
                              fs::path(name).extension() == fs::path(output).extension());
  });
}

// "--option=" of "--option=value", "" of other words.
std::string option_of(const std::string& word) {
  const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
  return equals == std::string::npos ? "" : word.substr(0, equals + 1);
}

// Only words that look like a path: a folder may well hold a file called "path" or "4".
std::string resolve(const std::string& word, const fs::path& folder) {
  const std::string option = option_of(word), value = word.substr(option.size());
  if (value.empty() || value.front() == '-' || value.find_first_of("./") == std::string::npos) return word;
  std::error_code ignored;
  for (const fs::path& path : {folder / value, fs::path(value)}) {
    if (fs::is_regular_file(path, ignored)) return option + fs::absolute(path).lexically_normal().string();
  }
  return word;
}

class Expander {
 public:
  Expander(const Plan& plan, const ExpandContext& context) : plan_(plan), context_(context) {}

  Expansion run() {
    for (std::size_t s = 0; s < plan_.scenes.size(); ++s) {
      const std::string& scene = plan_.scenes[s].name;
      if (!context_.scene_hashes.count(scene)) continue;
      if (plan_.scenes[s].words.empty()) throw Error("scene " + scene, "has no words: which one is it?");
      if (plan_.has_reference) add_cell(s, -1, plan_.reference, {});
      for (std::size_t m = 0; m < plan_.methods.size(); ++m) {
        const PlanMethod& method = plan_.methods[m];
        if (!method.scenes.empty() && std::ranges::find(method.scenes, scene) == method.scenes.end())
          continue;
        if (method.variants.empty())
          throw Error("method " + method.name, "has no variant", "one without parameters will do");
        for (const Parameters& parameters : method.variants)
          add_cell(s, static_cast<int>(m), method, parameters);
      }
    }
    return std::move(result_);
  }

 private:
  void add_cell(std::size_t scene, int index, const PlanMethod& method, const Parameters& parameters) {
    if (method.repetitions < 1) throw Error("method " + method.name, "has no repetition");
    Cell cell{scene, index, parameters, label(method, parameters), {}};
    for (int repetition = 0; repetition < method.repetitions; ++repetition)
      cell.runs.push_back(add_run(scene, method, parameters, repetition));
    result_.cells.push_back(std::move(cell));
  }

  CellRun add_run(std::size_t scene, const PlanMethod& method, const Parameters& parameters, int repetition) {
    CellRun run;
    Parameters values = plan_.variables;  // the last match counts
    const Parameters& of_scene = plan_.scenes[scene].variables;
    values.insert(values.end(), of_scene.begin(), of_scene.end());
    values.insert(values.end(), parameters.begin(), parameters.end());
    for (const Step& step : method.steps) run.jobs.push_back(add_job(scene, step, values, repetition, run));
    std::vector<std::string> names = method.halves;
    if (!method.picture.empty()) names.push_back(method.picture);
    for (const std::string& name : names) {
      const Job* writer = writer_of(name, run);
      if (!writer)
        throw Error("method " + method.name, fmt::format("no step writes \"{}\"", name),
                    "a picture is the name after a step's -o");
      run.pictures.push_back(writer->key + "/" + name);
    }
    return run;
  }

  const Job* writer_of(const std::string& name, const CellRun& run) const {
    for (auto job = run.jobs.rbegin(); job != run.jobs.rend(); ++job) {
      if (is_written_by(result_.jobs[*job], name)) return &result_.jobs[*job];
    }
    return nullptr;
  }

  std::size_t add_job(std::size_t scene_index, const Step& step, const Parameters& values, int repetition,
                      const CellRun& run) {
    const PlanScene& scene = plan_.scenes[scene_index];
    Job job;
    job.scene = scene.name;
    Hasher hasher;
    hasher.value(cache_format).text(context_.version);
    const auto add = [&](const std::string& word, const std::string& identity) {
      job.words.push_back(word);
      hasher.text(identity);
    };
    for (const std::string& raw : step.words) {
      if (raw == "{scene}") {
        const std::vector<std::string> words = scene_words(scene, context_.folder);
        add(words.front(), "scene " + context_.scene_hashes.at(scene.name));
        for (std::size_t i = 1; i < words.size(); ++i) add_word(words[i], add);
        continue;
      }
      const std::string word = substitute(raw, values);
      if (!job.words.empty() && names_output(job.words.back())) {
        if (word.find('/') != std::string::npos || word.empty() || word == "." || word == "..")
          throw Error("step " + step.name, fmt::format("output \"{}\" must be a bare name", word),
                      "every run has a folder of its own");
        job.outputs.push_back(word);
        add(word, "output " + word);
      } else if (const Job* writer = writer_of(word, run)) {
        add("@" + writer->key + "/" + word, "earlier " + writer->key + " " + word);
        job.needs.push_back(static_cast<std::size_t>(writer - result_.jobs.data()));
      } else {
        add_word(resolve(word, context_.folder), add);
      }
    }
    const auto option = [&](const std::string& name, int value) {
      if (std::ranges::find(job.words, name) != job.words.end()) return;
      add(name, name), add(std::to_string(value), std::to_string(value));
    };
    if (repetition > 0) option("--seed", repetition);
    if (context_.threads > 0) option("--threads", context_.threads);
    job.key = hasher.finish().hex();
    for (std::size_t i = 0; i < result_.jobs.size(); ++i) {
      if (result_.jobs[i].key == job.key) return i;
    }
    result_.jobs.push_back(std::move(job));
    return result_.jobs.size() - 1;
  }

  template <class Add>
  void add_word(const std::string& word, const Add& add) {
    std::error_code ignored;
    const std::string option = option_of(word), path = word.substr(option.size());
    const bool file = path.starts_with('/') && fs::is_regular_file(path, ignored);
    add(word, file ? "file " + option + file_hash(path) : "word " + word);
  }

  const std::string& file_hash(const std::string& path) {
    std::string& hash = file_hashes_[path];
    if (hash.empty()) hash = Hasher().bytes(read_file(path)).finish().hex();
    return hash;
  }

  const Plan& plan_;
  const ExpandContext& context_;
  Expansion result_;
  std::map<std::string, std::string> file_hashes_;  ///< by path: many jobs name the same files
};

}  // namespace

std::vector<std::string> scene_words(const PlanScene& scene, const fs::path& folder) {
  std::vector<std::string> words = scene.words;
  for (std::string& word : words) word = resolve(word, folder);
  return words;
}

Expansion expand(const Plan& plan, const ExpandContext& context) {
  return Expander(plan, context).run();
}

std::vector<std::string> command_line(const Job& job, const fs::path& cache, const fs::path& work) {
  std::vector<std::string> words;
  for (const std::string& word : job.words) {
    if (!words.empty() && names_output(words.back())) {
      words.push_back((work / word).string());
    } else if (word.size() > 34 && word.front() == '@' && word[33] == '/') {
      words.push_back((cache / word.substr(1)).string());
    } else {
      words.push_back(word);
    }
  }
  return words;
}

}  // namespace ssphh::report
