"""What scripts share that measure with the tool and write a page of docs."""

import hashlib
import json
import os
import pathlib
import platform
import subprocess


class CachedTool:
    """Runs commands of the tool; what the same tool did before is taken from the folder."""

    def __init__(self, tool, folder):
        self.tool, self.folder = tool, folder
        self.hash = hashlib.sha256(tool.read_bytes()).hexdigest()
        folder.mkdir(parents=True, exist_ok=True)

    def run(self, *arguments, output=None, png=False):
        """The command's JSON object; with `output`, a file name's end, also the file that it wrote (its picture with `png`)."""
        text = [str(a) for a in arguments]
        sources = "".join(hashlib.sha256(pathlib.Path(a).read_bytes()).hexdigest() for a in text
                          if not a.startswith(str(self.folder)) and pathlib.Path(a).is_file())
        key = hashlib.sha256("\n".join([self.hash, sources, str(png), *text]).encode()).hexdigest()[:24]
        result, file = self.folder / f"{key}.json", self.folder / f"{key}{output}"
        if output:
            text += ["-o", str(file)]
        if png:
            text += ["--png", str(self.folder / f"{key}.png")]
        if not result.exists():
            done = subprocess.run([self.tool, *text, "--json", "--progress", "none"], capture_output=True, text=True)
            if done.returncode != 0:
                raise SystemExit(f"ssphh {' '.join(text)}\n{done.stderr}")
            result.write_text(done.stdout)
        found = json.loads(result.read_text())
        if png:
            file = self.folder / f"{key}.png"
        return (found, file) if output else found


def table(head, rows):
    """Markdown."""
    lines = ["| " + " | ".join(str(h) for h in head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def machine():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return f"{line.split(':', 1)[1].strip()}, {os.cpu_count()} cores"
    return platform.machine()
