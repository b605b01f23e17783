/// Contracts of libs/scene and libs/scene_io.

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/calendar.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_position.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/thing_alone.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/obj.h>
#include <ssphh/scene_io/overlay.h>
#include <ssphh/scene_io/renderer_export.h>
#include <ssphh/scene_io/unit.h>

#include "contract.h"
#include "spoilt_scenes.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

using scene::Mesh;
using scene::Scene;

const std::vector<vec2> spindle = {{0, 0}, {1, 0.5f}, {0, 1}};

std::vector<Contract> of_primitives() {
  return {
      refuses("MakeSphere", "OfTwoSegments", [] { scene::make_sphere(1, 2, 8); }, {"sphere", "3 segments"}),
      refuses("MakeTorus", "OfTwoSides", [] { scene::make_torus(2, 1, 8, 2); }, {"torus", "3 sides"}),
      refuses("MakeLathe", "OfTwoPoints", [] { scene::make_lathe(std::vector<vec2>(2)); },
              {"lathe", "3 points"}),
      refuses("MakeLathe", "ThatIsOpen",
              [] {
                scene::make_lathe(std::vector<vec2>{{1, 0}, {1, 1}, {0, 2}});
              },
              {"lathe", "radius 0"}),
      refuses("MakeLathe", "OfOnePointTwice",
              [] {
                scene::make_lathe(std::vector<vec2>{{0, 0}, {0, 0}, {0, 1}});
              },
              {"lathe", "are one"}),
      refuses("MakeLathe", "OfMinusOneSegments", [] { scene::make_lathe(spindle, -1); }, {"3 segments"}),
      refuses("MakeTube", "WithoutACurve", [] { scene::make_tube(nullptr, false, 1, 8, 8); }, {"no curve"}),
      refuses("MakeTube", "OfTwoSides",
              [] { scene::make_tube([](float t) { return vec3(t); }, false, 1, 8, 2); }, {"tube", "3 sides"}),
      refuses("MakePolygon", "OfTwoCorners", [] { scene::make_polygon(std::vector<vec3>(2), {}); },
              {"polygon"}),
      refuses("MakePolygon", "OfACornerThatIsNotThere",
              [] {
                scene::make_polygon(std::vector<vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                    std::vector<uvec3>{{0, 1, 3}});
              },
              {"polygon", "not there"}),
      refuses(
          "Append", "OfAMeshWithOtherArrays",
          [] { return std::make_unique<Mesh>(scene::make_box(vec3(0), vec3(1))); },
          [](Mesh& mesh) {
            Mesh bare = scene::make_box(vec3(0), vec3(1));
            bare.normals.clear();
            scene::append(mesh, bare);
          },
          {"mesh", "other arrays"},
          [](Mesh& mesh) {
            EXPECT_EQ(mesh.positions.size(), 24u);
            EXPECT_EQ(mesh.triangles.size(), 12u);
          }),
      gives("Append", "OfAMeshToItself",
            [] {
              Mesh mesh = scene::make_box(vec3(0), vec3(1));
              scene::append(mesh, mesh);
              EXPECT_EQ(mesh.triangles.size(), 24u);
              EXPECT_EQ(mesh.triangles[12], uvec3(24) + mesh.triangles[0]);
              EXPECT_EQ(mesh.normals.size(), 48u);
            }),
  };
}

std::vector<Contract> of_scenes() {
  std::vector<Contract> rows;
  for (const SpoiltScene& s : spoilt_scenes()) {
    // What no reader of scenes can use, and what validate() does not change before it says so.
    rows.push_back(
        {"CheckIndices", s.name, [s] { expect_refusal([&] { scene::check_indices(s.make()); }, s.words); }});
    rows.push_back(
        {"ExportGlb", s.name, [s] { expect_refusal([&] { scene_io::export_glb(s.make()); }, s.words); }});
    rows.push_back({"Validate", s.name, [s] {
                      Scene scene = s.make();
                      scene.materials[0].metallic = 7;  // would be repaired
                      expect_refusal([&] { scene::validate(scene); }, s.words);
                      EXPECT_EQ(scene.materials[0].metallic, 7);
                    }});
  }
  rows.push_back(refuses("WorldMatrices", "OfAParentThatComesLater",
                         [] {
                           Scene scene = sound_scene();
                           scene.nodes[0].parent = 1;
                           scene::world_matrices(scene);
                         },
                         {"node 0", "parent 1"}));
  rows.push_back(refuses("WorldBounds", "WithTooFewMatrices", [] { scene::world_bounds(sound_scene(), {}); },
                         {"each node"}));
  rows.push_back(gives("WorldMatrices", "AtNoTime",
                       [] { EXPECT_EQ(scene::world_matrices(sound_scene(), nan).size(), 2u); }));
  scene::Instance nowhere;
  nowhere.mesh = nowhere.node = 9;
  rows.push_back(refuses("InstanceMaterial", "OfNoMesh",
                         [=] { scene::instance_material(sound_scene(), nowhere); }, {"no such mesh"}));
  rows.push_back(refuses("LightGroupOf", "AnInstanceAtNoNode",
                         [=] { scene::light_group(sound_scene(), nowhere); }, {"no such node"}));
  for (const int node : {-1, 9})
    rows.push_back(refuses("ThingAlone", "AtNode" + std::string(node < 0 ? "MinusOne" : "Nine"),
                           [node] { scene::thing_alone(sound_scene(), node); }, {"no such node"}));
  for (const int month : {0, 13})
    rows.push_back(refuses("DaysOfMonth", "Number" + std::to_string(month),
                           [month] { scene::days_of_month(2026, month); }, {"1 to 12"}));
  rows.push_back(refuses("LightGroupIndex", "AmongNone", [] { scene::light_group_index({}, "lamp"); },
                         {"light groups", "none"}));
  rows.push_back(refuses("FindCamera", "OfNoName", [] { scene::find_camera(sound_scene(), "north"); },
                         {"north", "front"}));
  rows.push_back(refuses("MakeBuiltin", "OfNoName", [] { scene::make_builtin("moon"); }, {"moon", "box"}));
  rows.push_back(refuses("WithLighting", "OfAnotherNumber", [] { scene::with_lighting(sound_scene(), {}); },
                         {"0 lights"}));
  rows.push_back(
      gives("LightGroups", "OfAnEmptyScene", [] { EXPECT_TRUE(scene::light_groups({}).empty()); }));
  rows.push_back(
      gives("WorldBounds", "OfAnEmptyScene", [] { EXPECT_TRUE(scene::world_bounds({}, {}).empty()); }));
  for (const float wrong : {nan, -1.0f, infinity}) {
    const std::string name = wrong != wrong ? "NoNumber" : wrong < 0 ? "MinusOne" : "Infinity";
    rows.push_back(refuses("AddSunSky", "OfElevation" + name,
                           [wrong] {
                             Scene scene;
                             scene::add_sun_sky(scene, {.elevation = wrong});
                           },
                           {"sun and sky", "elevation"}));
    rows.push_back(refuses("SkyRadiance", "OfTurbidity" + name,
                           [wrong] { scene::sky_radiance({.turbidity = wrong}, vec3(0, 1, 0)); },
                           {"turbidity"}));
  }
  return rows;
}

std::vector<Contract> of_files() {
  const auto unchanged = [](const Scene& scene) {
    EXPECT_EQ(scene::scene_hash(scene), scene::scene_hash(sound_scene()));
  };
  std::vector<Contract> rows = {
      refuses("LoadScene", "ThatIsNotThere", [] { scene_io::load_scene("/nowhere/scene.glb"); },
              {"/nowhere/scene.glb"}),
      refuses("LoadScene", "BuiltinThatIsNone", [] { scene_io::load_scene("builtin:moon"); }, {"moon"}),
      refuses("LoadScene", "WithARotationThatIsNoNumber",
              [] {
                scene_io::LoadOptions options;
                options.environment_rotation = nan;
                options.sun_sky.emplace();
                scene_io::load_scene("builtin:box", options);
              },
              {"environment", "finite"}),
      refuses("LoadScene", "InAUnitThatIsNone",
              [] {
                scene_io::LoadOptions options;
                options.unit = "yard";
                scene_io::load_scene("builtin:box", options);
              },
              {"unit", "yard", "inch"}),
      refuses("LoadGltf", "OfNoBytes", [] { scene_io::load_gltf({}, "x.gltf"); }, {"x.gltf"}),
      refuses("LoadGltf", "AtATimeThatIsNoNumber", [] { scene_io::load_gltf({}, "x.gltf", nan); },
              {"time", "finite"}),
      refuses("MetresPerUnit", "OfAUnitThatIsNone", [] { scene_io::metres_per_unit("yard", {}, "x.obj"); },
              {"x.obj", "yard", "inch"}),
      refuses("GuessUnit", "OfAMeshThatIsNotThere",
              [] {
                Scene scene = sound_scene();
                scene.instances[0].mesh = 9;
                scene_io::guess_unit(scene);
              },
              {"instance 0", "mesh 9"}),
      refuses(
          "SetUnit", "OfNoMetres", [] { return std::make_unique<Scene>(sound_scene()); },
          [](Scene& scene) { scene_io::set_unit(scene, 0); }, {"unit", "greater than 0"}, unchanged),
      refuses(
          "SetUnit", "WithAnOriginThatIsNoNumber", [] { return std::make_unique<Scene>(sound_scene()); },
          [](Scene& scene) { scene_io::set_unit(scene, 1, vec3(nan)); }, {"origin", "finite"}, unchanged),
      refuses("LoadObj", "OfNoText", [] { scene_io::load_obj("", "x.obj"); }, {"x.obj", "no faces"}),
      refuses("ApplyOverlay", "OfNoText",
              [] {
                Scene scene;
                scene_io::apply_overlay(scene, "", "x.ssphh.json");
              },
              {"x.ssphh.json"}),
      refuses("OverlayScene", "OfNone", [] { scene_io::overlay_scene("{}", "x.ssphh.json"); },
              {"x.ssphh.json"}),
      refuses("ExpandVariables", "OfAnotherProgramsName",
              [] { scene_io::expand_variables("${HOME}", "x.json"); }, {"x.json", "SSPHH_"}),
      refuses("WriteGlb", "IntoNoFolder", [] { scene_io::write_glb("/nowhere/x.glb", sound_scene()); },
              {"/nowhere/x.glb"}),
  };
  for (const scene_io::RendererFormat& format : scene_io::renderer_formats()) {
    const auto refuses_export = [&](const std::string& given,
                                    std::function<void(Scene&, scene_io::ExportSettings&)> spoil,
                                    std::vector<std::string> words) {
      rows.push_back({"Export", std::string(format.name) + given, [=] {
                        const TempDir dir;
                        Scene scene = sound_scene();
                        scene_io::ExportSettings settings;
                        settings.camera = scene::camera_pose(scene, "");
                        spoil(scene, settings);
                        expect_refusal([&] { format.write(scene, settings, dir.path() / "out"); }, words);
                        EXPECT_FALSE(std::filesystem::exists(dir.path() / "out"));
                      }});
    };
    refuses_export("OfAMeshThatIsNotThere", [](Scene& s, auto&) { s.instances[0].mesh = 9; },
                   {"instance 0", "mesh 9"});
    refuses_export("OfNoPixels", [](auto&, auto& settings) { settings.width = 0; }, {"export", "width"});
    refuses_export("AtNoTime", [](auto&, auto& settings) { settings.time = nan; }, {"export", "time"});
    rows.push_back({"Export", std::string(format.name) + "IntoAFile", [format] {
                      const scene_io::ExportSettings settings{.camera =
                                                                  scene::camera_pose(sound_scene(), "")};
                      expect_refusal([&] { format.write(sound_scene(), settings, "/dev/null/out"); },
                                     {"/dev/null/out", "folder"});
                    }});
  }
  return rows;
}

SSPHH_CONTRACTS(Primitives, of_primitives());
SSPHH_CONTRACTS(Scene, of_scenes());
SSPHH_CONTRACTS(SceneIo, of_files());

}  // namespace
}  // namespace ssphh::test
