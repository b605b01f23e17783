"""A folder that shows one figure: its panels, the command lines that made them, and a page that needs nothing else."""

import base64
import html
import json
import os
import shlex
import shutil
import subprocess
import time

from measured_page import machine

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 90rem; padding: 0 1rem; color: #111; background: #fff; }
.panels { display: grid; gap: .8rem; }
figure { margin: 0; } img { width: 100%; background: #000; display: block; } figcaption { color: #333; font-size: .9em; }
table { border-collapse: collapse; margin: .5rem 0 1rem; } td, th { border: 1px solid #999; padding: .2rem .7rem; text-align: right; }
td:first-child, th:first-child { text-align: left; } pre { overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere; background: #eee; padding: .7rem; }
"""


class FigureFolder:
    """Runs the tool within the folder, so that the command lines can be typed there again."""

    def __init__(self, tool, folder, title, about):
        self.tool, self.folder, self.title, self.about = tool, folder, title, about
        self.commands, self.body, self.began = [], "", time.time()
        folder.mkdir(parents=True, exist_ok=True)

    def run(self, *arguments):
        """The command's JSON object."""
        words = [str(a) for a in arguments]
        self.commands.append("ssphh " + shlex.join(words))
        done = subprocess.run([self.tool, *words, "--json", "--progress", "none"], cwd=self.folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{self.commands[-1]}\n{done.stderr}")
        return json.loads(done.stdout)

    made = {}  # pictures of this run: by what was asked for, the path without its ending

    def picture(self, name, *arguments):
        """Runs a command that writes NAME.exr and NAME.png; both are copied where another figure of this run has made the same."""
        words = [str(a) for a in arguments]
        line = [*words, "-o", f"{name}.exr", "--png", f"{name}.png"]
        first = self.made.setdefault(tuple(words), self.folder / name)
        if first == self.folder / name:
            self.run(*line)
            return
        self.commands.append("ssphh " + shlex.join(line))
        for ending in ("exr", "png"):
            shutil.copyfile(f"{first}.{ending}", f"{self.folder / name}.{ending}")

    def panels(self, rows):
        """Rows of (PNG file's name, caption), or None for an empty place; rows are equally long."""
        places = "".join("<div></div>" if place is None else self._panel(*place) for row in rows for place in row)
        self.body += f'<div class="panels" style="grid-template-columns: repeat({len(rows[0])}, 1fr)">{places}</div>'

    def _panel(self, name, caption):
        data = base64.b64encode((self.folder / name).read_bytes()).decode()
        text = html.escape(caption)
        return f'<figure><img src="data:image/png;base64,{data}" alt="{text}"><figcaption>{text}</figcaption></figure>'

    def table(self, head, rows):
        def line(cells, tag):
            return "<tr>" + "".join(f"<{tag}>{html.escape(str(c))}</{tag}>" for c in cells) + "</tr>"
        self.body += "<table>" + line(head, "th") + "".join(line(row, "td") for row in rows) + "</table>"

    def text(self, title, words):
        self.body += f"<h2>{html.escape(title)}</h2><pre>{html.escape(words)}</pre>"

    def note(self, text):
        self.body += f"<p>{html.escape(text)}</p>"

    def write(self):
        """Writes commands.txt and index.html, each whole or not at all."""
        lines = "\n".join(self.commands) + "\n"
        where = f"{machine()}, {time.time() - self.began:.0f} s"
        page = (f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
                f"<title>{html.escape(self.title)}</title><style>{STYLE}</style>\n<h1>{html.escape(self.title)}</h1>\n"
                f"<p>{html.escape(self.about)}</p>\n{self.body}\n<h2>Command lines</h2>\n<pre>{html.escape(lines)}</pre>\n"
                f"<p>Made by <code>scripts/figures</code> on {html.escape(where)}.</p></html>\n")
        for name, text in (("commands.txt", lines), ("index.html", page)):
            part = self.folder / f"{name}.part"
            part.write_text(text)
            os.replace(part, self.folder / name)
