// The page in a real browser, from disk: Chromium runs headless and prints the document that its scripts
// left.

#include <cstdio>
#include <cstdlib>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "example_report.h"
#include "json_text.h"
#include "temp_dir.h"

namespace ssphh::report {
namespace {

using ssphh::test::parse_json;
using ssphh::test::parse_json_if_any;
using test::example_report;
using testing::HasSubstr;
using testing::Not;

// Acts on the page as a user would and leaves what it saw in the document's title.
constexpr const char* probe_script = R"(<script>
(async () => {
  const seen = {};
  try {
    const settle = async () => { await drawn; await new Promise((done) => setTimeout(done, 0)); await drawn; };
    const press = async (key) => { document.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true })); await settle(); };
    const click = async (box, text) => { [...document.querySelectorAll(box + " button")].find((b) => b.textContent.endsWith(text)).click(); await settle(); };
    const stage = () => {
      const canvas = document.querySelector("#stage canvas"), data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
      const middle = 4 * (Math.floor(canvas.height / 2) * canvas.width + Math.floor(canvas.width / 2));
      let sum = 0;
      for (let i = 0; i < data.length; i += 4) sum += data[i] + data[i + 1] + data[i + 2];
      return { middle: Array.from(data.slice(middle, middle + 3)), mean: sum / data.length, name: document.querySelector("#stage .name").textContent };
    };
    await settle();
    seen.values = {};
    for (const cell of report.cells) {
      if (!cell.pictures.length) continue;
      const p = await picture(cell, "");
      seen.values[cell.label] = Array.from(p.values);
    }
    seen.start = stage();
    await press("f"); seen.flipped = stage();
    await press("f"); seen.back = stage();
    await press("2"); seen.second = stage();
    await press("+"); await press("+"); seen.brighter = stage(); seen.exposure = state.exposure;
    seen.maps = {};
    for (const map of ["absolute", "signed", "relMSE", "FLIP", "pixelated"]) { await click("#maps", map); seen.maps[map] = stage(); }
    const a = await picture(cellOf(state.a), ""), b = await picture(cellOf(state.b), "");
    seen.absolute = Array.from(errorMap("absolute", a, b, 4).slice(0, 64));
    seen.pixelated = Array.from(errorMap("pixelated", a, b, 4).slice(0, 8));
    await click("#maps", "picture");
    for (const key of ["w", "s", "a", "o"]) { await press(key); seen[key] = document.querySelectorAll("#stage .pane").length; }
    await press("w"); state.wipe = 1; drawAll(); seen.wiped = stage(); await press("o");
    await readPixel({ x: 3, y: 2 }); seen.readout = document.getElementById("readout").textContent;
    const heads = document.querySelectorAll("#tables thead th"), order = () => [...document.querySelectorAll("#tables tbody tr")].map((r) => r.cells[0].firstChild.textContent);
    heads[1].click(); seen.ascending = order(); heads[1].click(); seen.descending = order();
    seen.insets = document.querySelectorAll("#insets canvas").length;
    seen.charts = document.querySelectorAll("#charts svg polyline").length;
    seen.failures = document.querySelector("#failures").textContent;
    seen.heading = document.querySelector("h1").textContent;
    seen.table = document.querySelector("#tables").textContent;
    seen.loads = performance.getEntriesByType("resource").map((r) => r.name);
    window.dispatchEvent(new Event("resize"));
  } catch (e) { seen.error = String(e.stack || e); }
  const out = document.createElement("pre");
  out.id = "seen"; out.textContent = "SEEN" + btoa(unescape(encodeURIComponent(JSON.stringify(seen)))) + "SEEN";
  document.body.append(out);
})();
</script>)";

std::string decode_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) out += static_cast<char>(bits >> (count -= 8) & 255u);
  }
  return out;
}

// The page's ASCII, and the other way round.
std::string ascii(const std::string& page) {
  std::string text;
  for (std::size_t i = 2; i + 1 < page.size(); i += 2) text += page[i + 1] == 0 ? page[i] : '?';
  return text;
}
std::string utf16(const std::string& text) {
  std::string bytes;
  for (const char c : text) bytes += c, bytes += '\0';
  return bytes;
}

json::Value open_in_browser(const std::string& page) {
  const ssphh::test::TempDir dir;
  write_file(dir / "page.html", page + utf16(probe_script));
  const std::string command =
      "timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
      "--disable-background-networking --window-size=1200,1000 --virtual-time-budget=60000 "
      "--user-data-dir='" +
      (dir / "profile").string() + "' --dump-dom 'file://" + (dir / "page.html").string() + "' 2>/dev/null";
  std::string document;
  FILE* pipe = ::popen(command.c_str(), "r");
  char buffer[65536];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) document.append(buffer, n);
  ::pclose(pipe);
  const std::size_t begin = document.rfind("SEEN", document.rfind("SEEN") - 1), end = document.rfind("SEEN");
  if (begin == std::string::npos || end <= begin) return {};
  return parse_json_if_any(decode_base64(document.substr(begin + 4, end - begin - 4)));
}

TEST(Page, IsOneFileAndEscapesWhatItIsGiven) {
  const std::string page = ascii(report_page(example_report()));
  EXPECT_THAT(page, HasSubstr("<title>A &lt;small> report</title>"));
  EXPECT_THAT(page, Not(HasSubstr("it failed </script>")));
  EXPECT_THAT(page, Not(HasSubstr("%%")));
  const auto last = [&](const std::string& tag) {
    const std::size_t begin = page.rfind("<" + tag + ">");
    return page.substr(begin, page.find("</" + tag + ">", begin) - begin);
  };
  EXPECT_THAT(last("style"), HasSubstr("#stage {"));
  EXPECT_THAT(last("script"), HasSubstr("addEventListener"));
  for (const char* remote : {"src=", "href=", "https:", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(remote)));
}

/// The bytes that base32768() wrote, by its description.
std::vector<std::uint8_t> bytes_of(const std::u16string& letters, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::size_t bit = 0; bit < 8 * size; ++bit) {
    const int letter = letters.at(bit / 15) - 0x3400;
    bytes[bit / 8] =
        static_cast<std::uint8_t>(bytes[bit / 8] | (letter >> (14 - bit % 15) & 1) << (7 - bit % 8));
  }
  return bytes;
}

std::u16string units_of(const std::string& page) {
  std::u16string text;
  for (std::size_t i = 2; i + 1 < page.size(); i += 2) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(page[k]); };
    text += static_cast<char16_t>(byte(i) | byte(i + 1) << 8);
  }
  return text;
}

// What a browser would find by getElementById.
TEST(Page, PicturesStandInItUnderTheNamesThatItsDataHas) {
  const Report report = example_report();
  const std::string bytes = report_page(report), page = ascii(bytes);
  const std::u16string units = units_of(bytes);
  const std::size_t begin = page.find("{\"title\":");
  ASSERT_NE(begin, std::string::npos);
  const json::Value data = parse_json(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(data["title"], "A <small> report");
  std::set<std::string> ids;
  for (std::size_t c = 0; c < report.cells.size(); ++c) {
    const json::Value& pictures = data["cells"][c]["pictures"];
    ASSERT_EQ(pictures.size(), report.cells[c].pictures.size());
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const CellPicture& wanted = report.cells[c].pictures[i];
      json::Value picture = pictures[i];
      const std::string id = picture["id"].string();
      EXPECT_TRUE(ids.insert(id).second) << id << " twice";
      picture.erase("id");
      EXPECT_EQ(picture, json::Value({{"layer", wanted.layer},
                                      {"map", wanted.map},
                                      {"kind", wanted.packed.kind},
                                      {"width", 32},
                                      {"height", 18},
                                      {"channels", wanted.packed.channels},
                                      {"bytes", wanted.packed.bytes.size()}}));
      const std::string tag = "<script type=\"text/plain\" id=\"" + id + "\">";
      const std::size_t at = page.find(tag) + tag.size();
      EXPECT_EQ(bytes_of(units.substr(at, page.find("</script>", at) - at), wanted.packed.bytes.size()),
                wanted.packed.bytes);
    }
  }
  EXPECT_EQ(ids.size(), 5u);
}

TEST(Page, TitlesOfEveryLanguageStandInItAndWhatIsNoTextIsReplaced) {
  Report report = example_report();
  // One to four bytes of UTF-8 a character; then a lone start, a cut one, and an unexpected middle.
  report.plan.title = "a\xc3\xa4\xe2\x82\xac\xf0\x9f\x92\xa1|\xff|\xe2\x82|\x82|";
  const std::string page = report_page(report);
  const std::u16string text = units_of(page);
  EXPECT_EQ(page.substr(0, 2), "\xff\xfe") << "little endian";
  EXPECT_NE(text.find(u"<title>a\u00e4\u20ac\U0001f4a1|\ufffd|\ufffd\ufffd|\ufffd|</title>"), text.npos);
}

std::vector<std::uint16_t> halves_of(const json::Value& list) {
  std::vector<std::uint16_t> halves;
  for (const json::Value& bits : list.elements()) halves.push_back(static_cast<std::uint16_t>(bits.number()));
  return halves;
}

TEST(Page, WorksInABrowser) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no `chromium` on PATH (apt-get install chromium)";
  const Report report = example_report();
  const json::Value seen = open_in_browser(report_page(report));
  ASSERT_TRUE(seen.is_object()) << "the page's scripts did not come to an end";
  ASSERT_FALSE(seen.contains("error")) << print(seen["error"]);
  for (const ReportCell& cell : report.cells) {
    if (cell.pictures.empty()) continue;
    EXPECT_EQ(halves_of(seen["values"][cell.label.c_str()]), unpack(cell.pictures[0].packed)) << cell.label;
  }
  EXPECT_EQ(seen["start"]["name"], "m, n 1");
  EXPECT_EQ(seen["flipped"]["name"], "truth");
  EXPECT_NE(seen["flipped"]["mean"], seen["start"]["mean"]);
  EXPECT_EQ(seen["back"], seen["start"]);
  EXPECT_EQ(seen["second"]["name"], "m, n 2");
  EXPECT_DOUBLE_EQ(seen["exposure"].number(), 1.5);
  EXPECT_GT(seen["brighter"]["mean"].number(), seen["second"]["mean"].number());
  std::vector<json::Value> maps;
  for (const auto& [name, map] : seen["maps"].members()) {
    EXPECT_THAT(map["name"].string(), HasSubstr("error: m, n 2")) << name;
    EXPECT_THAT(maps, Not(testing::Contains(map))) << name << " looks like another map";
    maps.push_back(map);
  }
  EXPECT_EQ(seen["w"], 1);
  EXPECT_EQ(seen["s"], 2);
  EXPECT_EQ(seen["a"], 3);
  EXPECT_EQ(seen["o"], 1);
  EXPECT_THAT(seen["readout"].string(), HasSubstr("pixel 3, 2"));
  EXPECT_EQ(seen["ascending"][0], "m, n 1");
  EXPECT_EQ(seen["descending"][0], "m, n 2");
  EXPECT_EQ(seen["insets"], 3);
  EXPECT_EQ(seen["charts"], 1);
  EXPECT_EQ(seen["heading"], "A <small> report");
  EXPECT_THAT(seen["failures"].string(), HasSubstr("it failed </script>"));
  EXPECT_THAT(seen["table"].string(), HasSubstr("published 99"));
  EXPECT_TRUE(seen["loads"].empty()) << print(seen["loads"]);

  // What the browser computes, from the same halves by hand.
  const auto values = [&](std::size_t cell, std::size_t i) {
    const std::uint16_t h = unpack(report.cells[cell].pictures[0].packed)[i];
    const int exponent = h >> 10 & 31, mantissa = h & 1023;
    const double x = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    return h & 0x8000 ? -x : x;
  };
  for (std::size_t p = 0; p < 64; ++p) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(values(2, 3 * p + c) - values(0, 3 * p + c)) / 3;
    EXPECT_NEAR(seen["absolute"][p].number(), sum, 1e-6) << p;
  }
}

}  // namespace
}  // namespace ssphh::report
