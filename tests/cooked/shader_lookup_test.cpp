/// ssphh_lookup.glsl on the graphics card, of the file as it lies on the disk, against the C run-time.

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <ssphh/gl/buffer.h>
#include <ssphh/gl/draw.h>
#include <ssphh/gl/program.h>
#include <ssphh/runtime/cooked_file.h>
#include <ssphh/study/surface_points.h>

#include "gl_context.h"
#include "real_bake.h"

namespace ssphh::test {
namespace {

constexpr std::string_view look_up = R"(#version 430
#define SSPHH_BINDING 2
#include "ssphh_lookup.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Places { vec4 places[]; };  // position, 1 in the open; normal
layout(std430, binding = 1) writeonly buffer Results { vec4 results[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (2 * i >= places.length()) return;
  vec3 x = places[2 * i].xyz, n = places[2 * i + 1].xyz;
  results[i] = vec4(places[2 * i].w > 0 ? ssphh_irradiance_open(x, n) : ssphh_irradiance(x, n), 1);
}
)";

struct Shipped {
  explicit Shipped(const RealBake& bake) : file(bake.bytes) {
    places = study::reachable_points(bake.source, bake.origins(), 0, {3000, 5, 0.05f});
    std::vector<rays::SurfacePoint> open = study::points_in_the_open(bake.source, places, 0, 5);
    for (rays::SurfacePoint& at : open) at.moves = true;
    places.insert(places.end(), open.begin(), open.end());
  }

  OpenedFile file;
  std::vector<rays::SurfacePoint> places;
};

const ssphh_cooked_header& header_of(const OpenedFile& file) {
  return *reinterpret_cast<const ssphh_cooked_header*>(file.bytes().data());
}

class ShaderLookup : public WithGl, public testing::WithParamInterface<std::string> {
 protected:
  static const Shipped& shipped(const std::string& name) {
    static std::map<std::string, Shipped> known;
    if (const auto found = known.find(name); found != known.end()) return found->second;
    const std::size_t colon = name.find(':');
    const std::string lit = colon == std::string::npos ? "records" : name.substr(colon + 1);
    return known
        .try_emplace(name, real_bake(name.substr(0, colon), lit == "records"  ? OnSurfaces::records
                                                            : lit == "fitted" ? OnSurfaces::fitted
                                                                              : OnSurfaces::nothing))
        .first->second;
  }

  std::vector<vec4> run(const gl::Buffer& file, const std::vector<rays::SurfacePoint>& places) {
    std::vector<vec4> inputs;
    for (const rays::SurfacePoint& at : places) {
      inputs.emplace_back(at.position, at.moves ? 1 : 0);
      inputs.emplace_back(at.normal, 0);
    }
    const gl::Buffer in{std::span<const vec4>(inputs)};
    const std::vector<vec4> nothing(places.size(), vec4(-1));
    const gl::Buffer out{std::span<const vec4>(nothing)};
    const std::uint32_t groups[] = {static_cast<std::uint32_t>((places.size() + 63) / 64), 1, 1};
    const gl::ShaderFiles::Embedded main[] = {{"look_up.comp", look_up}};
    const gl::Program program = gl::Program::compute(gl::ShaderFiles(main, SSPHH_SHADERS), "look_up.comp");
    in.bind_storage(0);
    out.bind_storage(1);
    file.bind_storage(2);
    program.use();
    gl::dispatch(gl::Buffer(std::span<const std::uint32_t>(groups)));
    gl::shader_memory_barrier();
    std::vector<vec4> results(places.size());
    glGetNamedBufferSubData(out.id(), 0, static_cast<GLsizeiptr>(out.size()), results.data());
    gl().throw_on_error("looking up");
    return results;
  }
};

/// Largest and 99.9 % difference of colours, in shares of the mean, or of the colour itself where it is
/// brighter.
struct Apart {
  double most = 0, nearly_all = 0;
};
Apart apart(const OpenedFile& file, const std::vector<rays::SurfacePoint>& places,
            const std::vector<vec4>& found) {
  std::vector<std::pair<double, double>> colours;
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const vec3 expected = file.irradiance(places[i]);
    for (glm::length_t c = 0; c < 3; ++c) {
      colours.emplace_back(static_cast<double>(expected[c]), static_cast<double>(found[i][c]));
      sum += colours.back().first;
    }
  }
  std::vector<double> differences;
  for (const auto& [expected, e] : colours)
    differences.push_back(std::abs(e - expected) /
                          std::max(sum / static_cast<double>(colours.size()), expected));
  std::ranges::sort(differences);
  return {differences.back(), differences[differences.size() * 999 / 1000]};
}

void expect_alike(const OpenedFile& file, const std::vector<rays::SurfacePoint>& places,
                  const std::vector<vec4>& found) {
  const Apart differs = apart(file, places, found);
  EXPECT_LT(differs.nearly_all, 1e-5);
  EXPECT_LT(differs.most, 1e-4);
}

TEST_P(ShaderLookup, IsTheRuntimes) {
  const Shipped& s = shipped(GetParam());
  const gl::Buffer file{std::span<const std::byte>(s.file.bytes())};
  ASSERT_GT(s.places.size(), 3000u);
  expect_alike(s.file, s.places, run(file, s.places));
}

TEST_P(ShaderLookup, FollowsScalesThatAreWrittenIntoTheBuffer) {
  const Shipped& s = shipped(GetParam());
  gl::Buffer file{std::span<const std::byte>(s.file.bytes())};
  const ssphh_cooked_header& h = header_of(s.file);
  ssphh_runtime* light = s.file.runtime;
  std::vector<vec3> before(h.group_count);
  for (std::uint32_t g = 0; g < h.group_count; ++g) {
    ssphh_runtime_group group;
    ASSERT_EQ(ssphh_runtime_describe_group(light, g, &group), SSPHH_RUNTIME_OK);
    before[g] = {group.scale[0], group.scale[1], group.scale[2]};
    const vec3 scale = g % 3 == 2 ? vec3(0) : before[g] * vec3(0.5f, 2, 0.1f + static_cast<float>(g));
    ASSERT_EQ(ssphh_runtime_set_group_scale(light, g, &scale.x), SSPHH_RUNTIME_OK);
    // As docs/cooked-files.md says
    const std::size_t at = h.sections[SSPHH_COOKED_GROUPS].offset + sizeof(ssphh_cooked_group) * g +
                           offsetof(ssphh_cooked_group, scale);
    file.update_bytes(at, std::as_bytes(std::span(&scale, 1)));
  }
  const std::vector<vec4> found = run(file, s.places);
  expect_alike(s.file, s.places, found);
  for (std::uint32_t g = 0; g < h.group_count; ++g)
    ASSERT_EQ(ssphh_runtime_set_group_scale(light, g, &before[g].x), SSPHH_RUNTIME_OK);
  EXPECT_GT(apart(s.file, s.places, found).most, 0.1) << "the light has changed";
}

TEST_P(ShaderLookup, TakesLightOfAnotherFileByItsRange) {
  const Shipped& s = shipped(GetParam());
  gl::Buffer file{std::span<const std::byte>(s.file.bytes())};
  const ssphh_cooked_section& section = header_of(s.file).sections[SSPHH_COOKED_LIGHT];
  std::vector<std::byte> evening = s.file.bytes();
  std::span<float> floats(reinterpret_cast<float*>(evening.data() + section.offset), section.size / 4);
  for (std::size_t i = 0; i < floats.size(); ++i) floats[i] *= i % 2 == 0 ? 0.25f : 0.75f;
  ASSERT_EQ(ssphh_runtime_swap_light(s.file.runtime, evening.data(), evening.size()), SSPHH_RUNTIME_OK);
  file.update_bytes(section.offset, std::span(evening).subspan(section.offset, section.size));
  const std::vector<vec4> found = run(file, s.places);
  expect_alike(s.file, s.places, found);
  ASSERT_EQ(ssphh_runtime_swap_light(s.file.runtime, s.file.bytes().data(), evening.size()),
            SSPHH_RUNTIME_OK);
  EXPECT_GT(apart(s.file, s.places, found).most, 0.1) << "the light has changed";
}

TEST_P(ShaderLookup, StaysWithinTheFileAtAnyPlace) {
  const Shipped& s = shipped(GetParam());
  const gl::Buffer file{std::span<const std::byte>(s.file.bytes())};
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::vector<rays::SurfacePoint> places;
  for (const bool moves : {false, true})
    for (const float far : {nan, inf, -inf, 1e30f, -1e30f, 1e6f, -1e6f})
      for (glm::length_t axis = 0; axis < 3; ++axis) {
        places.push_back({vec3(0), {0, 1, 0}, moves});
        places.back().position[axis] = far;
      }
  for (const vec4& e : run(file, places)) {
    EXPECT_TRUE(e.x >= 0 && e.y >= 0 && e.z >= 0 && e.x < 1e6f && e.y < 1e6f && e.z < 1e6f);
    EXPECT_EQ(e.w, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ShaderLookup,
                         testing::Values("cornell", "cornell:probes", "gallery1", "gallery1:fitted",
                                         "random?seed=7"),
                         [](const auto& of) {
                           std::string name = of.param;
                           std::erase_if(name,
                                         [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                           return name;
                         });

}  // namespace
}  // namespace ssphh::test
