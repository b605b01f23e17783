#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <ssphh/core/nearest_word.h>
#include <ssphh/report/plan.h>

#include "command_words.h"
#include "parameters.h"
#include "yaml_reader.h"

namespace ssphh::report {
namespace {

const std::vector<std::string> picture_layers = {"direct", "indirect", "irradiance"};

using json::Cursor;

int integer(const Cursor& object, const char* name, int otherwise, int least, int most) {
  const auto member = object.find(name);
  return member ? static_cast<int>(member->integer(least, most)) : otherwise;
}

/// A list of texts; a single text is a list of one, none an empty one.
std::vector<std::string> texts(const Cursor& object, const char* name) {
  const auto member = object.find(name);
  if (!member) return {};
  if (member->is_string()) return {member->text()};
  std::vector<std::string> found;
  for (std::size_t i = 0; i < member->size(); ++i) found.push_back((*member)[i].text());
  return found;
}

/// What `read` makes of each element of the list that a member is.
template <class Read>
auto items(const Cursor& object, const char* name, const Read& read) {
  std::vector<decltype(read(object))> found;
  const std::size_t count = object.size_of(name);
  for (std::size_t i = 0; i < count; ++i) found.push_back(read(object[name][i]));
  return found;
}

bool among(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

class PlanReader {
 public:
  PlanReader(std::string name, const std::vector<std::string>& commands)
      : name_(std::move(name)), commands_(commands) {}

  Plan read(const json::Value& document) {
    const Cursor o(document, name_);
    o.members({"scenes", "methods"}, {"$schema", "title", "about", "variables", "reference", "layers",
                                      "columns", "charts", "published", "block", "time_limit"});
    plan_.title = o.text_or("title", name_);
    plan_.about = o.text_or("about");
    if (const auto variables = o.find("variables")) plan_.variables = read_parameters(*variables);
    plan_.scenes = items(o, "scenes", [&](const Cursor& at) { return read_scene(at); });
    if (plan_.scenes.empty()) o["scenes"].fail("is empty");
    if (const auto reference = o.find("reference")) {
      plan_.has_reference = true;
      plan_.reference = read_method(*reference, true);
    }
    plan_.methods = items(o, "methods", [&](const Cursor& at) { return read_method(at, false); });
    if (plan_.methods.empty()) o["methods"].fail("is empty");
    plan_.layers = texts(o, "layers");
    for (const std::string& layer : plan_.layers) {
      if (!among(picture_layers, layer))
        o["layers"].fail(fmt::format("unknown layer \"{}\"", layer), nearest_hint(layer, picture_layers));
    }
    plan_.columns = items(o, "columns", read_column);
    plan_.charts = items(o, "charts", read_chart);
    if (const auto published = o.find("published")) read_published(*published);
    plan_.block = integer(o, "block", 16, 1, 4096);
    plan_.time_limit = integer(o, "time_limit", 3600, 1, 1000000);
    check_names();
    return std::move(plan_);
  }

 private:
  PlanScene read_scene(const Cursor& o) const {
    o.members({"name", "scene"}, {"title", "exposure", "variables", "insets", "optional"});
    PlanScene scene;
    scene.name = o["name"].text();
    if (scene.name.empty()) o["name"].fail("is empty");
    scene.title = o.text_or("title", scene.name);
    scene.words = split_words(o["scene"].text(), o["scene"].place());
    if (scene.words.empty()) o["scene"].fail("is empty", "give a file or builtin:NAME");
    if (const auto ev = o.find("exposure"); ev && !(ev->is_string() && ev->text() == "auto"))
      scene.exposure = ev->precise_number(-30, 30);
    scene.optional = o.boolean_or("optional", false);
    if (const auto variables = o.find("variables")) scene.variables = read_parameters(*variables);
    std::vector<std::string> known;
    for (const auto& [key, value] : plan_.variables) known.push_back(key);
    for (const auto& [key, value] : scene.variables) {
      if (!among(known, key))
        o["variables"].fail(fmt::format("the plan has no variable \"{}\"", key), nearest_hint(key, known));
    }
    scene.insets = items(o, "insets", read_inset);
    return scene;
  }

  static Inset read_inset(const Cursor& o) {
    o.members({}, {"name", "at", "mask"});
    Inset inset;
    inset.name = o.text_or("name");
    inset.mask_file = o.text_or("mask");
    if (!inset.mask_file.empty()) {
      if (o.has("at")) o.fail("\"at\" and \"mask\" exclude each other");
      return inset;
    }
    if (!o.has("at"))
      o.fail("\"at\" is missing", "give four fractions, or a picture of the region as \"mask\"");
    const Cursor at = o["at"];
    at.size(4, 4);
    inset.x0 = at[0].precise_number(), inset.y0 = at[1].precise_number();
    inset.x1 = at[2].precise_number(), inset.y1 = at[3].precise_number();
    if (!(0 <= inset.x0 && inset.x0 < inset.x1 && inset.x1 <= 1 && 0 <= inset.y0 && inset.y0 < inset.y1 &&
          inset.y1 <= 1))
      at.fail("must be left < right and top < bottom, all within 0..1");
    return inset;
  }

  Step read_step(const Cursor& o) const {
    Step step;
    if (o.is_string()) {
      step.words = split_words(o.text(), o.place());
    } else {
      o.members({"run"}, {"name"});
      step.words = split_words(o["run"].text(), o["run"].place());
      step.name = o.text_or("name");
    }
    if (step.words.empty())
      o.fail("is empty", "give a command line of the tool, as render {scene} -o picture.exr");
    const std::string& command = step.words.front();
    if (!among(commands_, command))
      o.fail(fmt::format("unknown command \"{}\"", command), nearest_hint(command, commands_));
    if (step.name.empty()) step.name = command;
    return step;
  }

  PlanMethod read_method(const Cursor& o, bool reference) const {
    if (reference) {
      o.members({"steps"}, {"name", "title", "about", "picture", "halves"});
    } else {
      o.members({"name", "steps"},
                {"title", "about", "picture", "halves", "parameters", "repetitions", "scenes"});
    }
    PlanMethod method;
    method.name = o.text_or("name", "reference");
    method.title = o.text_or("title", method.name);
    method.about = o.text_or("about");
    method.steps = items(o, "steps", [&](const Cursor& at) { return read_step(at); });
    if (method.steps.empty()) o["steps"].fail("is empty");
    std::set<std::string> names;
    for (const Step& step : method.steps) {
      if (!names.insert(step.name).second)
        o["steps"].fail(fmt::format("two steps are called \"{}\"", step.name),
                        R"(name them: {"name": "…", "run": "…"})");
    }
    method.picture = o.text_or("picture");
    method.halves = texts(o, "halves");
    if (!method.halves.empty() && method.halves.size() != 2) o["halves"].fail("must be two pictures");
    if (!method.halves.empty() && !method.picture.empty())
      o.fail("\"picture\" and \"halves\" exclude each other");
    if (reference && method.picture.empty() && method.halves.empty())
      o.fail("\"picture\" or \"halves\" is missing");
    method.variants = read_variants(o.find("parameters"));
    method.repetitions = integer(o, "repetitions", 1, 1, 1000);
    method.scenes = texts(o, "scenes");
    return method;
  }

  static Column read_column(const Cursor& o) {
    if (o.is_string()) return {o.text(), o.text(), "", 0};
    o.members({"value"}, {"title", "unit", "better"});
    Column column{o["value"].text(), o.text_or("title", o["value"].text()), o.text_or("unit"), 0};
    const std::string better = o.text_or("better", "none");
    if (better != "less" && better != "more" && better != "none")
      o["better"].fail("must be less, more or none");
    column.better = better == "less" ? -1 : better == "more" ? 1 : 0;
    return column;
  }

  static Chart read_chart(const Cursor& o) {
    o.members({"x", "y"}, {"title", "log_x", "log_y"});
    return {o.text_or("title", o["y"].text()), o["x"].text(), o["y"].text(), o.boolean_or("log_x", false),
            o.boolean_or("log_y", false)};
  }

  void read_published(const Cursor& o) {
    o.members({}, {"source", "rows"});
    plan_.published_source = o.text_or("source");
    plan_.published = items(o, "rows", [](const Cursor& row) {
      row.members({"values"}, {"scene", "method"});
      Published published{row.text_or("scene"), row.text_or("method"), {}};
      for (const auto& [title, unused] : row["values"].entries())
        published.values[title] = row["values"][title.c_str()].precise_number();
      return published;
    });
  }

  void check_words(const PlanMethod& method, const Parameters& parameters, const std::string& where) const {
    std::vector<std::string> known = {"scene"};
    for (const Parameters* list : {&plan_.variables, &parameters}) {
      for (const auto& [key, value] : *list) known.push_back(key);
    }
    for (const Step& step : method.steps) {
      for (const std::string& word : step.words) {
        for (const std::string& name : names_in(word, where)) {
          if (std::ranges::find(known, name) == known.end())
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
      if (!scenes.insert(scene.name).second)
        throw Error(name_ + ": scenes", fmt::format("two scenes are called \"{}\"", scene.name));
    }
    const std::vector<std::string> scene_names(scenes.begin(), scenes.end());
    if (plan_.has_reference) check_words(plan_.reference, {}, name_ + ": reference");
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < plan_.methods.size(); ++i) {
      const PlanMethod& method = plan_.methods[i];
      const std::string where = fmt::format("{}: methods[{}]", name_, i);
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
        throw Error(name_ + ": published", fmt::format("unknown scene \"{}\"", row.scene),
                    nearest_hint(row.scene, scene_names));
      if (!methods.count(row.method))
        throw Error(name_ + ": published", fmt::format("unknown method \"{}\"", row.method),
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

/// The name in 'unknown member "x"', "" for other problems.
std::string quoted_key(const std::string& problem) {
  const std::string_view start = "unknown member \"";
  if (!problem.starts_with(start)) return {};
  return problem.substr(start.size(), problem.rfind('"') - start.size());
}

Plan parse_yaml_plan(std::string_view yaml, const std::string& name,
                     const std::vector<std::string>& commands) {
  const json::Value document = parse_yaml(yaml, name);
  try {
    return PlanReader(name, commands).read(document);
  } catch (const Error& e) {
    const int line = yaml_line(yaml, name, e.where(), quoted_key(e.problem()));
    if (line == 0) throw;
    const std::string place = e.where().substr(std::min(e.where().size(), name.size() + 2));
    throw Error(fmt::format("{}:{}{}{}", name, line, place.empty() ? "" : ": ", place), e.problem(),
                e.hint());
  }
}

}  // namespace

Plan parse_plan(std::string_view text, const std::string& name, const std::vector<std::string>& commands) {
  if (is_yaml_name(name)) return parse_yaml_plan(text, name, commands);
  return PlanReader(name, commands).read(json::parse(text, name));
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
