#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/scene_io/emission_file.h>

#include "gltf_export_parts.h"
#include "read_emission.h"

namespace ssphh::scene_io {
namespace {

constexpr const char* format = "ssphh-emission";
constexpr std::uint64_t max_file_bytes = std::uint64_t{128} << 20;
constexpr std::size_t max_numbers = 3 * sh::max_coefficient_count;

/// `degree`: that every frame must have; −1: of the first one's.
sh::IntensitySh read_frame(const json::Cursor& frame, int& degree) {
  if (frame.value().is_null()) frame.fail("is missing", "a sequence has no gaps: sample it again");
  const std::size_t count = frame.size(3, max_numbers);
  sh::IntensitySh result;
  result.values.resize(count / 3);
  const int own = result.degree();
  if (count % 3 != 0 || static_cast<std::size_t>(sh::coefficient_count(own)) != count / 3) {
    frame.fail(
        fmt::format("has {} numbers", count),
        "3 (degree + 1)² are needed, red, green and blue of each coefficient, for a degree of 0 to 10");
  }
  if (degree >= 0 && own != degree)
    frame.fail(fmt::format("is of degree {} where degree {} is expected", own, degree));
  degree = own;
  for (std::size_t k = 0; k < count; ++k)
    result.values[k / 3][static_cast<glm::length_t>(k % 3)] = frame[k].number();
  return result;
}

json::Value frame_to_json(const sh::IntensitySh& frame) {
  return numbers(std::span(&frame.values[0].x, 3 * frame.values.size()));
}

sh::IntensitySh read_lobe(const json::Cursor& object) {
  const auto lobe = object["lobe"].named<scene::Lobe>();
  const auto direction = object.find("direction");
  const vec3 axis = direction ? direction->vector3() : vec3(0, 0, -1);
  if (!(glm::length(axis) > 0) || !std::isfinite(glm::length(axis))) direction->fail("must not be zero");
  const auto angle = object.find("half_angle_degrees");
  if (angle && lobe != scene::Lobe::beam) angle->fail("only a beam has a half angle");
  try {
    return scene::lobe_emission(lobe, glm::normalize(axis), glm::radians(angle ? angle->number() : 30));
  } catch (const Error& e) {
    object.fail(e.problem(), e.hint());
  }
}

/// The one member that says what is emitted.
std::string source_of(const json::Cursor& object) {
  std::string found;
  for (const char* key : {"file", "lobe", "coefficients", "frames"}) {
    if (!object.has(key)) continue;
    if (!found.empty()) object.fail(fmt::format("has both \"{}\" and \"{}\"", found, key));
    found = key;
  }
  if (found.empty()) object.fail("needs one of \"file\", \"lobe\", \"coefficients\" and \"frames\"");
  return found;
}

}  // namespace

scene::Emission read_frames(const json::Cursor& object) {
  scene::Emission emission;
  int degree = -1;
  if (const auto stated = object.find("degree"))
    degree = static_cast<int>(stated->unsigned_integer(static_cast<std::uint64_t>(sh::max_degree)));
  if (const auto one = object.find("coefficients")) {
    emission.frames.push_back(read_frame(*one, degree));
    return emission;
  }
  const json::Cursor frames = object["frames"];
  for (const json::Cursor& frame : json::elements(frames, 1, scene::max_emission_frames))
    emission.frames.push_back(read_frame(frame, degree));
  const auto rate = object.find("rate");
  if (rate || emission.frames.size() > 1) emission.rate = object["rate"].number();
  if (rate && !(emission.rate > 0)) rate->fail("must be greater than 0 frames per second");
  emission.start = object.number_or("start", 0);
  emission.repeat = object.boolean_or("repeat", false);
  try {
    scene::check_emission(emission, object.place());
  } catch (const Error& e) {
    object.fail(e.problem(), e.hint());
  }
  return emission;
}

json::Value frames_to_json(const scene::Emission& emission) {
  json::Value out = json::Value::object();
  if (emission.frames.size() == 1 && emission.rate == 0) {
    out["coefficients"] = frame_to_json(emission.frames[0]);
    return out;
  }
  out["rate"] = number(emission.rate);
  out["start"] = number(emission.start);
  out["repeat"] = emission.repeat;
  out["frames"] = json::Value::array();
  for (const sh::IntensitySh& frame : emission.frames) out["frames"].push_back(frame_to_json(frame));
  return out;
}

void read_emission(scene::Light& light, const json::Cursor& object, const FileOf& file_of) {
  object.only({"file", "lobe", "direction", "half_angle_degrees", "degree", "coefficients", "frames", "rate",
               "start", "repeat", "color", "intensity"});
  light.type = scene::LightType::sphl;
  if (const auto color = object.find("color")) light.color = color->vector3();
  if (const auto intensity = object.find("intensity")) light.intensity = intensity->number(0, HUGE_VALF);
  const std::string source = source_of(object);
  if (source != "lobe" && (object.has("direction") || object.has("half_angle_degrees")))
    object.fail("only a \"lobe\" has a direction and a half angle");
  if (source != "frames" && (object.has("rate") || object.has("start")))
    object.fail("only \"frames\" have a rate and a start");
  if (source == "lobe") {
    light.emission.frames = {read_lobe(object)};
  } else if (source == "file") {
    EmissionFile file = read_emission_file(file_of(object["file"]));
    const int degree = file.emission.frames[0].degree();
    if (const auto stated = object.find("degree"); stated && stated->number() != static_cast<float>(degree))
      stated->fail(fmt::format("the file's degree is {}", degree));
    light.emission = std::move(file.emission);
    light.emission.repeat = object.boolean_or("repeat", light.emission.repeat);
  } else {
    light.emission = read_frames(object);
  }
}

std::string emission_to_json(const EmissionFile& file) {
  scene::check_emission(file.emission, "emission file");
  json::Value out = {{"format", format}, {"version", emission_file_version}};
  out["scene"] = file.scene;
  out["node"] = file.node;
  out["radius"] = number(file.radius);
  out["degree"] = file.emission.frames[0].degree();
  out.update(frames_to_json(file.emission));
  return json::print(out) + "\n";
}

EmissionFile emission_from_json(std::string_view text, const std::string& where) {
  // What probe files begin with, binary or JSON
  if (text.starts_with("SPHL\r\n") || text.substr(0, 200).find("\"ssphh-probes\"") != text.npos) {
    throw Error(where,
                "is a probe set: the light that arrives at places of a scene, not what a thing sends out",
                "make an emission file with: ssphh sphl sample SCENE --node NAME -o FILE.sphl");
  }
  const json::Value json = json::parse(text, where, {.bytes = max_file_bytes, .depth = 8});
  const json::Cursor root(json, where);
  root.expect_format(format, emission_file_version);
  root.only({"$schema", "format", "version", "scene", "node", "radius", "degree", "coefficients", "frames",
             "rate", "start", "repeat"});
  EmissionFile file;
  file.scene = root.text_or("scene");
  file.node = root.text_or("node");
  file.radius = root["radius"].number();
  if (!(file.radius > 0)) root["radius"].fail("must be greater than 0");
  file.emission = read_frames(root);
  return file;
}

EmissionFile read_emission_file(const std::filesystem::path& path) {
  const std::vector<std::byte> data = read_file(path, max_file_bytes);
  return emission_from_json({reinterpret_cast<const char*>(data.data()), data.size()}, path.string());
}

void write_emission_file(const EmissionFile& file, const std::filesystem::path& path) {
  write_file(path, emission_to_json(file));
}

}  // namespace ssphh::scene_io
