// An OBJ file with its material libraries as the scene it becomes, and every line of them left out or
// changed, one at a time. In expected/obj.txt and expected/obj-changes.txt.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/scene_io/obj.h>

#include "error_message.h"
#include "expected_text.h"
#include "memory_dir.h"
#include "scene_text.h"
#include "temp_dir.h"
#include "text_changes.h"

namespace ssphh::scene_io {
namespace {

constexpr const char* obj = R"(# of the office
mtllib all.mtl other\more.mtl
mtllib all.mtl
v 0 0 0
v 2 0 0 0.5
v 2 1 0
v 0 1 0
v 1 0.4 0
v 0 0 -3
vt 0.25 0.5
vt 0.75
vt 0.5 0.125 9
vn 0 0 2
vn 0 0.6 0.8
vn 0 0 0
f 1 2 3 4
o a desk
usemtl wood
s 1
f 1/1/1 2/2/1 3/3/2 4//2 5
f -6/-3/-3 -5//1 -1/1
usemtl glass\
pane
f 1//3 6//1 4//2
g shelf one
f 1 2 6
usemtl wood
f 3/1 2/2 6/3
usemtl nowhere
f 1 2 3
usemtl lamp
f 2 3 6
usemtl tin
f 1 2 3
usemtl mirror
f 1 2 3
usemtl mesh
f 1 2 3
usemtl lace
f 1 2 3
usemtl veil
f 1 2 3
usemtl plastic
f 1 2 3
usemtl glow
f 1 2 3
f 1 2
s off
p 1
bevel on
nonsense 1
)";

constexpr const char* mtl = R"(newmtl wood
Ka 1 1 1
Kd 0.5 0.25 0.125
Ks 0.04 0.05 0.06
Ns 100
Ni 1.7
illum 2
map_Kd -o 0.25 0.5 -s 2 3 4 -clamp on -mm 0 1 -blendu off my color.png
norm -bm 0.5 -s 2 color.png
d 0.75
newmtl glass pane
Kd 0.1
Tr 0.375
illum 1
Ks 0.5
newmtl lamp
Ke 3 2 1
map_Ke color.png
newmtl tin
Kd 0.01 0.02 0.03
Ks 0.9 0.8 1.7
Ns 30
illum 2
newmtl mirror
Ks 0.6 0.6 0.6
illum 4
newmtl mesh
map_Kd color.png
map_d red.png
newmtl lace
map_d alpha.png
newmtl veil
map_Kd alpha.png
map_d alpha.png
newmtl plastic
Pr 0.3
Pm 0.6
Ni 1.25
Tf 1 1 1
map_Bump color.png
d -halo 0.5
newmtl glow
map_Ke -t 1 2 3 gone.png
map_Kd C:\color.png
)";

class ObjText : public testing::Test {
 protected:
  ObjText() {
    set_log_sink([this](LogLevel, const std::string& line) { warnings_ += "warning " + line + "\n"; });
    image::Rgba8 texels{2, 2, {}};
    for (int i = 0; i < 16; ++i) texels.rgba.push_back(static_cast<std::uint8_t>(10 * i + 1));
    write_file(dir_ / "alpha.png", image::encode_png(texels));
    for (std::size_t i = 3; i < 16; i += 4) texels.rgba[i] = 255;
    write_file(dir_ / "my color.png", image::encode_png(texels));
    write_file(dir_ / "color.png", image::encode_png(texels));
    image::Rgba8 small{1, 2, {50, 60, 70, 255, 150, 160, 170, 255}};
    write_file(dir_ / "red.png", image::encode_png(small));
    std::filesystem::create_directory(dir_ / "other");
    write_file(dir_ / "other/more.mtl", "newmtl wood\nKd 1 1 1\nnewmtl unused\n");
  }
  ~ObjText() override { set_log_sink({}); }

  /// The scene and what was said on the way, without the folder's name.
  std::string read(const std::string& obj_file, const std::string& mtl_file) {
    warnings_.clear();
    write_file(dir_ / "all.mtl", mtl_file);
    std::string text;
    const std::string said =
        test::message_of([&] { text = test::scene_text(load_obj(obj_file, dir_ / "all.obj")); });
    text += warnings_ + (said == "no error" ? "" : said + "\n");
    const std::string folder = dir_.path().string();
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;)
      text.replace(at, folder.size(), "FOLDER");
    return text;
  }

  const test::TempDir dir_{test::memory_dir()};
  std::string warnings_;
};

TEST_F(ObjText, AllThatIsReadStandsInTheScene) {
  test::expect_text_of("libs/scene_io/tests/expected/obj.txt", read(obj, mtl));
}

TEST_F(ObjText, EveryLineCounts) {
  const std::vector<std::string> before = test::lines_of(read(obj, mtl));
  std::string text;
  for (const auto& [change, file] : test::changes_of_lines(obj))
    text += "obj " + change + "\n" + test::news(read(file, mtl), before);
  for (const auto& [change, file] : test::changes_of_lines(mtl))
    text += "mtl " + change + "\n" + test::news(read(obj, file), before);
  test::expect_text_of("libs/scene_io/tests/expected/obj-changes.txt", text);
}

}  // namespace
}  // namespace ssphh::scene_io
