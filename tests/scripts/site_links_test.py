#!/usr/bin/env python3
"""What scripts/site says of broken links and of what pages load from elsewhere."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
from site_links import broken_links, foreign_resources  # noqa: E402


class Links(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def page(self, name, body):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(body)

    def test_links_to_what_is_there_are_well(self):
        self.page("a.html", '<h2 id="one">1</h2><a href="#one"></a><a href="b/c.html#two"></a><a href="https://example.org/x"></a><a href="b"></a>')
        self.page("b/c.html", '<a name="two"></a><a href="../a.html#one"></a><a href="../a.html?q=1"></a>')
        self.page("b/index.html", "")
        self.assertEqual(broken_links(self.folder), [])
        self.assertEqual(foreign_resources(self.folder), [])

    def test_broken_ones_are_told(self):
        self.page("a.html", '<a href="none.html"></a><a href="b.html#three"></a><a href="#four"></a><img src="no.png">')
        self.page("b.html", "")
        self.assertEqual(broken_links(self.folder), ["a.html: none.html: no such file", "a.html: b.html#three: no such heading", "a.html: #four: no such heading",
                                                     "a.html: no.png: no such file"])

    def test_what_other_hosts_would_send_is_told(self):
        self.page("a.html", '<script src="https://cdn.example.org/a.js"></script><link rel="stylesheet" href="//fonts.example.org/f.css"><a href="https://ok.example.org">')
        self.page("s.css", "@font-face { src: url(https://fonts.example.org/f.woff) } .a { background: url(data:image/png;base64,AA) }")
        self.assertEqual([line.split(": ")[1] for line in foreign_resources(self.folder)],
                         ["https://cdn.example.org/a.js", "//fonts.example.org/f.css", "https://fonts.example.org/f.woff"])


if __name__ == "__main__":
    unittest.main()
