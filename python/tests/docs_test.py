"""The code of docs/python.md runs as it stands there, one block after the other."""

import contextlib
import io
import os
import re
import unittest

from support import SOURCE, InAFolder


class Page(InAFolder):
    def test_its_code_runs(self):
        with open(os.path.join(SOURCE, "docs/python.md")) as file:
            blocks = re.findall(r"```python\n(.*?)```", file.read(), re.S)
        self.assertGreater(len(blocks), 5)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        names, said = {}, io.StringIO()
        for block in blocks:
            with contextlib.redirect_stdout(said):
                exec(compile(block, "docs/python.md", "exec"), names)
        lines = said.getvalue().splitlines()
        self.assertLess(float(lines[0]), 0.1, "the lookup's error in the first ten lines")
        self.assertEqual(lines[-1].split(" | ")[1], "was baked in another scene or pose: time 1 s, now 0 s")
        self.assertTrue({"rooms.sphl", "rooms.png", "rooms-degree2.sphl"} <= set(os.listdir(self.folder)))


if __name__ == "__main__":
    unittest.main()
