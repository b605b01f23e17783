"""Copies of the tree in which scripts/mutate builds and asks the tests."""

import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "build/mutate"
# Beside test_MODULE: what needs more of the house than the module to be tested.
OWN_TESTS = {**{module: [f"test_{module}", "test_render"] for module in ("probes", "place", "transport", "bake", "study")},
             "methods": ["test_methods", "test_pipeline", "test_render", "test_pictures"],  # drawings and shaders of all of them
             "realtime": ["test_realtime", "test_pictures"], "ssphh": ["test_cli"], "viewer": ["test_viewer", "test_view"]}
OTHER_TESTS = r"^(MdpProbe|example\.)"  # of ctest, beside the GoogleTest programs
SLOW = 0.3  # seconds: tests above come after all others
running = set()  # process groups
ending = False


def run(command, limit, cwd, memory=None):
    """Exit code (None: killed after `limit` seconds) and output. The whole process group ends with it."""

    def prepare():
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))

    if ending:
        sys.exit()  # this thread
    process = subprocess.Popen([str(part) for part in command], cwd=cwd, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, start_new_session=True,
                               preexec_fn=prepare, text=True, errors="replace")
    running.add(process.pid)
    try:
        output, _ = process.communicate(timeout=limit)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return None, process.communicate()[0]
    finally:
        running.discard(process.pid)
        try:
            os.killpg(process.pid, signal.SIGKILL)  # what a failed test has left behind
        except ProcessLookupError:
            pass


def confined(tree, command):
    """The command, able to write nowhere but in `tree` and in a /tmp of its own: a fault in what writes files has once put
    a plain file in place of /dev/full."""
    return ["bwrap", "--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc", "--tmpfs", "/tmp", "--bind", tree, tree,
            "--unshare-pid", "--die-with-parent", *command]


def end_all():
    """Ends what the lanes run and would run, so that their threads come back. Ninja, asked so, ends its compilers, too."""
    global ending
    ending = True
    for group in list(running):
        try:
            os.killpg(group, signal.SIGTERM)
        except ProcessLookupError:
            pass


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def tracked_files():
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            capture_output=True, check=True).stdout.decode().split("\0")
    return [name for name in listed if name and (ROOT / name).is_file()]


class Lane:
    """A copy of the tree with a build of its own."""

    def __init__(self, number, files):
        self.tree = WORK / f"tree{number}"
        self.build = self.tree / "build/release"
        self.objects, self.digests = {}, {}
        kept = set(files)
        for path in self.tree.rglob("*"):
            name = path.relative_to(self.tree)
            if name.parts[0] != "build" and path.is_file() and str(name) not in kept:
                path.unlink()
        for name in files:
            source, copy = ROOT / name, self.tree / name
            if not copy.exists() or copy.read_bytes() != source.read_bytes():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, copy)

    def make(self, targets, jobs=2):
        return run(["cmake", "--build", self.build, "-j", jobs, "--target", *targets], 7200, self.tree)

    def configure(self, targets):
        code, output = run(["cmake", "--preset", "ci"], 600, self.tree)
        if code == 0:
            code, output = self.make(targets)
        if code != 0:
            sys.exit(f"mutate: the tree does not build as it is:\n{output[-3000:]}")
        self.objects = self.object_digests(0)

    def object_digests(self, since):
        found = {}
        for path in self.build.rglob("*.o"):
            if path.stat().st_mtime >= since:
                found[str(path.relative_to(self.build))] = digest(path)
        return found

    def unchanged(self, begin):
        """Whether all that was compiled since `begin` has become what it was."""
        return all(self.objects.get(name) == known for name, known in self.object_digests(begin - 2).items())

    def program(self, name):
        return self.build / "bin" / name


class Suite:
    """The test programs, what each test takes in the tree as it is, and the digests of their programs."""

    def __init__(self, lane, programs):
        self.programs = programs
        self.times, self.broken = {}, {}
        known = WORK / "times.json"
        saved = json.loads(known.read_text()) if known.exists() else {}
        for name in self.programs:
            key = self.digest(lane, name)
            if saved.get(name, {}).get("key") != key:
                print(f"measuring {name}", file=sys.stderr, flush=True)
                saved[name] = {"key": key, **self.measure(lane, name)}
                known.write_text(json.dumps(saved))
            self.times[name], self.broken[name] = saved[name]["times"], saved[name]["broken"]
        for name in self.programs:
            if self.broken[name]:
                print(f"warning: fail without a fault, so left out: {', '.join(self.broken[name])}", file=sys.stderr)

    def know(self, lane):
        lane.digests = {name: self.digest(lane, name) for name in self.programs}

    @staticmethod
    def digest(lane, name):
        drives_tool = name in ("test_cli", "test_view", "test_farm_processes")
        return digest(lane.program(name)) + (digest(lane.program("ssphh")) if drives_tool else "")

    @staticmethod
    def measure(lane, name):
        report = lane.build / f"{name}.json"
        run(confined(lane.tree, [lane.program(name), f"--gtest_output=json:{report}"]), 1800, lane.build)
        if not report.exists():
            sys.exit(f"mutate: {name} ends early in the tree as it is")
        times, broken = {}, []
        for suite in json.loads(report.read_text())["testsuites"]:
            for test in suite["testsuite"]:
                full = f"{suite['name']}.{test['name']}"
                times[full] = float(test["time"].rstrip("s"))
                if test.get("failures"):
                    broken.append(full)
        return {"times": times, "broken": broken}

    def ask(self, lane, name, memory):
        """(outcome, what noticed) of one program; outcome None: nothing noticed."""
        times = self.times[name]
        slow = sorted((t for t in times if times[t] > SLOW), key=times.get)
        slow = [test for test in slow if test not in self.broken[name]]
        for chosen in ("*-" + ":".join(slow + self.broken[name]), ":".join(slow)):
            if not chosen:
                continue
            command = [lane.program(name), "--gtest_fail_fast", "--gtest_brief=1", f"--gtest_filter={chosen}"]
            code, output = run(confined(lane.tree, command), 60 + 6 * sum(times.values()), lane.build, memory)
            if code is None:
                return "hangs", name
            if code != 0:
                if re.search(r"bad_alloc|[Oo]ut of memory|Cannot allocate memory", output):
                    return "out of memory", name
                failed = re.search(r"\[  FAILED  \] (\S+?)(?:, where|\s)", output)
                return "noticed", failed[1] if failed else f"{name} (exit code {code})"
        return None, ""

    def changed(self, lane, name):
        return self.digest(lane, name) != lane.digests[name]

    def ask_others(self, lane, own, memory):
        """All programs that the fault has changed but `own`, quickest first, then what is no GoogleTest program."""
        changed = [n for n in self.programs if n not in own and self.changed(lane, n)]
        for name in sorted(changed, key=lambda n: sum(self.times[n].values())):
            outcome, by = self.ask(lane, name, memory)
            if outcome:
                return outcome, by
        code, output = run(confined(lane.tree, ["ctest", "-R", OTHER_TESTS, "--stop-on-failure", "--timeout", "120"]), 600,
                           lane.build, memory)
        if code is None:
            return "hangs", "ctest"
        if code != 0:
            failed = re.search(r"- (\S+) \(", output)
            return "noticed", failed[1] if failed else "ctest"
        return None, ""


def own_tests(module):
    return OWN_TESTS.get(module, [f"test_{module}"])


def own_targets(module):
    return own_tests(module) + (["ssphh"] if module in ("ssphh", "viewer") else [])


def judge(lane, suite, module, name, text, mutation, memory, own_only):
    """Outcome and what noticed."""
    begin = time.time()
    path = lane.tree / name
    path.write_text(mutation.apply(text))
    try:
        own = own_tests(module)
        code, output = lane.make(own_targets(module), jobs=1)
        if code != 0:
            return "does not compile", ""
        if lane.unchanged(begin):
            if own_only:
                return "same code", ""
            code, output = lane.make(["all"], jobs=1)
            if code != 0:
                return "does not compile", ""
            if lane.unchanged(begin):
                return "same code", ""
        for program in filter(lambda name: suite.changed(lane, name), own):
            outcome, by = suite.ask(lane, program, memory)
            if outcome:
                return ("own tests" if outcome == "noticed" else outcome), by
        if own_only:
            return "survived", ""
        code, output = lane.make(["all"], jobs=2)
        if code != 0:
            return "does not compile", ""
        outcome, by = suite.ask_others(lane, own, memory)
        return {"noticed": "other tests", None: "survived"}.get(outcome, outcome), by
    finally:
        path.write_text(text)
