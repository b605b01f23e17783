import os
import pathlib
import unittest

import numpy as np

import ssphh
from support import InAFolder, error_of


class Scenes(InAFolder):
    def test_tells_what_a_scene_holds(self):
        scene = ssphh.load("builtin:two-rooms")
        self.assertEqual((scene.name, scene.source, scene.time), ("two-rooms", "builtin:two-rooms", 0))
        self.assertEqual(scene.duration, 1, "the door opens within a second")
        self.assertEqual(scene.light_groups, ["lamp"])
        self.assertEqual(scene.light_modes, {"lamp": "realtime"})
        self.assertEqual([light.name for light in scene.lights], ["lamp"])
        self.assertEqual(scene.lights[0].type, "point")
        low, high = scene.bounds
        self.assertTrue(np.all(low < scene.lights[0].position) and np.all(scene.lights[0].position < high))
        self.assertEqual(len(scene.probe_places), 6)
        camera = scene.cameras[0]
        self.assertAlmostEqual(float(np.dot(camera.direction, camera.up)), 0, places=6)
        self.assertAlmostEqual(float(np.linalg.norm(camera.direction)), 1, places=6)
        self.assertIn("two-rooms", repr(scene))

    def test_reads_files_and_their_units(self):
        file = pathlib.Path(self.path("triangle.obj"))
        file.write_text("v 0 0 0\nv 100 0 0\nv 0 200 0\nf 1 2 3\n")
        with self.assertLogs("ssphh", "WARNING") as log:
            scene = ssphh.load(file, unit="cm")
        self.assertIn("a neutral studio lights it", log.output[0])
        self.assertIn("by overlay", log.output[0], "arguments are named as Python has them")
        np.testing.assert_allclose(scene.bounds, [[0, 0, 0], [1, 2, 0]], atol=1e-6)
        self.assertEqual(scene.triangle_count, 1)
        sky = ssphh.load(file, sun_sky=True, sun_elevation=30)
        self.assertEqual(sky.light_groups, ["sun", "sky"])
        sun = next(light for light in sky.lights if light.type == "directional")
        self.assertAlmostEqual(float(-sun.direction[1]), 0.5, places=5, msg="the sine of 30 degrees")

    def test_flat_lamps_have_a_size(self):
        file = pathlib.Path(self.path("lit.ssphh.json"))
        file.write_text("""{"scene": "builtin:two-rooms", "lights": [
            {"name": "panel", "type": "rectangle", "width": 0.5, "height": 0.25, "direction": [0, -1, 0], "intensity": 7},
            {"name": "plate", "type": "disc", "radius": 0.5, "direction": [0, -1, 0], "power": 30}]}""")
        panel, plate = ssphh.load(file).lights[1:]
        self.assertEqual((panel.type, panel.size, panel.intensity), ("rectangle", (0.5, 0.25), 7))
        self.assertEqual((plate.type, plate.radius, plate.size), ("disc", 0.5, (0, 0)))
        self.assertAlmostEqual(plate.intensity, 30 / (np.pi * np.pi * 0.25), places=4)

    def test_light_modes_are_asked_for_by_group(self):
        scene = ssphh.load("builtin:two-rooms", light_mode={"lamp": "mixed"})
        self.assertEqual(scene.light_modes, {"lamp": "mixed"})
        e = error_of(self, ssphh.load, "builtin:two-rooms", light_mode={"lamp": "dim"})
        self.assertEqual(e.where, "light_mode lamp=dim")

    def test_surface_points_lie_on_the_walls_of_a_box(self):
        scene = ssphh.load("builtin:box")
        points, normals, moves = scene.surface_points(300, seed=1)
        self.assertEqual((points.shape, normals.shape, moves.shape), ((300, 3), (300, 3), (300,)))
        low, high = scene.bounds
        near = np.minimum(abs(points - low), abs(points - high)).min(axis=1)
        self.assertLess(near.max(), 1e-4)
        self.assertFalse(moves.any())
        np.testing.assert_array_equal(points, scene.surface_points(300, seed=1)[0])

    def test_probes_of_ones_own_take_the_place_of_the_scenes(self):
        places = np.array([[0, 0, 0], [0.25, 0.1, -0.2]])
        scene = ssphh.load("builtin:box").with_probes(places, names=["a", "b"])
        self.assertEqual([p.name for p in scene.probe_places], ["a", "b"])
        np.testing.assert_allclose([p.position for p in scene.probe_places], places, atol=1e-7)
        probes = ssphh.bake(scene, spp=1, face=4, degree=1, records=0, viz="off")
        np.testing.assert_allclose(probes.positions, places, atol=1e-7)
        self.assertEqual(probes.names, ["a", "b"])
        # It is the same scene to whoever asks.
        ssphh.Lookup(ssphh.load("builtin:box"), probes)

    def test_probes_of_ones_own_stand_where_the_scenes_would(self):
        scene = ssphh.load("builtin:two-rooms")  # with a lamp and a door, whose nodes come after
        own = [place.position for place in scene.probe_places]
        names = [place.name for place in scene.probe_places]
        settings = dict(operator="surfel", degree=2, records=64, directions=64, surfel_size=0.5, link_rays=16)
        same = ssphh.bake(scene.with_probes(own, names=names), **settings)
        np.testing.assert_allclose(same.reflected, ssphh.bake(scene, **settings).reflected, rtol=1e-5, atol=1e-7)

    def test_places_are_found_as_asked_for(self):
        scene = ssphh.load("builtin:two-rooms")
        found = ssphh.place(scene, 12)
        self.assertEqual(len(found), 12)
        self.assertEqual(found.positions.shape, (12, 3))
        self.assertEqual(found.kinds[:6], ["manual"] * 6)
        self.assertEqual(found.edges.shape[1], 2)
        self.assertLess(found.edges.max(), 12)
        self.assertEqual(error_of(self, ssphh.place, scene, "many").where, "probes")
        self.assertEqual(error_of(self, ssphh.place, scene, "scene").where, "probes")
        self.assertIn("with_probes", error_of(self, ssphh.place, scene, [[0, 0, 0]]).hint)

    def test_names_of_scenes(self):
        self.assertIn("builtin:cornell", ssphh.builtin_scenes())
        self.assertIn("cornell", str(error_of(self, ssphh.load, "builtin:cornel")))
        self.assertEqual(error_of(self, ssphh.load, "").where, "source")
        self.assertRaises(TypeError, ssphh.load, None)
        self.assertEqual(ssphh.load(b"builtin:box").name, "box")
        self.assertIn("nobody.glb", error_of(self, ssphh.load, os.path.join(self.folder, "nobody.glb")).where)


if __name__ == "__main__":
    unittest.main()
