/// Cameras, lights and the environment of a glTF file.

#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include <ssphh/image/io.h>
#include <ssphh/scene/area_lamp.h>

#include "gltf_names.h"
#include "gltf_parts.h"
#include "printable.h"
#include "read_light_groups.h"
#include "uri.h"

namespace ssphh::scene_io {

using scene::Camera;
using scene::Environment;
using scene::Light;
using scene::LightType;

Camera import_camera(const json::Cursor& camera) {
  Camera out;
  out.name = camera.text_or("name");
  const json::Cursor type = camera["type"];
  if (type.text() == "perspective") {
    const json::Cursor perspective = camera["perspective"];
    out.yfov = perspective["yfov"].number();
    if (!(out.yfov > 0 && out.yfov < pi)) {
      perspective["yfov"].fail(fmt::format("{} must be between 0 and π", out.yfov));
    }
    if (const auto aspect = perspective.find("aspectRatio")) {
      out.aspect = aspect->number();
      if (!(*out.aspect > 0)) aspect->fail("must be greater than 0");
    }
  } else if (type.text() == "orthographic") {
    const json::Cursor orthographic = camera["orthographic"];
    // In double: quotients of two floats are not every float, and the aspect is to come back as it was.
    const double xmag = std::abs(orthographic["xmag"].precise_number());
    const float ymag = std::abs(orthographic["ymag"].number());
    if (!(xmag > 0 && ymag > 0)) orthographic.fail("xmag and ymag must not be 0");
    out.orthographic = true;
    out.yheight = 2 * ymag;
    out.aspect = static_cast<float>(xmag / static_cast<double>(ymag));
    if (!std::isfinite(*out.aspect) || !(*out.aspect > 0) || !std::isfinite(out.yheight)) {
      orthographic.fail("xmag and ymag are out of proportion");
    }
  } else {
    type.fail(fmt::format("\"{}\" is neither perspective nor orthographic", printable(type.text(), 40)));
  }
  return out;
}

FileOf files_beside(const GltfDocument& document) {
  return [&document](const json::Cursor& member) {
    return resolve_uri(member.text(), document.path(), member.place());
  };
}

Light import_light(const json::Cursor& light, const GltfDocument& document) {
  Light out;
  out.name = light.text_or("name");
  out.group = light_group_extra(light);
  out.type = read_word(gltf_light_types, light["type"]);
  if (const auto color = light.find("color")) out.color = color->vector3();
  if (const auto intensity = light.find("intensity")) out.intensity = intensity->number(0, HUGE_VALF);
  if (const auto range = light.find("range")) {
    out.range = range->number();
    if (!(out.range > 0)) range->fail("must be greater than 0");
  }
  if (out.type == LightType::directional) out.range = 0;
  if (out.type == LightType::spot) {
    const json::Cursor spot = light["spot"];
    out.inner_cone = spot.number_or("innerConeAngle", 0);
    out.outer_cone = spot.number_or("outerConeAngle", pi / 4);
    if (!(out.inner_cone >= 0 && out.inner_cone < out.outer_cone && out.outer_cone <= pi / 2 + 1e-6f)) {
      spot.fail(fmt::format("cone angles {} and {} must rise from 0 to at most π/2", out.inner_cone,
                            out.outer_cone));
    }
  }

  // Spheres, discs and flat lamps of this project's extras
  const auto more = extra(light, "ssphh");
  const std::string type = more ? more->text_or("type") : "";
  const auto positive = [](const json::Cursor& member) {
    const float value = member.number();
    if (!(value > 0)) member.fail("must be greater than 0");
    return value;
  };
  const auto take_radiance = [&](const char* extent, float area) {
    const auto radiance = more->find("radiance");
    out.intensity = radiance ? radiance->number(0, HUGE_VALF) : out.intensity / area;
    if (!std::isfinite(out.intensity)) (*more)[extent].fail("is too small for the light's intensity");
  };
  if (type == name_of(LightType::sphere)) {
    if (out.type != LightType::point) more->fail("only a point light can be a sphere");
    out.type = LightType::sphere;
    out.radius = positive((*more)["radius"]);
    take_radiance("radius", pi * out.radius * out.radius);
  } else if (type == name_of(LightType::rectangle) || type == name_of(LightType::disc)) {
    if (out.type != LightType::spot) more->fail(fmt::format("only a spot light can be a {}", type));
    const bool disc = type == name_of(LightType::disc);
    out.type = disc ? LightType::disc : LightType::rectangle;
    out.inner_cone = scene::Light{}.inner_cone, out.outer_cone = scene::Light{}.outer_cone;
    const char* extent = disc ? "radius" : "size";
    if (disc) {
      out.radius = positive((*more)[extent]);
    } else {
      const json::Cursor size = (*more)[extent];
      size.size(2, 2);
      out.size = {positive(size[0]), positive(size[1])};
    }
    take_radiance(extent, scene::lamp_area(out));
  } else if (type == name_of(LightType::sphl)) {
    if (out.type != LightType::point) more->fail("only a point light can be an SPHL");
    out.radius = positive((*more)["radius"]);
    out.intensity = 1;
    read_emission(out, (*more)["emission"], files_beside(document));
  } else if (more && more->find("type")) {
    (*more)["type"].fail("can only be \"sphere\", \"sphl\", \"rectangle\" or \"disc\"");
  }
  if (more && more->find("angular_radius")) {
    if (out.type != LightType::directional) more->fail("only a directional light can have an angular_radius");
    out.angular_radius = (*more)["angular_radius"].number(0, pi / 2);
  }
  return out;
}

void import_environment(GltfImport& import, const json::Cursor& gltf_scene) {
  const auto extras = extra(gltf_scene, "ssphh");
  const auto environment = extras ? extras->find("environment") : std::nullopt;
  if (!environment) return;
  Environment out;
  out.name = environment->text_or("name", out.name);
  out.group = environment->text_or("light_group");
  if (const auto color = environment->find("color")) out.color = color->vector3();
  out.rotation = environment->number_or("rotation", 0);
  if (const auto image = environment->find("image")) {
    std::vector<std::byte> storage;
    const auto bytes = image_bytes(import.document, *image, storage);
    if (image->find("bufferView")) {
      const std::uint64_t width = (*image)["width"].unsigned_integer(65536),
                          height = (*image)["height"].unsigned_integer(65536);
      if (width == 0 || height == 0 || bytes.size() != width * height * 3 * sizeof(float)) {
        image->fail(fmt::format("{}×{} RGB floats are {} bytes, the bufferView has {}", width, height,
                                width * height * 3 * sizeof(float), bytes.size()));
      }
      import.document.charge(bytes.size(), *image);
      out.equirect = image::Image(static_cast<int>(width), static_cast<int>(height), 3);
      std::memcpy(out.equirect.pixels.data(), bytes.data(), bytes.size());
    } else if (!bytes.empty()) {
      out.equirect = image::decode_image(bytes, fmt::format("{}: {}", image->file(), image->path()));
    }
    for (const float v : out.equirect.pixels) {
      if (!std::isfinite(v)) image->fail("has NaN or infinite pixels");
    }
  }
  import.scene.environment = std::move(out);
}

void import_light_groups(GltfImport& import) {
  GltfDocument& document = import.document;
  if (document.count("scenes") == 0) return;
  const int shown = document.reference(document.root(), "scene", "scenes").value_or(0);
  const auto extras = extra(document.item("scenes", shown), "ssphh");
  if (!extras) return;
  if (const auto dark = extras->find("dark_groups")) read_dark_groups(import.scene, *dark);
  if (const auto modes = extras->find("light_modes")) read_light_modes(import.scene, *modes);
}

}  // namespace ssphh::scene_io
