/// Damaged and hostile files are refused before use, or are used without harm.

#include <cstddef>
#include <cstring>

#include <gtest/gtest.h>

#include <ssphh/runtime/cooked_file.h>

#include "cooked_room.h"

namespace ssphh::test {
namespace {

const std::vector<std::byte>& small_file() {
  static const std::vector<std::byte> file = cook_two_rooms(set_of_two_rooms(OnSurfaces::records, 2), 8);
  return file;
}

void sign(std::vector<std::byte>& file) {
  const std::uint64_t sum = ssphh_cooked_checksum(file.data(), file.size());
  std::memcpy(file.data() + offsetof(ssphh_cooked_header, checksum), &sum, sizeof sum);
}

ssphh_runtime_result open_result(const std::vector<std::byte>& file) {
  std::vector<std::byte> memory(65536);
  ssphh_runtime* runtime = nullptr;
  return ssphh_runtime_open(file.data(), file.size(), memory.data(), memory.size(), &runtime);
}

/// Opens it and, if it opens, looks it up all over.
ssphh_runtime_result use(const std::vector<std::byte>& file) {
  static const std::vector<rays::SurfacePoint> places = places_on_surfaces(40, 3);
  std::vector<std::byte> memory(65536);
  ssphh_runtime* runtime = nullptr;
  const ssphh_runtime_result result =
      ssphh_runtime_open(file.data(), file.size(), memory.data(), memory.size(), &runtime);
  if (result != SSPHH_RUNTIME_OK) return result;
  for (const rays::SurfacePoint& at : places) {
    vec3 e;
    for (const unsigned flags : {0u, 1u}) {
      ssphh_runtime_irradiance(runtime, flags, &at.position.x, &at.normal.x, &e.x);
      EXPECT_FALSE(e.x < 0 || e.y < 0 || e.z < 0 || e != e);
    }
  }
  return result;
}

TEST(DamagedFile, EveryByteThatChangesIsNoticed) {
  std::vector<std::byte> file = small_file();
  ASSERT_EQ(open_result(file), SSPHH_RUNTIME_OK);
  // All of the header, and enough of each section; the rest is the same numbers over and over
  for (std::size_t i = 0; i < file.size(); i += i < 1024 ? 1 : 97) {
    for (const std::byte flip : {std::byte{1}, std::byte{0x80}, std::byte{0xff}}) {
      file[i] ^= flip;
      EXPECT_NE(open_result(file), SSPHH_RUNTIME_OK) << "byte " << i;
      file[i] ^= flip;
    }
  }
  ASSERT_EQ(open_result(file), SSPHH_RUNTIME_OK);
}

TEST(DamagedFile, SaysWhatIsWrong) {
  const std::vector<std::byte> good = small_file();
  const auto with = [&](std::size_t at, std::byte value) {
    std::vector<std::byte> file = good;
    file[at] = value;
    return open_result(file);
  };
  EXPECT_EQ(with(0, std::byte{'X'}), SSPHH_RUNTIME_NOT_COOKED);
  EXPECT_EQ(with(offsetof(ssphh_cooked_header, version), std::byte{SSPHH_COOKED_VERSION + 1}),
            SSPHH_RUNTIME_BAD_VERSION);
  EXPECT_EQ(with(offsetof(ssphh_cooked_header, file_size), std::byte{1}), SSPHH_RUNTIME_CUT_OFF);
  EXPECT_EQ(with(offsetof(ssphh_cooked_header, degree), std::byte{9}), SSPHH_RUNTIME_DAMAGED);
  EXPECT_EQ(with(good.size() - 1, std::byte{9}), SSPHH_RUNTIME_DAMAGED);
}

TEST(DamagedFile, NoBeginningOfAFileOpens) {
  const std::vector<std::byte> file = small_file();
  for (std::size_t size = 0; size < file.size(); size += size < 1024 ? 1 : 509) {
    // Memory of just this size: a sanitizer sees what reads on
    const std::vector<std::byte> part(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
    std::vector<std::byte> memory(65536);
    ssphh_runtime* runtime = nullptr;
    std::size_t needed = 0;
    const void* data = size == 0 ? memory.data() : part.data();
    EXPECT_NE(ssphh_runtime_open(data, size, memory.data(), memory.size(), &runtime), SSPHH_RUNTIME_OK);
    EXPECT_NE(ssphh_runtime_size_needed(data, size, &needed), SSPHH_RUNTIME_OK) << size;
    EXPECT_EQ(runtime, nullptr);
  }
  std::vector<std::byte> longer = file;
  longer.resize(file.size() + 64);
  EXPECT_EQ(open_result(longer), SSPHH_RUNTIME_CUT_OFF);
}

TEST(HostileFile, AnyNumberOfTheHeaderMayLie) {
  const std::vector<std::byte> good = small_file();
  int refused = 0, tried = 0;
  for (std::size_t i = 8; i + 4 <= sizeof(ssphh_cooked_header); i += 4) {
    for (const std::uint32_t value : {0u, 1u, 2u, 7u, 0xffu, 0xffffu, 0x10000u, 0x7fffffffu, 0x80000000u,
                                      0xffffffffu, 0x7fc00000u, 0x7f800000u, 0x3f800000u, 0x00000001u}) {
      std::vector<std::byte> file = good;
      std::memcpy(file.data() + i, &value, sizeof value);
      sign(file);
      ++tried;
      refused += use(file) != SSPHH_RUNTIME_OK;
    }
  }
  EXPECT_GT(refused, tried / 2);
}

TEST(HostileFile, AnyWordOfASectionMayLie) {
  const std::vector<std::byte> good = small_file();
  const auto& header = *reinterpret_cast<const ssphh_cooked_header*>(good.data());
  Pcg32 random(1);
  for (const ssphh_cooked_section& section : header.sections) {
    for (int k = 0; k < 60 && section.size >= 4; ++k) {
      std::vector<std::byte> file = good;
      const std::size_t at = section.offset + random.next() % (section.size / 4) * 4;
      const std::uint32_t values[] = {0, ~0u, 0x7fc00000u, 0x80000000u,
                                      static_cast<std::uint32_t>(random.next())};
      std::memcpy(file.data() + at, &values[k % 5], 4);
      sign(file);
      use(file);
    }
  }
}

/// The word at `at` becomes `value`, and the file is signed: it contradicts itself.
void expect_invalid(std::vector<std::byte> file, std::size_t at, std::uint32_t value, const char* what) {
  std::memcpy(file.data() + at, &value, sizeof value);
  sign(file);
  EXPECT_EQ(use(file), SSPHH_RUNTIME_INVALID) << what;
}

TEST(HostileFile, WhatLookupsFollowIsLookedAt) {
  const std::vector<std::byte> file = small_file();
  const auto& h = *reinterpret_cast<const ssphh_cooked_header*>(file.data());
  const auto begin = [&](int section) { return h.sections[section].offset; };
  const auto last = [&](int section) { return begin(section) + h.sections[section].size - 4; };
  const std::uint32_t nan = 0x7fc00000u, negative = 0xbf800000u;
  expect_invalid(file, begin(SSPHH_COOKED_GROUPS), 1000, "a name beyond the names");
  expect_invalid(file, begin(SSPHH_COOKED_GROUPS) + 4, 3, "a name without an end");
  expect_invalid(file, begin(SSPHH_COOKED_GROUPS) + 4, 5, "a name with an end within");
  expect_invalid(file, begin(SSPHH_COOKED_GROUPS) + 8, negative, "a scale below 0");
  expect_invalid(file, begin(SSPHH_COOKED_GROUPS) + 20, 3, "a mode that there is not");
  expect_invalid(file, begin(SSPHH_COOKED_PROBES), nan, "a probe nowhere");
  expect_invalid(file, begin(SSPHH_COOKED_PROBES) + 12, 0, "a probe that reaches nothing");
  expect_invalid(file, begin(SSPHH_COOKED_PROBE_CELLS), 27, "a probe that there is not");
  expect_invalid(file, begin(SSPHH_COOKED_BRICKS) + 8, 1, "cells of a brick that are others'");
  expect_invalid(file, begin(SSPHH_COOKED_BRICKS), ~0u, "more cells than there are");
  expect_invalid(file, begin(SSPHH_COOKED_CELLS), 1, "lists that do not begin");
  expect_invalid(file, begin(SSPHH_COOKED_CELLS) + 8, ~0u, "a list without an end");
  expect_invalid(file, last(SSPHH_COOKED_CELLS), 0, "masks that are no entry's");
  expect_invalid(file, begin(SSPHH_COOKED_ENTRIES), 300, "a point that there is not");
  expect_invalid(file, begin(SSPHH_COOKED_POINTS) + 4, nan, "a point nowhere");
  expect_invalid(file, begin(SSPHH_COOKED_POINTS) + 12, 0, "a point without spacing");
  expect_invalid(file, begin(SSPHH_COOKED_POINTS) + 16, nan, "a point without normal");
  expect_invalid(file, begin(SSPHH_COOKED_POINTS) + 28, 24, "an axis that there is not");
  expect_invalid(file, begin(SSPHH_COOKED_LIGHT), nan, "light that is no number");
  expect_invalid(file, last(SSPHH_COOKED_LIGHT), 0x7f800000u, "light without end");
}

TEST(HostileFile, NoListIsLongerThanALookupHasRoomFor) {
  std::vector<std::byte> file = small_file();
  const auto& h = *reinterpret_cast<const ssphh_cooked_header*>(file.data());
  auto* cells = reinterpret_cast<ssphh_cooked_cell*>(file.data() + h.sections[SSPHH_COOKED_CELLS].offset);
  // The first cell takes the lists of those behind it
  std::uint32_t end = 1;
  while (cells[end].entry <= SSPHH_COOKED_MOST_LISTED_POINTS) ++end;
  ASSERT_LE(end, h.cell_count);
  for (std::uint32_t i = 1; i < end; ++i) cells[i] = cells[end];
  sign(file);
  EXPECT_EQ(use(file), SSPHH_RUNTIME_INVALID);
}

TEST(HostileFile, NothingStandsBehindTheLastSection) {
  std::vector<std::byte> file = small_file();
  file.resize(file.size() + 64);
  reinterpret_cast<ssphh_cooked_header*>(file.data())->file_size = file.size();
  sign(file);
  EXPECT_EQ(use(file), SSPHH_RUNTIME_INVALID);
}

TEST(HostileFile, SwappedLightMayHoldAnything) {
  const OpenedFile opened(small_file());
  std::vector<std::byte> other = small_file();
  const auto& h = *reinterpret_cast<const ssphh_cooked_header*>(other.data());
  const ssphh_cooked_section light = h.sections[SSPHH_COOKED_LIGHT];
  std::fill_n(other.begin() + static_cast<std::ptrdiff_t>(light.offset), light.size, std::byte{0xff});  // NaN
  ASSERT_EQ(ssphh_runtime_swap_light(opened.runtime, other.data(), other.size()), SSPHH_RUNTIME_OK);
  for (const rays::SurfacePoint& at : places_on_surfaces(20, 3)) EXPECT_EQ(opened.irradiance(at), vec3(0));
}

}  // namespace
}  // namespace ssphh::test
