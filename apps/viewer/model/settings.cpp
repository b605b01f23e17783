#include "settings.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/parse_number.h>
#include <ssphh/methods/method_list.h>

namespace ssphh::viewer {
namespace {

/// `member` is a member of Settings, or gives a reference to one of its members' members.
template <class Member>
using Of = std::decay_t<std::invoke_result_t<Member, Settings&>>;

template <class Member>
SettingName choice(const char* name, const char* group, const char* help, Member member) {
  using E = Of<Member>;
  SettingName setting{name, group, help, names_of<E>(), false, {}, {}};
  setting.set = [member, name](Settings& s, const std::string& text) {
    std::invoke(member, s) = enum_named<E>(name, text);
  };
  setting.get = [member](const Settings& s) { return std::string(name_of(std::invoke(member, s))); };
  return setting;
}

/// A word out of a list that is known at run time only.
template <class Member>
SettingName word(const char* name, const char* group, const char* help, std::vector<std::string> words,
                 Member member) {
  SettingName setting{name, group, help, std::move(words), false, {}, {}};
  setting.set = [member, name, words = setting.choices](Settings& s, const std::string& text) {
    if (std::ranges::find(words, text) == words.end()) throw Error(name, none_of(text, words));
    std::invoke(member, s) = text;
  };
  setting.get = [member](const Settings& s) { return std::invoke(member, s); };
  return setting;
}

std::vector<std::string> truth_names() {
  std::vector<std::string> names = {"path"};
  for (const methods::MethodEntry& entry : methods::all_methods()) names.emplace_back(entry.name);
  return names;
}

template <class Member>
SettingName toggle(const char* name, const char* group, const char* help, Member member) {
  SettingName setting{name, group, help, {"off", "on"}, false, {}, {}};
  setting.set = [member, name, words = setting.choices](Settings& s, const std::string& text) {
    if (text != "off" && text != "on") throw Error(name, none_of(text, words));
    std::invoke(member, s) = text == "on";
  };
  setting.get = [member](const Settings& s) { return std::string(std::invoke(member, s) ? "on" : "off"); };
  return setting;
}

template <class Member>
SettingName number(const char* name, const char* group, const char* help, float low, float high,
                   Member member) {
  SettingName setting{name, group, help, {}, false, {}, {}};
  setting.set = [member, name, low, high](Settings& s, const std::string& text) {
    const float value = number_of(name, text);
    if (!(value >= low && value <= high))
      throw Error(name, fmt::format("{} is not within {:g} to {:g}", text, low, high));
    using T = Of<Member>;
    if (std::is_integral_v<T> && value != std::round(value))
      throw Error(name, fmt::format("{} is not a whole number", text));
    std::invoke(member, s) = static_cast<T>(value);
  };
  setting.get = [member](const Settings& s) {
    return fmt::format("{:g}", static_cast<double>(std::invoke(member, s)));
  };
  return setting;
}

SettingName exposure_setting() {
  SettingName setting = number("exposure", "Picture", "Stops; auto: follows what suits the picture", -20, 20,
                               &Settings::exposure);
  setting.or_auto = true;
  setting.set = [set_number = setting.set](Settings& s, const std::string& text) {
    if (text != "auto") set_number(s, text);
    s.auto_exposure = text == "auto";
  };
  setting.get = [get_number = setting.get](const Settings& s) {
    return s.auto_exposure ? "auto" : get_number(s);
  };
  return setting;
}

SettingName draw_setting() {
  SettingName setting{"draw",
                      "Picture",
                      "What methods hold, over the picture: tetrahedra, hierarchy, links, surfels, photons, "
                      "voxels or transfer, or several with commas between; none. As `ssphh render --draw`",
                      names_of<methods::Drawing>(),
                      false,
                      {},
                      {}};
  setting.choices.insert(setting.choices.begin(), "none");
  setting.set = [words = setting.choices](Settings& s, const std::string& text) {
    std::vector<methods::Drawing> chosen;
    std::istringstream in(text == "none" ? "" : text);
    for (std::string word; std::getline(in, word, ',');) {
      const auto drawing = parse_enum<methods::Drawing>(word);
      if (!drawing) throw Error("draw", none_of(word, words));
      if (std::ranges::count(chosen, *drawing) == 0) chosen.push_back(*drawing);
    }
    s.draw = std::move(chosen);
  };
  setting.get = [](const Settings& s) {
    std::string text;
    for (const methods::Drawing drawing : s.draw)
      text += (text.empty() ? "" : ",") + std::string(name_of(drawing));
    return text.empty() ? "none" : text;
  };
  return setting;
}

}  // namespace

const std::vector<SettingName>& setting_names() {
  static const std::vector<SettingName> names = {
      exposure_setting(),
      choice("tonemap", "Picture", "Curve: clip at white, or filmic", &Settings::curve),
      choice("debug", "Picture",
             "What the real-time picture holds: none (all), direct or indirect light only, albedo, normal, "
             "shadow, sphl (which one lights a place), leak (looked-up light that no path brings)",
             &Settings::debug),
      toggle(
          "antialias", "Picture",
          "A picture that stands still is drawn 16 times, moved by parts of a pixel, and shown as the mean: "
          "edges without steps. Not while it is compared with a truth",
          &Settings::antialias),
      draw_setting(),
      toggle("false-color", "Picture",
             "Each pixel in a colour for its luminance, a band for each stop from middle grey, with a legend",
             &Settings::false_color),
      toggle("histogram", "Picture", "Shares of the pixels by their luminance, in stops from middle grey",
             &Settings::histogram),
      toggle("waveform", "Picture",
             "Red, green and blue over the picture's columns, in stops from middle grey",
             &Settings::waveform),
      number(
          "views", "Picture",
          "Views side by side: 2 with one from above, 3 with one from the front, 4 with one from the right",
          1, most_views, &Settings::views),
      number("scale", "Picture", "Pixels drawn per pixel of the window, along each axis", 0.1f, 2,
             &Settings::scale),
      number("indirect-scale", "Picture",
             "Look indirect light up at every n-th pixel each way, interpolate where that hardly differs; 1 "
             "where a truth is shown beside",
             1, 8, &Settings::indirect_scale),
      choice(
          "show", "Ground truth",
          "realtime; truth (path traced); wipe (one beside the other); their difference: absolute, signed, "
          "pixelated (summed in blocks)",
          &Settings::show),
      number("wipe", "Ground truth", "Place of the wipe's line, 0 left, 1 right", 0, 1, &Settings::wipe),
      number("block", "Ground truth", "Pixels along a block of the pixelated difference", 1, 1024,
             &Settings::block),
      word("against", "Ground truth",
           "What is traced beside the real-time picture: path (the truth), or direct light with another "
           "method's indirect light; `ssphh methods` tells of each",
           truth_names(), &Settings::against),
      number("truth-depth", "Ground truth", "Scattering events of a path", 0, 1000, &Settings::truth_depth),
      number("truth-spp", "Ground truth", "Samples per pixel, one a pass", 1, 1000000,
             &Settings::truth_passes),
      choice(
          "quality", "Probes",
          "How much the window spends on the probes' light, live and by GEN and VIZ: window (soon there), or "
          "draft, good, best as bake --quality",
          &Settings::quality),
      choice("lookup", "Probes",
             "irradiance: blend of visible SPHLs; light: nearest visible SPHL, as the paper",
             &Settings::lookup),
      choice("weights", "Probes",
             "How the lookup irradiance finds light: surface by records of surfaces where there are any; "
             "fitted by such weights of a file; else as mls, which fits to probes; distance averages",
             &Settings::weights),
      choice("layer", "Probes", "Light of the probes that surfaces get: sum, self or neighbor",
             &Settings::layer),
      number("degree", "Probes", "Bands that the lookup keeps", 0, probes::max_irradiance_degree,
             &Settings::degree),
      toggle("hier", "Probes", "Add the neighbours' light over the edges that the set has", &Settings::hier),
      choice(
          "operator", "Probes", "What HIER multiplies with",
          [](auto& s) -> auto& { return s.hier_params.op; }),
      number(
          "neighbors", "Probes", "At most so many neighbours a probe; -1: all", -1, 65536,
          [](auto& s) -> auto& { return s.hier_params.neighbors; }),
      number(
          "threshold", "Probes", "Only edges with P above this", 0, 1,
          [](auto& s) -> auto& { return s.hier_params.threshold; }),
      toggle("balls", "Probes on the screen", "A ball where each probe stands", &Settings::balls),
      choice("ball", "Probes on the screen", "What colours the balls", &Settings::ball),
      number("ball-size", "Probes on the screen", "Radius of the balls [m]; 0: by the probes' distance", 0,
             1000, &Settings::ball_size),
      toggle("lobes", "Probes on the screen", "Balls bulge where light comes from", &Settings::lobes),
      toggle("graph", "Probes on the screen",
             "Edges of the hierarchy, strong ones bright (the paper's Figure 9)", &Settings::graph),
      toggle("names", "Probes on the screen", "Names of the probes", &Settings::names),
      toggle("snap", "Handles in the picture",
             "Drags of places and directions go in steps, and freely with Ctrl; off: the other way round",
             &Settings::snap),
      number("snap-step", "Handles in the picture",
             "Step of places [m]; 0: as suits the scene, a tenth of a metre in a room", 0, 1e6f,
             &Settings::snap_step),
      number("snap-angle", "Handles in the picture", "Step of angles [degrees]", 0.1f, 180,
             &Settings::snap_angle),
      toggle("play", "Time", "Play the scene's animations over and over", &Settings::play),
      number("speed", "Time", "Seconds of the scene per second", -100, 100, &Settings::speed),
  };
  return names;
}

void set_setting(Settings& settings, const std::string& name, const std::string& value) {
  std::vector<std::string> known;
  for (const SettingName& setting : setting_names()) {
    if (setting.name == name) return setting.set(settings, value);
    known.push_back(setting.name);
  }
  throw Error(name, "is no setting", fmt::format("there are: {}", fmt::join(known, ", ")));
}

float number_of(const std::string& where, const std::string& text) {
  if (const auto number = ssphh::parse_number<float>(text)) return *number;
  throw Error(where, fmt::format("\"{}\" is not a number", text));
}

}  // namespace ssphh::viewer
