#pragma once
/// A plan: which command lines are measured, in which scenes, and what of their results is shown
/// (docs/report.md). Plain data, read from JSON or YAML.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <ssphh/image/image.h>

namespace ssphh::report {

/// A part of the picture, shown enlarged and measured by itself: fractions of width and height from the upper
/// left. With a mask the rectangle bounds it, and only its pixels are measured.
struct Inset {
  std::string name;
  double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
  std::string mask_file = {};  ///< picture that is white where the region is; empty: the whole rectangle
  image::Image mask = {};      ///< by load_masks(); may have another size than the pictures
};

/// Names and values, in the order in which the plan has them.
using Parameters = std::vector<std::pair<std::string, std::string>>;

struct PlanScene {
  std::string name, title;
  std::vector<std::string> words;  ///< what {scene} stands for: a file or builtin:NAME, then options
  std::optional<double> exposure;  ///< EV at which the page opens; none: what suits the reference
  Parameters variables;            ///< in place of the plan's
  std::vector<Inset> insets;
  bool optional = false;  ///< left out, with a note, where it cannot be loaded
};

/// One command line of the tool, without its name; `{…}` stands for the scene, a parameter or a variable.
struct Step {
  std::string name;  ///< by which columns refer to it; the command's name unless given
  std::vector<std::string> words;
};

/// Steps run one after the other; a word that names an output of an earlier step stands for that file.
struct PlanMethod {
  std::string name, title, about;
  std::vector<Step> steps;
  std::string picture;               ///< output that is looked at; empty: only numbers
  std::vector<std::string> halves;   ///< instead: two pictures of independent random numbers
  std::vector<Parameters> variants;  ///< at least one, which may be empty
  int repetitions = 1;               ///< runs with --seed 0, 1, …
  std::vector<std::string> scenes;   ///< empty: all
};

struct Column {
  std::string value;  ///< name of a value of a cell, "relmse" or "bake.gen_seconds"
  std::string title, unit;
  int better = 0;  ///< −1: smaller is better, 1: larger
};

struct Chart {
  std::string title, x, y;  ///< names of a parameter or value
  bool log_x = false, log_y = false;
};

/// Numbers that somebody else printed for the same cell; by column title.
struct Published {
  std::string scene, method;  ///< method with its parameters, as label() gives it
  std::map<std::string, double> values;
};

struct Plan {
  std::string title, about;
  Parameters variables;
  std::vector<PlanScene> scenes;
  bool has_reference = false;
  PlanMethod reference;
  std::vector<PlanMethod> methods;
  /// Pictures beside the one named, OUT.LAYER.exr, that are compared as well; "irradiance" is made of
  /// indirect and albedo.
  std::vector<std::string> layers;
  std::vector<Column> columns;
  std::vector<Chart> charts;
  std::string published_source;
  std::vector<Published> published;
  int block = 16;         ///< pixels along a block of the pixelated map
  int time_limit = 3600;  ///< seconds that a command may take
};

/// Reads a plan: YAML when `name`, which stands for the file in messages, ends with .yaml or .yml, else JSON.
/// `commands` are the tool's. Throws Error for what is no plan, naming the place (in YAML with its line) and
/// for an unknown key, command or variable the nearest known one.
Plan parse_plan(std::string_view text, const std::string& name, const std::vector<std::string>& commands);

/// Reads the masks of insets, from the plan's folder first, and bounds them. Throws Error for a file that is
/// no picture or a mask without a white pixel.
void load_masks(Plan& plan, const std::filesystem::path& folder);

/// Replaces a variable's value, "spp=16". Throws Error for one that the plan does not have, naming the
/// nearest.
void set_variable(Plan& plan, const std::string& assignment);

/// "ssphh, degree 4": the method's name and the variant's parameters.
std::string label(const PlanMethod& method, const Parameters& parameters);

}  // namespace ssphh::report
