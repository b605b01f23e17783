// Indices of OBJ faces: v, vt and vn are counted apart, from the front or back from what is defined so far.

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene_io/obj.h>

namespace ssphh::scene_io {
namespace {

/// Corner of a face by absolute indices from 1; 0: none.
struct Corner {
  int v, vt, vn;
};

// The k-th of each kind, all different and no three positions on a line.
vec3 position(int k) {
  const auto f = static_cast<float>(k);
  return {f, f * f, 0.5f * f};
}
vec2 coordinates(int k) {
  return {static_cast<float>(k) / 16, static_cast<float>(k) / 32};
}
vec3 normal(int k) {
  return {k == 1, k == 2, k == 3};
}

std::string vertices(int first, int last) {
  std::string text;
  for (int k = first; k <= last; ++k) {
    const vec3 p = position(k);
    text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  return text;
}
std::string texture_coordinates(int first, int last) {
  std::string text;
  for (int k = first; k <= last; ++k)
    text += "vt " + std::to_string(coordinates(k).x) + " " + std::to_string(coordinates(k).y) + "\n";
  return text;
}
std::string normals(int first, int last) {
  std::string text;
  for (int k = first; k <= last; ++k)
    text +=
        "vn " + std::to_string(k == 1) + " " + std::to_string(k == 2) + " " + std::to_string(k == 3) + "\n";
  return text;
}

vec3 front(const std::vector<Corner>& face) {
  const vec3 a = position(face[0].v);
  return glm::normalize(glm::cross(position(face[1].v) - a, position(face[2].v) - a));
}

/// The mesh has these triangles, corner by corner. `has_uv`, `has_normals`: some corner of it names one.
void expect_faces(const scene::Mesh& mesh, const std::vector<std::vector<Corner>>& faces, bool has_uv,
                  bool has_normals) {
  ASSERT_EQ(mesh.triangles.size(), faces.size());
  EXPECT_EQ(mesh.uvs[0].size(), has_uv ? mesh.positions.size() : 0);
  EXPECT_EQ(mesh.normals.size(), has_normals ? mesh.positions.size() : 0);
  if (testing::Test::HasFailure()) return;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int c = 0; c < 3; ++c) {
      SCOPED_TRACE("face " + std::to_string(f) + " corner " + std::to_string(c));
      const Corner& wanted = faces[f][c];
      const std::uint32_t vertex = mesh.triangles[f][c];
      EXPECT_EQ(mesh.positions[vertex], position(wanted.v));
      const vec2 uv = coordinates(wanted.vt);
      if (has_uv) {
        EXPECT_EQ(mesh.uvs[0][vertex], wanted.vt == 0 ? vec2(0) : vec2(uv.x, 1 - uv.y));
      }
      if (has_normals) {
        const vec3 expected = wanted.vn == 0 ? front(faces[f]) : normal(wanted.vn);
        EXPECT_LT(glm::distance(mesh.normals[vertex], expected), 1e-6f);  // rounding of the normalisation
      }
    }
  }
}

// 4 v, 3 vt and 2 vn when the first object's faces are read, 7, 7 and 3 at the second's: an index that was
// resolved against another kind's count, or against that of the whole file, names another entry or none.
TEST(ObjIndices, NegativeOnesCountBackWithinTheirOwnKindOfWhatIsDefinedSoFar) {
  const scene::Scene scene =
      load_obj("o first\n" + vertices(1, 4) + texture_coordinates(1, 3) + normals(1, 2) +
                   "f -4/-3/-2 2/-2/-1 -2/3/1\n"
                   "f 1/-1/-1 -1/1/2 3/-2/-2\n"
                   "o second\n" +
                   vertices(5, 7) + texture_coordinates(4, 7) + normals(3, 3) +
                   "f -1/-7/-3 -7/-1/3 4/4/-2\n"
                   "o first\n"
                   "f 1/7/-1 -6/-5/1 -3/2/-2\n",
               "test.obj");
  ASSERT_EQ(scene.meshes.size(), 2u);
  expect_faces(scene.meshes[0],
               {{{1, 1, 1}, {2, 2, 2}, {3, 3, 1}},
                {{1, 3, 2}, {4, 1, 2}, {3, 2, 1}},
                {{1, 7, 3}, {2, 3, 1}, {5, 2, 2}}},
               true, true);
  expect_faces(scene.meshes[1], {{{7, 1, 1}, {1, 7, 3}, {4, 4, 2}}}, true, true);
}

TEST(ObjIndices, NormalsAloneAndTextureCoordinatesAloneKeepTheirPlaces) {
  const std::string lists = vertices(1, 6) + texture_coordinates(1, 5) + normals(1, 3);
  const auto mesh = [&](const std::string& faces) {
    return load_obj(lists + faces, "test.obj").meshes.at(0);
  };
  expect_faces(mesh("f -1//-3 5//2 -3//-1\nf 1//3 2//-2 3//1\n"),
               {{{6, 0, 1}, {5, 0, 2}, {4, 0, 3}}, {{1, 0, 3}, {2, 0, 2}, {3, 0, 1}}}, false, true);
  expect_faces(mesh("f -1/-5 5/2 -3/-1\nf 1/-2 2/-3 3/1\n"),
               {{{6, 1, 0}, {5, 2, 0}, {4, 5, 0}}, {{1, 4, 0}, {2, 3, 0}, {3, 1, 0}}}, true, false);
  expect_faces(mesh("f -1/-5 5/2 -3/-1\nf 1//3 2//-2 3//1\nf 1/1/1 2/-4/-2 3/3/-1\nf 4 -1 -2\n"),
               {{{6, 1, 0}, {5, 2, 0}, {4, 5, 0}},
                {{1, 0, 3}, {2, 0, 2}, {3, 0, 1}},
                {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}},
                {{4, 0, 0}, {6, 0, 0}, {5, 0, 0}}},
               true, true);
}

TEST(ObjIndices, EachKindEndsWhereItsOwnListEnds) {
  const auto error = [](const std::string& face) {
    try {
      load_obj(vertices(1, 5) + texture_coordinates(1, 3) + normals(1, 2) + face, "test.obj");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    ADD_FAILURE() << "it loaded: " << face;
    return std::string();
  };
  using testing::HasSubstr;
  EXPECT_THAT(error("f 1/1/1 2/2/2 6/3/1\n"), HasSubstr("vertex index 6 out of range, 5 "));
  EXPECT_THAT(error("f 1/1/1 -6/2/2 3/3/1\n"), HasSubstr("vertex index -6 out of range, 5 "));
  EXPECT_THAT(error("f 1/4/1 2/2/2 3/3/1\n"), HasSubstr("texture coordinate index 4 out of range, 3 "));
  EXPECT_THAT(error("f 1/-4/1 2/2/2 3/3/1\n"), HasSubstr("texture coordinate index -4 out of range, 3 "));
  EXPECT_THAT(error("f 1/0/1 2/2/2 3/3/1\n"), HasSubstr("texture coordinate index 0 out of range, 3 "));
  EXPECT_THAT(error("f 1//3 2//2 3//1\n"), HasSubstr("normal index 3 out of range, 2 "));
  EXPECT_THAT(error("f 1//1 2//-3 3//1\n"), HasSubstr("normal index -3 out of range, 2 "));
}

}  // namespace
}  // namespace ssphh::scene_io
