/// Every number of cooked files, section by section, and all that is said of what they lose.

#include <bit>
#include <cstring>

#include <gtest/gtest.h>

#include <ssphh/probes/hier.h>
#include <ssphh/runtime/cooked_file.h>

#include "cooked_room.h"
#include "expected_text.h"
#include "scene_text.h"

namespace ssphh::test {
namespace {

/// Each weighted by its place; of masks the bits of either half, so that one at a border that another machine
/// rounds otherwise does not decide.
template <class T>
std::string numbers_text(const std::vector<std::byte>& file, int section) {
  const auto& header = *reinterpret_cast<const ssphh_cooked_header*>(file.data());
  const ssphh_cooked_section& s = header.sections[section];
  if (s.size == 0) return "nothing";
  const T* values = reinterpret_cast<const T*>(file.data() + s.offset);
  const std::size_t count = s.size / sizeof(T);
  double sum = 0, other = 0;
  for (std::size_t i = 0; i < count; ++i) {
    double a = 0, b = 0;
    if constexpr (sizeof(T) == 8) {
      a = std::popcount(values[i] & 0xffffffffu), b = std::popcount(values[i] >> 32);
    } else {
      a = static_cast<double>(values[i]), b = a * a;
    }
    sum += weight(i) * a, other += weight(i + count) * b;
  }
  return fmt::format("{}: {:.6g} {:.6g}", count, sum, other);
}

/// A struct's 32-bit words, of which those in `whole` (a bit each of `stride`) are no floats.
std::string structs_text(const std::vector<std::byte>& file, int section, std::size_t stride,
                         unsigned whole) {
  const auto& header = *reinterpret_cast<const ssphh_cooked_header*>(file.data());
  const ssphh_cooked_section& s = header.sections[section];
  double sum = 0;
  for (std::size_t i = 0; i < s.size / 4; ++i) {
    std::uint32_t word = 0;
    std::memcpy(&word, file.data() + s.offset + 4 * i, 4);
    const bool is_whole = whole >> i % stride & 1u;
    sum +=
        weight(i) * (is_whole ? static_cast<double>(word) : static_cast<double>(std::bit_cast<float>(word)));
  }
  return fmt::format("{}: {:.6g}", s.size / 4 / stride, sum);
}

std::string header_text(const ssphh_cooked_header& h) {
  std::string text = fmt::format(
      "  header {} {}, scene {} {}, time {:g}, {} groups, {} probes of degree {}, stride {}, sight {}\n"
      "  lists of {}, spacing {:.6g}, origin {:.6g} {:.6g} {:.6g}, cell {:.6g}, cells {} {} {}\n"
      "  {} points of {} floats, {} cells, {} entries, {} masks\n",
      h.version, h.header_size, h.scene[0], h.scene[1], h.time, h.group_count, h.probe_count, h.degree,
      h.probe_stride, h.sight_size, h.probe_list_length, h.probe_spacing, h.probe_origin[0],
      h.probe_origin[1], h.probe_origin[2], h.probe_cell_size, h.probe_cells[0], h.probe_cells[1],
      h.probe_cells[2], h.point_count, h.point_floats, h.cell_count, h.entry_count, h.mask_count);
  for (const ssphh_cooked_grid& g : h.surface_grids)
    text +=
        fmt::format("  grid {:.6g} {:.6g} {:.6g}, cell {:.6g}, {} {} {} from {}\n", g.origin[0], g.origin[1],
                    g.origin[2], g.cell_size, g.cells[0], g.cells[1], g.cells[2], g.first_brick);
  for (const ssphh_cooked_section& s : h.sections) text += fmt::format(" {}+{}", s.offset, s.size);
  return text + fmt::format(", {} bytes\n", h.file_size);
}

std::string cooked_text(const cook::Cooked& cooked) {
  const std::vector<std::byte>& file = cooked.bytes;
  const auto& h = *reinterpret_cast<const ssphh_cooked_header*>(file.data());
  std::string text = header_text(h);
  const auto add = [&](const char* name, const std::string& numbers) {
    text += fmt::format("  {} {}\n", name, numbers);
  };
  for (std::uint32_t g = 0; g < h.group_count; ++g) {
    const auto* group =
        reinterpret_cast<const ssphh_cooked_group*>(file.data() + h.sections[SSPHH_COOKED_GROUPS].offset) + g;
    const auto* names = reinterpret_cast<const char*>(file.data()) + h.sections[SSPHH_COOKED_NAMES].offset;
    text += fmt::format("  group \"{}\" at {}, {} long, {:g} {:g} {:g}, mode {}\n", names + group->name,
                        group->name, group->length, group->scale[0], group->scale[1], group->scale[2],
                        group->mode);
  }
  add("probes", numbers_text<float>(file, SSPHH_COOKED_PROBES));
  add("cells of probes", numbers_text<std::uint16_t>(file, SSPHH_COOKED_PROBE_CELLS));
  add("sight", numbers_text<std::uint16_t>(file, SSPHH_COOKED_SIGHT));
  add("bricks", numbers_text<std::uint32_t>(file, SSPHH_COOKED_BRICKS));
  add("cells", numbers_text<std::uint32_t>(file, SSPHH_COOKED_CELLS));
  add("entries", numbers_text<std::uint32_t>(file, SSPHH_COOKED_ENTRIES));
  add("masks", numbers_text<std::uint64_t>(file, SSPHH_COOKED_MASKS));
  add("points", structs_text(file, SSPHH_COOKED_POINTS, 8, 0x80));
  add("light", numbers_text<float>(file, SSPHH_COOKED_LIGHT));
  text += fmt::format("  told: {} points, {} cells, {} entries, {} of sight, {} of lists, {} of light\n",
                      cooked.points, cooked.cells, cooked.entries, cooked.sight_bytes, cooked.list_bytes,
                      cooked.light_bytes);
  for (const std::string& line : cooked.lost) text += "  lost: " + line + "\n";
  return text;
}

class CookedList : public testing::Test {
 protected:
  void add(const char* name, const probes::ProbeSet& set, const cook::CookParams& params = {8}) {
    text_ += fmt::format("{}\n{}", name, cooked_text(cook::cook(set, &cook_scene_, params)));
  }
  void add_without_scene(const char* name, const probes::ProbeSet& set) {
    text_ += fmt::format("{}\n{}", name, cooked_text(cook::cook(set, nullptr)));
  }
  const scene::Scene scene_ = two_rooms_with_a_wall();
  const TriangleSource source_{scene_};
  const cook::CookScene cook_scene_{scene_, source_};
  std::string text_;
};

TEST_F(CookedList, OfEveryKindOfSet) {
  const probes::ProbeSet records = set_of_two_rooms(OnSurfaces::records);
  add("records", records);
  add("records, all seen", records, {0});
  add("fitted", set_of_two_rooms(OnSurfaces::fitted));
  for (const int degree : {0, 1, 2, 3, 4}) add("probes", set_of_two_rooms(OnSurfaces::nothing, degree));
  add_without_scene("records, no scene", records);
  add_without_scene("fitted, no scene", set_of_two_rooms(OnSurfaces::fitted));

  probes::ProbeSet kept = set_of_two_rooms(OnSurfaces::records, 2);
  kept.light_groups[0].mode = scene::LightMode::diffuse;
  kept.surface->direct.resize(2);
  kept.surface->direct[0] = kept.surface->groups[2];
  kept.surface->direct[1] = kept.surface->groups[0];
  for (probes::Probe& probe : kept.probes) probe.groups[0].emitted = probe.groups[2].reflected;
  kept.generator.time = 0.5f;
  kept.baseline.emplace();
  kept.fitted = set_of_two_rooms(OnSurfaces::fitted).fitted;
  probes::merge_groups(kept);
  add("direct light kept", kept);

  probes::ProbeSet hierarchy = set_of_two_rooms(OnSurfaces::records, 2);
  for (std::size_t i = 1; i < hierarchy.probes.size(); ++i) {
    hierarchy.probes[i].edges.push_back({.from = static_cast<int>(i) - 1,
                                         .transfer = 0.1f,
                                         .h = hierarchy.probes[i].groups[0].reflected,
                                         .matrix = {}});
  }
  probes::hier(hierarchy, {.neighbors = 2});
  add("a hierarchy", hierarchy);
  hierarchy.probes.resize(2), hierarchy.hierarchy.reset(), hierarchy.surface.reset();
  hierarchy.probes[0].edges.clear();
  add("one edge", hierarchy);
  hierarchy.probes.resize(1);
  add("one probe", hierarchy);
  add_without_scene("one probe, no scene", hierarchy);
  expect_text_of("libs/cook/tests/expected/cooked.txt", text_);
}

TEST_F(CookedList, OfLightAtThePlacesOfAnotherSet) {
  const probes::ProbeSet set = set_of_two_rooms(OnSurfaces::records, 2);
  probes::ProbeSet places = set;
  // Some of its own, some between them, some out of reach of all
  places.surface->points = {set.surface->points[7], set.surface->points[8]};
  for (const rays::SurfacePoint& at : places_on_surfaces(30, 77)) places.surface->points.push_back(at);
  places.surface->points.push_back({{40, 50, 60}, {0, 1, 0}});
  places.surface->points.push_back({set.surface->points[7].position, -set.surface->points[7].normal});
  for (auto& group : places.surface->groups) group.assign(places.surface->points.size(), {});
  probes::ProbeSet kept = set;
  kept.surface->direct.resize(2);
  kept.surface->direct[1] = kept.surface->groups[0];
  add("elsewhere", set, {8, &places});
  add("elsewhere, with direct light", kept, {8, &places});
  places.fitted = set_of_two_rooms(OnSurfaces::fitted).fitted;
  places.surface.reset();
  probes::ProbeSet fitted = set_of_two_rooms(OnSurfaces::nothing, 2);
  add("fitted elsewhere", fitted, {8, &places});
  expect_text_of("libs/cook/tests/expected/cooked-elsewhere.txt", text_);
}

}  // namespace
}  // namespace ssphh::test
