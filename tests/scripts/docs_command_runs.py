"""Command lines of pages, run with their sizes and counts turned down."""

import json
import re
import shlex
import subprocess

from docs_command_lines import is_concrete

# Commands that tests do not run, and why; each has tests of its own, and scripts/docs-commands runs them.
NOT_IN_TESTS = [
    (r"cycles", "needs Blender"),
    (r"^(view|turntable|bench-frame)|--backend gl", "needs OpenGL"),
    (r"^(broker|worker|farm (?!keygen))|--broker", "needs a farm that stays"),
    (r"--watch", "goes on until Ctrl-C"),
    (r"^report", "takes minutes"),
    (r"^web", "needs the page, which npm builds"),
    (r"sponza|hotel-room|gl\.exr", "needs a large scene"),
    (r"--max-probes 20000|many\.sphl|^respond|--frames 60 --truth|ssphh-paper|^measure .*(ssphh|ddgi)", "takes many seconds"),
]
# What nothing runs.
NOT_AT_ALL = [
    (r"face\?", "needs pictures of another renderer"),
    (r"^farm release", "needs a job that was set aside"),
]

# In place of what a line says, or behind it.
PICTURE = {"--width": "16", "--height": "9", "--spp": "1"}
LESS = {
    "bake": {"--quality": "draft", "--face": "4", "--spp": "1", "--directions": "64", "--link-rays": "8", "--records": "64", "--surfel-size": "0.5"},
    "render": PICTURE,
    "truth": {"--width": "16", "--height": "9", "--spp": "2"},
    "measure": {"--points": "8", "--truth-spp": "4", "--max-depth": "3"},
    "relight": {"--frames": "3", "--directions": "64", "--surfel-size": "0.5", "--points": "8", "--truth-spp": "4", **PICTURE},
    "leak": {"--points": "8", "--truth-spp": "4", "--map-spp": "2", "--width": "16", "--height": "9"},
    "cook": {"--points": "0"},
    "lightmap": {"--size": "64"},
    "probe preview": {"--width": "16"},
    "sphl sample": {"--size": "8", "--spp": "1"},
}
ONLY_NEW = {"--quality", "--face", "--spp", "--directions", "--link-rays", "--records", "--surfel-size"}  # of bake: not with --update
ONLY_PATHS = {"--face", "--spp"}
FOR_PLACEHOLDERS = {"SCENE": "room.glb", "OUT": "out", "OUT.glb": "out.glb", "FILE.sphl": "day.sphl", "P.sphl": "day.sphl"}


def why_not(line, everywhere=False):
    """Why tests do not run a line, or with `everywhere` why nothing does; or None."""
    for pattern, reason in NOT_AT_ALL if everywhere else NOT_AT_ALL + NOT_IN_TESTS:
        if re.search(pattern, line):
            return reason
    return None if all(map(is_concrete, typed(line))) else "has placeholders"


def typed(line):
    """What somebody would type: names of files that there are, and one line for each of `three|godot`."""
    line = re.sub(r"(?<!\S)[A-Z][\w.]*(?!\S)", lambda match: FOR_PLACEHOLDERS.get(match[0], match[0]), line)
    several = re.findall(r"(?<!\S)[a-z]+(?:\|[a-z]+)+(?!\S)", line)
    return [line.replace(several[0], one) for one in several[0].split("|")] if len(several) == 1 else [line]


def turned_down(words):
    command = " ".join(words[:2]) if " ".join(words[:2]) in LESS else words[0]
    less = dict(LESS.get(command, {}))
    if "--update" in words:
        less = {name: value for name, value in less.items() if name not in ONLY_NEW}
    if "surfel" in words:
        less = {name: value for name, value in less.items() if name not in ONLY_PATHS}
    if "--passes" in words:
        less["--passes"] = "1"
    if "--probes" not in words and command == "lightmap":
        less["--quality"] = "draft"
    words = [re.sub(r"(resolution|photons)=\d+", r"\1=32", re.sub(r"^auto:0\.\d+$", "auto:1.5", word)) for word in words]
    for name, value in less.items():
        if name in words:
            words[words.index(name) + 1] = value
        else:
            words += [name, value]
    return words


class Runs:
    """Each page has a folder, with files that readers are told to bring."""

    def __init__(self, tool, root, folder):
        self.tool, self.root, self.folder = tool, root, folder
        self.given = folder / "given"
        self.given.mkdir()
        self.make_files()

    def make_files(self):
        self.call(self.given, "export builtin:cornell --to gltf -o glb")
        for name in ("examples", "plans"):
            (self.given / name).symlink_to(self.root / name)
        for name in ("my", "room", "house", "hall"):
            (self.given / f"{name}.glb").hardlink_to(self.given / "glb/scene.glb")
        for name in ("room", "evening", "fire"):
            (self.given / f"{name}.ssphh.json").write_text(json.dumps({"scene": "room.glb"}))
        self.call(self.given, "bake evening.ssphh.json -o day.sphl")
        for name in ("evening", "my"):
            (self.given / f"{name}.sphl").hardlink_to(self.given / "day.sphl")
        self.call(self.given, "render builtin:cornell --projection cube --width 48 --height 8 -o strip.exr", less=False)
        self.call(self.given, "cubemap convert strip.exr -o cube-a.exr --from strip-h --to cross-v")
        for name in ("ref", "test"):
            self.call(self.given, f"render room.glb --aov indirect,albedo,normal,depth -o {name}.exr")
        (self.given / "cube-b.exr").hardlink_to(self.given / "cube-a.exr")

    def call(self, folder, line, less=True):
        words = shlex.split(line)
        words = (turned_down(words) if less else words) + ["--progress", "none", "--config", "none"]
        done = subprocess.run([self.tool, *words], cwd=folder, capture_output=True, text=True)
        return done.returncode, f"{' '.join(words)}\n{done.stderr}"

    def run(self, page, line):
        """The worst exit code, and what was told on stderr then."""
        folder = self.folder_of(page)
        told = [self.call(folder, one) for one in typed(line)]
        return max(told)

    def folder_of(self, page):
        folder = self.folder / page.replace("/", "-")
        if not folder.exists():
            folder.mkdir()
            for file in self.given.iterdir():
                if file.is_symlink():
                    (folder / file.name).symlink_to(file.resolve())
                elif file.is_file():
                    (folder / file.name).hardlink_to(file)
        return folder
