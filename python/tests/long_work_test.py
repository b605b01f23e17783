"""Long calls: Ctrl-C, progress, other threads, messages."""

import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import ssphh
from support import InAFolder, error_of

# Bakes for minutes, tells when GEN is under way, and ends with what stopped it.
ENDLESS = """
import sys, ssphh
scene = ssphh.load("builtin:cornell")
def told(stage, done, total, unit):
    if stage == "GEN":
        print("GEN", flush=True)
try:
    ssphh.bake(scene, sys.argv[1], spp=65536, face=16, degree=1, records=0, viz="off", progress=told)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""

SMALL = dict(spp=2, face=8, degree=2, records=0, viz="off")


class LongWork(InAFolder):
    def test_ctrl_c_stops_it(self):
        process = subprocess.Popen([sys.executable, "-c", ENDLESS, self.path("a.sphl")], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.assertEqual(process.stdout.readline(), "GEN\n")
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=300)[0].splitlines()
        self.assertEqual(said[-1], "interrupted")
        self.assertEqual(process.returncode, 0)
        self.assertFalse(os.path.exists(self.path("a.sphl")))

    def test_an_interrupted_bake_goes_on_to_the_same_bits(self):
        scene = ssphh.load("builtin:cornell")
        settings = dict(spp=64, face=16, degree=2, records=0, viz="off")
        ssphh.bake(scene, self.path("whole.sphl"), **settings)

        class Enough(Exception):
            pass

        def stop(stage, done, total, unit):
            if stage == "GEN" and os.path.exists(self.path("part.sphl.checkpoint")):
                raise Enough
        try:
            ssphh.bake(scene, self.path("part.sphl"), progress=stop, **settings)
        except Enough:
            self.assertFalse(os.path.exists(self.path("part.sphl")))
            self.assertTrue(os.path.exists(self.path("part.sphl.checkpoint")))
        ssphh.bake(scene, self.path("part.sphl"), **settings)
        self.assertEqual(self.bytes_of("part.sphl"), self.bytes_of("whole.sphl"))
        self.assertFalse(os.path.exists(self.path("part.sphl.checkpoint")))

    def test_progress_is_told_in_the_thread_that_called(self):
        told, threads = [], set()

        def note(*arguments):
            told.append(arguments)
            threads.add(threading.get_ident())
        ssphh.bake(ssphh.load("builtin:cornell"), progress=note, **SMALL)
        self.assertEqual(threads, {threading.get_ident()})
        last = {stage: (done, total, unit) for stage, done, total, unit in told}
        done, total, unit = last["GEN"]
        self.assertEqual((done, unit), (total, "texels"))
        for stage, done, total, unit in told:
            self.assertLessEqual(done, total)

    def test_what_progress_raises_ends_the_work(self):
        def fail(*arguments):
            raise ZeroDivisionError("mine")
        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            ssphh.bake(ssphh.load("builtin:cornell"), progress=fail, **SMALL)
        self.assertEqual(error_of(self, ssphh.bake, ssphh.load("builtin:cornell"), progress=1).where, "progress")

    def test_other_threads_run_meanwhile(self):
        scene = ssphh.load("builtin:cornell")
        under_way, over = threading.Event(), threading.Event()

        def work():
            under_way.set()
            ssphh.bake(scene, **SMALL)
            over.set()
        before = sys.getswitchinterval()
        sys.setswitchinterval(1000)  # nobody is made to give way: this thread runs only where the other lets it
        try:
            thread = threading.Thread(target=work)
            thread.start()
            under_way.wait()
            counted = 0
            while not over.is_set():
                counted += 1
                time.sleep(0)
            thread.join()
        finally:
            sys.setswitchinterval(before)
        self.assertGreater(counted, 0)

    def test_threads_may_work_at_once_on_one_scene_to_the_same_bits(self):
        scene = ssphh.load("builtin:cornell")
        found = [None] * 3

        def work(i):
            found[i] = ssphh.bake(scene, **SMALL)
        threads = [threading.Thread(target=work, args=(i,)) for i in range(len(found))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])


if __name__ == "__main__":
    unittest.main()
