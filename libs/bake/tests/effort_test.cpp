#include <gtest/gtest.h>

#include <ssphh/bake/effort.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::bake {
namespace {

TEST(Effort, GoodIsWhatTheLibraryDoesUnlessToldOtherwise) {
  const Effort good = effort_of(Quality::good);
  const TransportBakeParams usual;
  EXPECT_EQ(good, Effort{});
  EXPECT_EQ(good.spp, rays::PathParams{}.spp);
  EXPECT_EQ(good.link_rays, usual.transport.link_rays);
  EXPECT_EQ(good.surfels_per_radius, usual.transport.surfels_per_radius);
  EXPECT_EQ(good.most_surfels, usual.transport.most_surfels);
  EXPECT_EQ(good.records, transport::usual_records);
}

TEST(Effort, EachQualitySpendsMoreOfEverything) {
  const Effort draft = effort_of(Quality::draft), good = effort_of(Quality::good),
               best = effort_of(Quality::best);
  for (const auto number :
       {+[](const Effort& e) { return double{e.surfels_per_radius}; },
        +[](const Effort& e) { return double(e.spp); }, +[](const Effort& e) { return double(e.directions); },
        +[](const Effort& e) { return double(e.link_rays); },
        +[](const Effort& e) { return double(e.most_surfels); },
        +[](const Effort& e) { return double(e.records); }}) {
    EXPECT_LT(number(draft), number(good));
    EXPECT_LT(number(good), number(best));
  }
  EXPECT_LE(static_cast<std::size_t>(best.records), transport::most_records);
}

TEST(Effort, MemoryIsSharedBySurfelsAndTheirRays) {
  constexpr std::uint64_t megabyte = 1000000;
  EXPECT_EQ(surfels_within(64 * megabyte + (2000 + 45 * 128) * 5000ull, 128), 5000);
  EXPECT_EQ(surfels_within(64 * megabyte + (2000 + 45 * 256) * 5000ull, 256), 5000);
  EXPECT_EQ(surfels_within(0, 128), 1000) << "the least that there can be";
  EXPECT_EQ(surfels_within(~0ull, 4), 16000000) << "the most";
}

}  // namespace
}  // namespace ssphh::bake
