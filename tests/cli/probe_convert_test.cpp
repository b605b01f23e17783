// `ssphh probe convert`.

#include <filesystem>

#include <gmock/gmock.h>

#include "error_message.h"
#include "probe_tool.h"

namespace ssphh {
namespace {

using test::json_here;
using test::ProbeTool;
using test::problem_here;
using test::text_here;
using testing::HasSubstr;

TEST_F(ProbeTool, ConvertTellsTheSizeOfWhatItWrote) {
  const std::string text = dir_ / "a.sphl.json";
  const json::Value result = json_here({"probe", "convert", file_, "-o", text});
  EXPECT_EQ(result, json::Value({{"output", text},
                                 {"probes", 3},
                                 {"bytes", std::filesystem::file_size(text)},
                                 {"pack", "none"},
                                 {"degree", 1},
                                 {"function_bytes", 48},
                                 {"light_bytes", 3 * 3 * 48}}));
  EXPECT_EQ(probes::read_probe_file(text).probes.size(), 3u);
}

TEST_F(ProbeTool, ConvertPacksLightAndTellsWhatItLost) {
  const json::Value result = json_here({"probe", "convert", file_, "-o", out_, "--pack", "rgb9e5"});
  EXPECT_EQ(result["pack"], "rgb9e5");
  EXPECT_EQ(result["degree"], 1);
  EXPECT_EQ(result["function_bytes"], 13);
  EXPECT_EQ(result["light_bytes"], 3 * 3 * 13) << "three probes, three functions each";
  EXPECT_EQ(result["bytes"], std::filesystem::file_size(out_));
  EXPECT_EQ(result["left_out"], json::Value({"6 edges between probes, which `ssphh hier` needs"}));
  const json::Value& error = result["irradiance_error"];
  EXPECT_EQ(error["dark_probes"], 0);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_GT(error["mean"][c].number(), 0);
    EXPECT_GE(error["p95"][c].number(), error["mean"][c].number());
    EXPECT_GE(error["max"][c].number(), error["p95"][c].number());
    // The sky of probe c is four times as sloped as a light that is nowhere negative can be, and is cut.
    EXPECT_LT(error["max"][c].number(), 1);
  }
  const json::Value half = json_here({"probe", "convert", file_, "-o", dir_ / "h.sphl", "--pack", "half"});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(half["irradiance_error"]["max"][c].number(), 4 * 0x1p-11);
  const json::Value info = json_here({"probe", "info", out_});
  EXPECT_EQ(info["pack"], "rgb9e5");
  EXPECT_EQ(info["edges"], 0);
  EXPECT_THAT(text_here({"probe", "info", out_}),
              HasSubstr(": 3 probes of degree 1, packed as rgb9e5, 0 edges\n"));
  EXPECT_THAT(text_here({"probe", "convert", file_, "-o", out_, "--pack", "half"}),
              testing::MatchesRegex(".*: 3 probes, [0-9]+ bytes\nhalf of degree 1: 25 bytes a function, 225 "
                                    "bytes of light\nirradiance is off by [^\n]*\n  mean  [^\n]*\n  95 %  "
                                    "[^\n]*\n  most  [^\n]*\nleft out: 6 edges [^\n]*"));
}

TEST_F(ProbeTool, ConvertKeepsLowBandsAlone) {
  const json::Value result = json_here({"probe", "convert", file_, "-o", out_, "--degree", "0"});
  EXPECT_EQ(result["pack"], "none");
  EXPECT_EQ(result["left_out"][0], "band 1");
  const probes::ProbeSet back = probes::read_probe_file(out_);
  EXPECT_EQ(back.degree, 0);
  EXPECT_EQ(back.probes[2].self[0], set_.probes[2].self[0]);
}

TEST_F(ProbeTool, ConvertRefusesWhatAPackingDoesNotHold) {
  EXPECT_THAT(problem_here({"probe", "convert", file_, "-o", out_, "--pack", "zh3"}),
              HasSubstr("zh3 is of degree 2, not 1"));
  EXPECT_THAT(problem_here({"probe", "convert", file_, "-o", out_, "--pack", "bc6h", "--degree", "1"}),
              HasSubstr("bc6h is of degree 2 or 4, not 1"));
  EXPECT_THAT(problem_here({"probe", "convert", file_, "-o", out_, "--degree", "2"}),
              HasSubstr("is of degree 1: there is no band 2"));
  EXPECT_THAT(problem_here({"probe", "convert", file_, "-o", dir_ / "b.sphl.json", "--pack", "half"}),
              HasSubstr("JSON holds no packed light"));
  probes::ProbeSet bright = set_;
  bright.probes[1].groups[0].reflected[0].x = 1e9f;
  probes::write_probe_file(bright, file_);
  EXPECT_THAT(problem_here({"probe", "convert", file_, "-o", out_, "--pack", "rgb9e5"}),
              HasSubstr("probe \"b\": coefficient 0 is 1e+09"));
  EXPECT_FALSE(std::filesystem::exists(out_));
  EXPECT_THROW(test::run_here({"probe", "convert", file_, "-o", out_, "--pack", "bc1"}), app::ParsingEnded);
}

}  // namespace
}  // namespace ssphh
