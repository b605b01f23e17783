import pickle
import unittest

import numpy as np

import ssphh
from support import InAFolder, constant, error_of, run_tool

PLACES = [[0.1, 0.2, 0.3], [0.4, 0.5, -0.6]]


class Errors(unittest.TestCase):
    def test_an_error_has_parts_and_survives_pickling(self):
        e = pickle.loads(pickle.dumps(ssphh.Error("a", "is wrong", "mend it")))
        self.assertEqual((e.where, e.problem, e.hint, str(e)), ("a", "is wrong", "mend it", "a: is wrong (mend it)"))
        self.assertEqual(str(ssphh.Error("a", "is wrong")), "a: is wrong")


class ProbeSets(InAFolder):
    def two(self):
        light = np.array([[constant((1, 2, 3)), constant((4, 5, 6))], [constant((7, 0, 0)), constant((0, 8, 9))]])
        return ssphh.ProbeSet.from_arrays(PLACES, light, light_groups=["lamp", "sky"], names=["a", "b"]), light

    def test_arrays_go_in_and_come_out(self):
        probes, light = self.two()
        self.assertEqual((len(probes), probes.degree, probes.names), (2, 2, ["a", "b"]))
        np.testing.assert_allclose(probes.positions, PLACES, rtol=1e-6)
        np.testing.assert_array_equal(probes.reflected, light.sum(axis=0))
        np.testing.assert_array_equal(probes.radiance, light.sum(axis=0))
        emitted, reflected = probes.group("sky")
        np.testing.assert_array_equal(reflected, light[1])
        np.testing.assert_array_equal(emitted, np.zeros_like(light[1]))
        self.assertIsNone(probes.hierarchy)
        self.assertIsNone(probes.records)
        self.assertEqual(probes.edges[0].shape, (0, 2))

    def test_lamps_are_dimmed_and_coloured(self):
        probes, light = self.two()
        probes.relight("lamp", 0.5)
        probes.relight("sky", [1, 0, 2])
        np.testing.assert_allclose(probes.reflected, 0.5 * light[0] + light[1] * [1, 0, 2], rtol=1e-6)
        np.testing.assert_array_equal(probes.light_groups["sky"], [1, 0, 2])
        np.testing.assert_array_equal(probes.group("lamp")[1], light[0], "as baked")
        self.assertIn("lamp", error_of(self, probes.relight, "lmap", 1).hint)
        error_of(self, probes.relight, "lamp", -1)
        self.assertEqual(error_of(self, probes.relight, "lamp", [1, 2]).where, "scale")

    def test_other_light_for_the_same_probes(self):
        scene = ssphh.load("builtin:cornell")
        probes = ssphh.bake(scene, spp=1, face=4, degree=2, records=0)
        light = np.array([probes.group(name)[1][:, :4] for name in probes.light_groups])
        other = probes.with_light(2 * light)
        self.assertEqual((other.degree, other.names), (1, probes.names))
        np.testing.assert_array_equal(other.reflected, 2 * probes.reflected[:, :4])
        self.assertEqual(len(other.edges[0]), 0)
        ssphh.Lookup(scene, other)  # still of this scene
        self.assertEqual(error_of(self, probes.with_light, light[:, 1:]).where, "reflected")

    def test_files_hold_every_bit(self):
        probes, _ = self.two()
        probes.relight("lamp", 0.25)
        probes.save(self.path("a.sphl"))
        again = ssphh.ProbeSet.load(self.path("a.sphl"))
        self.assertEqual(again, probes)
        again.save(self.path("a.sphl.json"))
        np.testing.assert_allclose(ssphh.ProbeSet.load(self.path("a.sphl.json")).reflected, probes.reflected, rtol=1e-4)
        self.assertNotEqual(ssphh.ProbeSet.from_arrays(PLACES, probes.reflected), probes)

    def test_packed_files_are_read_as_floats(self):
        light = np.zeros((1, 2, 9, 3))
        light[:, :, 0] = [1, 0.5, 0.25]
        light[:, :, 1:] = np.linspace(-0.2, 0.2, 2 * 8 * 3).reshape(2, 8, 3)
        ssphh.ProbeSet.from_arrays(PLACES, light, light_groups=["lamp"], names=["a", "b"]).save(self.path("a.sphl"))
        for pack, error in [("half", 2**-11), ("rgb9e5", 0.01)]:
            run_tool("probe", "convert", self.path("a.sphl"), "-o", self.path(f"{pack}.sphl"), "--pack", pack)
            self.assertLess(len(self.bytes_of(f"{pack}.sphl")), len(self.bytes_of("a.sphl")))
            probes = ssphh.ProbeSet.load(self.path(f"{pack}.sphl"))
            run_tool("probe", "convert", self.path(f"{pack}.sphl"), "-o", self.path("floats.sphl"))
            self.assertEqual(probes.names, ["a", "b"])
            np.testing.assert_array_equal(probes.reflected, ssphh.ProbeSet.load(self.path("floats.sphl")).reflected, "as the tool unpacks them")
            np.testing.assert_allclose(probes.reflected, light[0], atol=error, rtol=error)
            self.assertFalse(np.array_equal(probes.reflected, light[0].astype(np.float32)), "packed, indeed")

    def test_views_are_where_the_numbers_lie_and_keep_them(self):
        probes, light = self.two()
        view = probes.light(1)["sky"][1]
        self.assertIs(view.base, probes)
        self.assertFalse(view.flags.writeable)
        self.assertEqual(view.__array_interface__["data"], probes.light(1)["sky"][1].__array_interface__["data"])
        probes.relight("sky", 3)
        del probes
        np.testing.assert_array_equal(view, light[1][1])
        with self.assertRaises(ValueError):
            view[0] = 1
        np.testing.assert_array_equal(self.two()[0].light(-1)["sky"][1], view)
        self.assertRaises(IndexError, self.two()[0].light, 2)

    def test_hier_adds_what_edges_carry(self):
        scene = ssphh.load("builtin:cornell")
        probes = ssphh.bake(scene, spp=4, face=8, degree=1, records=0)
        ends, share = probes.edges
        self.assertEqual((len(ends), share.shape), (len(share), (len(ends),)))
        used = probes.hier("mean")
        self.assertEqual(used, len(ends))
        self.assertGreater(float(probes.hierarchy[:, 0].sum()), float(probes.radiance[:, 0].sum()))
        self.assertEqual(probes.hier("mean", neighbors=0), 0)
        np.testing.assert_array_equal(probes.hierarchy, probes.radiance)
        error_of(self, probes.hier, "matrix")
        self.assertEqual(error_of(self, probes.hier, "sum").where, "operator")

    def test_records_lie_on_surfaces(self):
        scene = ssphh.load("builtin:box")
        probes = ssphh.bake(scene, operator="surfel", degree=1, records=64, directions=64, surfel_size=0.25, viz="off")
        points, normals, light = probes.records
        self.assertEqual(points.shape, light.shape)
        self.assertLessEqual(len(points), 128)
        low, high = scene.bounds
        self.assertLess(np.minimum(abs(points - low), abs(points - high)).min(axis=1).max(), 1e-3)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, rtol=1e-5)
        self.assertTrue(np.all(light >= 0) and light.max() > 0)
        self.assertGreater(points.strides[0], 12, "a view of where they lie")

    def test_refuses_arrays_of_other_shapes_and_types(self):
        make = ssphh.ProbeSet.from_arrays
        good = np.array([constant(1), constant(1)])
        for positions, reflected, keywords, where in (
            ([[0, 0]], good[:1], {}, "positions"),
            ([[0, 0, np.nan]], good[:1], {}, "positions"),
            ("somewhere", good, {}, "positions"),
            ([["a", "b", "c"]], good[:1], {}, "positions"),
            (np.zeros((0, 3)), good, {}, "positions"),
            (PLACES, good[:1], {}, "reflected"),
            (PLACES, good[:, :7], {}, "reflected"),
            (PLACES, good.astype(complex), {}, "reflected"),
            (PLACES, np.zeros((2, 144, 3)), {}, "reflected"),
            (PLACES, good, {"light_groups": ["a", "b"]}, "reflected"),
            (PLACES, good, {"names": ["a"]}, "names"),
            (PLACES, np.array([good, good]), {"light_groups": ["a", "a"]}, "light_groups"),
        ):
            with self.subTest(where=where, shape=np.shape(reflected), **keywords):
                self.assertEqual(error_of(self, make, positions, reflected, **keywords).where, where)
        error_of(self, make, PLACES, np.full_like(good, np.inf))
        self.assertIn("N x 3", error_of(self, make, [[0, 0]], good).problem)

    def test_probes_of_another_scene_are_refused(self):
        probes, _ = self.two()
        probes.save(self.path("a.sphl"))
        box = ssphh.load("builtin:box")
        e = error_of(self, ssphh.ProbeSet.load, self.path("a.sphl"), box)
        self.assertIn("another scene", e.problem)
        self.assertIn("force", e.hint)
        with self.assertLogs("ssphh", "WARNING"):
            ssphh.ProbeSet.load(self.path("a.sphl"), box, force=True)
        error_of(self, ssphh.ProbeSet.load, self.path("none.sphl"))
        error_of(self, probes.save, self.path("a.png"))


if __name__ == "__main__":
    unittest.main()
