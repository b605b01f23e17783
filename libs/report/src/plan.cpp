#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <ssphh/core/nearest_word.h>
#include <ssphh/report/plan.h>

#include "json_reader.h"
#include "parameters.h"
#include "words.h"
#include "yaml_reader.h"

namespace ssphh::report {
namespace {

const std::vector<std::string> picture_layers = {"direct", "indirect", "irradiance"};

class PlanReader {
 public:
  PlanReader(std::string name, const std::vector<std::string>& commands)
      : name_(std::move(name)), commands_(commands) {}

  Plan read(const Json& json) {
    const Object o(json, name_,
                   {"$schema", "title", "about", "variables", "scenes", "reference", "methods", "layers",
                    "columns", "charts", "published", "block", "time_limit"});
    plan_.title = o.text("title", name_);
    plan_.about = o.text("about");
    if (const Json* variables = o.find("variables"))
      plan_.variables = read_parameters(*variables, o.at("variables"));
    o.must("scenes"), o.must("methods");
    for (const Json* item : o.items("scenes"))
      plan_.scenes.push_back(read_scene(*item, fmt::format("{}/scenes[{}]", name_, plan_.scenes.size())));
    if (plan_.scenes.empty()) throw Error(o.at("scenes"), "is empty");
    if (const Json* reference = o.find("reference")) {
      plan_.has_reference = true;
      plan_.reference = read_method(*reference, o.at("reference"), true);
    }
    for (const Json* item : o.items("methods"))
      plan_.methods.push_back(
          read_method(*item, fmt::format("{}/methods[{}]", name_, plan_.methods.size()), false));
    if (plan_.methods.empty()) throw Error(o.at("methods"), "is empty");
    plan_.layers = o.texts("layers");
    for (const std::string& layer : plan_.layers) {
      if (std::find(picture_layers.begin(), picture_layers.end(), layer) == picture_layers.end())
        throw Error(o.at("layers"), fmt::format("unknown layer \"{}\"", layer),
                    nearest_hint(layer, picture_layers));
    }
    for (const Json* item : o.items("columns"))
      plan_.columns.push_back(
          read_column(*item, fmt::format("{}[{}]", o.at("columns"), plan_.columns.size())));
    for (const Json* item : o.items("charts"))
      plan_.charts.push_back(read_chart(*item, fmt::format("{}[{}]", o.at("charts"), plan_.charts.size())));
    if (const Json* published = o.find("published")) read_published(*published, o.at("published"));
    plan_.block = o.integer("block", 16, 1, 4096);
    plan_.time_limit = o.integer("time_limit", 3600, 1, 1000000);
    check_names();
    return std::move(plan_);
  }

 private:
  PlanScene read_scene(const Json& json, const std::string& where) const {
    const Object o(json, where, {"name", "title", "scene", "exposure", "variables", "insets", "optional"});
    PlanScene scene;
    o.must("name"), o.must("scene");
    scene.name = o.text("name");
    scene.title = o.text("title", scene.name);
    scene.words = split_words(o.text("scene"), o.at("scene"));
    if (scene.words.empty()) throw Error(o.at("scene"), "is empty", "give a file or builtin:NAME");
    scene.exposure = o.number("exposure", 0, -30, 30);
    scene.optional = o.flag("optional", false);
    if (const Json* variables = o.find("variables"))
      scene.variables = read_parameters(*variables, o.at("variables"));
    std::vector<std::string> known;
    for (const auto& [key, value] : plan_.variables) known.push_back(key);
    for (const auto& [key, value] : scene.variables) {
      if (std::find(known.begin(), known.end(), key) == known.end())
        throw Error(o.at("variables"), fmt::format("the plan has no variable \"{}\"", key),
                    nearest_hint(key, known));
    }
    for (const Json* item : o.items("insets"))
      scene.insets.push_back(read_inset(*item, fmt::format("{}[{}]", o.at("insets"), scene.insets.size())));
    return scene;
  }

  static Inset read_inset(const Json& json, const std::string& where) {
    const Object o(json, where, {"name", "at", "mask"});
    Inset inset;
    inset.name = o.text("name");
    inset.mask_file = o.text("mask");
    if (!inset.mask_file.empty()) {
      if (o.find("at")) throw Error(where, "\"at\" and \"mask\" exclude each other");
      return inset;
    }
    const std::vector<const Json*> at = o.items("at");
    if (at.size() != 4 || !std::all_of(at.begin(), at.end(), [](const Json* x) { return x->is_number(); }))
      throw Error(o.at("at"), "must be four numbers: left, top, right, bottom as fractions",
                  "or give a picture of the region as \"mask\"");
    inset.x0 = at[0]->get<double>(), inset.y0 = at[1]->get<double>();
    inset.x1 = at[2]->get<double>(), inset.y1 = at[3]->get<double>();
    if (!(0 <= inset.x0 && inset.x0 < inset.x1 && inset.x1 <= 1 && 0 <= inset.y0 && inset.y0 < inset.y1 &&
          inset.y1 <= 1))
      throw Error(o.at("at"), "must be left < right and top < bottom, all within 0..1");
    return inset;
  }

  Step read_step(const Json& json, const std::string& where) const {
    Step step;
    if (json.is_string()) {
      step.words = split_words(json.get<std::string>(), where);
    } else {
      const Object o(json, where, {"name", "run"});
      o.must("run");
      step.words = split_words(o.text("run"), o.at("run"));
      step.name = o.text("name");
    }
    if (step.words.empty())
      throw Error(where, "is empty", "give a command line of the tool, as render {scene} -o picture.exr");
    const std::string& command = step.words.front();
    if (std::find(commands_.begin(), commands_.end(), command) == commands_.end())
      throw Error(where, fmt::format("unknown command \"{}\"", command), nearest_hint(command, commands_));
    if (step.name.empty()) step.name = command;
    return step;
  }

  PlanMethod read_method(const Json& json, const std::string& where, bool reference) const {
    std::vector<std::string> known = {"name",   "title",      "about",       "steps", "picture",
                                      "halves", "parameters", "repetitions", "scenes"};
    if (reference) known = {"name", "title", "about", "steps", "picture", "halves"};
    const Object o(json, where, known);
    PlanMethod method;
    if (!reference) o.must("name");
    method.name = o.text("name", "reference");
    method.title = o.text("title", method.name);
    method.about = o.text("about");
    o.must("steps");
    for (const Json* item : o.items("steps"))
      method.steps.push_back(read_step(*item, fmt::format("{}/steps[{}]", where, method.steps.size())));
    if (method.steps.empty()) throw Error(o.at("steps"), "is empty");
    std::set<std::string> names;
    for (const Step& step : method.steps) {
      if (!names.insert(step.name).second)
        throw Error(o.at("steps"), fmt::format("two steps are called \"{}\"", step.name),
                    R"(name them: {"name": "…", "run": "…"})");
    }
    method.picture = o.text("picture");
    method.halves = o.texts("halves");
    if (!method.halves.empty() && method.halves.size() != 2)
      throw Error(o.at("halves"), "must be two pictures");
    if (!method.halves.empty() && !method.picture.empty())
      throw Error(where, "\"picture\" and \"halves\" exclude each other");
    if (reference && method.picture.empty() && method.halves.empty())
      throw Error(where, "\"picture\" or \"halves\" is missing");
    method.variants = read_variants(o.find("parameters"), o.at("parameters"));
    method.repetitions = o.integer("repetitions", 1, 1, 1000);
    method.scenes = o.texts("scenes");
    return method;
  }

  static Column read_column(const Json& json, const std::string& where) {
    if (json.is_string()) return {json.get<std::string>(), json.get<std::string>(), "", 0};
    const Object o(json, where, {"value", "title", "unit", "better"});
    o.must("value");
    Column column{o.text("value"), o.text("title", o.text("value")), o.text("unit"), 0};
    const std::string better = o.text("better", "none");
    if (better != "less" && better != "more" && better != "none")
      throw Error(o.at("better"), "must be less, more or none");
    column.better = better == "less" ? -1 : better == "more" ? 1 : 0;
    return column;
  }

  static Chart read_chart(const Json& json, const std::string& where) {
    const Object o(json, where, {"title", "x", "y", "log_x", "log_y"});
    o.must("x"), o.must("y");
    return {o.text("title", o.text("y")), o.text("x"), o.text("y"), o.flag("log_x", false),
            o.flag("log_y", false)};
  }

  void read_published(const Json& json, const std::string& where) {
    const Object o(json, where, {"source", "rows"});
    plan_.published_source = o.text("source");
    for (const Json* item : o.items("rows")) {
      const Object row(*item, o.at("rows"), {"scene", "method", "values"});
      Published published{row.text("scene"), row.text("method"), {}};
      for (const auto& [title, value] : row.must("values").items()) {
        if (!value.is_number()) throw Error(row.at("values") + "/" + title, "must be a number");
        published.values[title] = value.get<double>();
      }
      plan_.published.push_back(std::move(published));
    }
  }

  void check_words(const PlanMethod& method, const Parameters& parameters, const std::string& where) const {
    std::vector<std::string> known = {"scene"};
    for (const Parameters* list : {&plan_.variables, &parameters}) {
      for (const auto& [key, value] : *list) known.push_back(key);
    }
    for (const Step& step : method.steps) {
      for (const std::string& word : step.words) {
        for (const std::string& name : names_in(word, where)) {
          if (std::find(known.begin(), known.end(), name) == known.end())
            throw Error(where, fmt::format("unknown name {{{}}} in \"{}\"", name, join_words(step.words)),
                        nearest_hint(name, known));
          if (name == "scene" && word != "{scene}")
            throw Error(where, "{scene} must stand by itself, not inside " + word);
        }
      }
    }
  }

  void check_names() const {
    std::set<std::string> scenes, methods;
    for (const PlanScene& scene : plan_.scenes) {
      if (scene.name.empty() || !scenes.insert(scene.name).second)
        throw Error(name_ + "/scenes", fmt::format("two scenes are called \"{}\"", scene.name));
    }
    const std::vector<std::string> scene_names(scenes.begin(), scenes.end());
    if (plan_.has_reference) check_words(plan_.reference, {}, name_ + "/reference");
    std::vector<std::string> labels;
    for (const PlanMethod& method : plan_.methods) {
      const std::string where = name_ + "/methods/" + method.name;
      for (const std::string& scene : method.scenes) {
        if (!scenes.count(scene))
          throw Error(where, fmt::format("unknown scene \"{}\"", scene), nearest_hint(scene, scene_names));
      }
      for (const Parameters& parameters : method.variants) {
        check_words(method, parameters, where);
        labels.push_back(label(method, parameters));
        if (!methods.insert(labels.back()).second)
          throw Error(where, fmt::format("two methods are called \"{}\"", labels.back()));
      }
    }
    for (const Published& row : plan_.published) {
      if (!scenes.count(row.scene))
        throw Error(name_ + "/published", fmt::format("unknown scene \"{}\"", row.scene),
                    nearest_hint(row.scene, scene_names));
      if (!methods.count(row.method))
        throw Error(name_ + "/published", fmt::format("unknown method \"{}\"", row.method),
                    nearest_hint(row.method, labels));
    }
  }

  std::string name_;
  const std::vector<std::string>& commands_;
  Plan plan_;
};

}  // namespace

std::string label(const PlanMethod& method, const Parameters& parameters) {
  std::string text = method.name;
  for (const auto& [name, value] : parameters) text += fmt::format(", {} {}", name, value);
  return text;
}

namespace {

/// The key in 'unknown key "x"', "" for other problems.
std::string quoted_key(const std::string& problem) {
  const std::string_view start = "unknown key \"";
  if (!problem.starts_with(start)) return {};
  return problem.substr(start.size(), problem.rfind('"') - start.size());
}

Plan parse_yaml_plan(std::string_view yaml, const std::string& name,
                     const std::vector<std::string>& commands) {
  const Json document = parse_yaml(yaml, name);
  try {
    return PlanReader(name, commands).read(document);
  } catch (const Error& e) {
    const int line = yaml_line(yaml, name, e.where(), quoted_key(e.problem()));
    if (line == 0) throw;
    const std::string place = e.where().substr(std::min(e.where().size(), name.size() + 1));
    throw Error(fmt::format("{}:{}{}{}", name, line, place.empty() ? "" : ": ", place), e.problem(),
                e.hint());
  }
}

}  // namespace

Plan parse_plan(std::string_view text, const std::string& name, const std::vector<std::string>& commands) {
  if (is_yaml_name(name)) return parse_yaml_plan(text, name, commands);
  Json document;
  try {
    document = Json::parse(text);
  } catch (const Json::parse_error& e) {
    throw Error(name, fmt::format("is not JSON: {}", e.what()));
  }
  return PlanReader(name, commands).read(document);
}

void set_variable(Plan& plan, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) throw Error("--set " + assignment, "is not NAME=VALUE");
  const std::string name = assignment.substr(0, equals);
  std::vector<std::string> known;
  for (auto& [key, value] : plan.variables) {
    known.push_back(key);
    if (key == name) {
      value = assignment.substr(equals + 1);
      return;
    }
  }
  throw Error("--set " + assignment, fmt::format("the plan has no variable \"{}\"", name),
              nearest_hint(name, known));
}

}  // namespace ssphh::report
