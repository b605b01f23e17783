import unittest

import numpy as np

import ssphh
from support import InAFolder, error_of

SMALL = dict(directions=64, surfel_size=0.8, link_rays=16, degree=2, records=128, warm_start=False)


class Relighting(InAFolder):
    @classmethod
    def setUpClass(cls):
        cls.scene = ssphh.load("builtin:two-rooms")
        cls.points, cls.normals, cls.moves = cls.scene.surface_points(100, seed=2)

    def light(self, session):
        return session.irradiance(self.points, self.normals, self.moves)

    def test_groups_scale_light(self):
        session = ssphh.RelightSession(self.scene, **SMALL)
        report = session.update()
        self.assertTrue(report["converged"])
        self.assertEqual(report["changed_probes"], list(range(6)))
        before = self.light(session)
        session.set_group("lamp", [2, 1, 0.5])
        session.update()
        np.testing.assert_allclose(self.light(session), before * [2, 1, 0.5], rtol=2e-3, atol=1e-6)
        session.set_group("lamp", 0)
        session.update()
        self.assertEqual(float(self.light(session).max()), 0)

    def test_doors_and_lamps_lead_where_a_fresh_session_begins(self):
        moved = ssphh.RelightSession(self.scene, **SMALL)
        moved.update()
        shut = self.light(moved)
        moved.time = 1
        moved.update()
        opened = self.light(moved)
        fresh = ssphh.RelightSession(ssphh.load("builtin:two-rooms", time=1), **SMALL)
        fresh.update()
        np.testing.assert_allclose(fresh.reflected, moved.reflected, rtol=1e-3, atol=1e-5)
        # The lamp is in the room at -x: through the door its light comes to the other.
        dark = (self.points[:, 0] > 0.5) & ~self.moves
        self.assertGreater(dark.sum(), 10)
        self.assertGreater(float(opened[dark].mean()), 10 * float(shut[dark].mean()))
        lamp = self.scene.lights[0]
        moved.set_light("lamp", position=lamp.position, intensity=2 * lamp.intensity)
        moved.update()
        np.testing.assert_allclose(self.light(moved), 2 * opened, rtol=2e-3, atol=1e-5)

    def test_follows_the_truth(self):
        session = ssphh.RelightSession(self.scene, records=1024, link_rays=64)
        session.time = 0.5
        session.update()
        _, indirect = session.trace_irradiance(self.points, self.normals, spp=128)
        np.testing.assert_allclose(self.light(session).mean(axis=0), indirect.mean(axis=0), rtol=0.1)

    def test_its_light_is_saved_as_a_bake(self):
        session = ssphh.RelightSession(self.scene, **SMALL)
        session.update()
        probes = session.probe_set()
        probes.save(self.path("a.sphl"))
        again = ssphh.ProbeSet.load(self.path("a.sphl"), self.scene)
        np.testing.assert_allclose(again.reflected, session.reflected, rtol=2e-3, atol=1e-5)
        np.testing.assert_array_equal(again.positions, session.positions)
        np.testing.assert_array_equal(ssphh.RelightSession(self.scene, again, **SMALL).positions, session.positions)

    def test_draws_pictures(self):
        session = ssphh.RelightSession(self.scene, **SMALL)
        session.update()
        picture = session.render(width=32, height=18, spp=2)
        self.assertEqual((picture.shape, picture.dtype), ((18, 32, 3), np.float32))
        session.set_group("lamp", 0)
        session.update()
        self.assertEqual(float(session.render(width=32, height=18, spp=2).max()), 0)

    def test_one_thing_at_a_time(self):
        session = ssphh.RelightSession(self.scene, **SMALL)
        session.update()
        with self.assertRaisesRegex(ssphh.Error, "is at work"):
            session.irradiance(self.points, self.normals, progress=lambda *told: session.update())
        self.light(session)  # and goes on

    def test_refuses_what_there_is_not(self):
        session = ssphh.RelightSession(self.scene, **SMALL)
        self.assertIn("update()", error_of(self, self.light, session).hint)
        session.update()
        self.assertIn("lamp", error_of(self, session.set_light, "lmap", intensity=1).hint)
        self.assertIn("lamp", error_of(self, session.set_group, "lmap", 1).hint)
        self.assertEqual(error_of(self, session.set_light, "lamp", direction=[0, 0, 0]).where, "direction")
        self.assertEqual(error_of(self, session.set_light, "lamp", position=[0, 0]).where, "position")
        session.set_light("lamp", intensity=-1)
        error_of(self, session.update)
        error_of(self, ssphh.RelightSession, self.scene, operator="path")


if __name__ == "__main__":
    unittest.main()
