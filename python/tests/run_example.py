"""run_example.py SCRIPT: runs an example at small size; its words must be those of SCRIPT's .expected, its numbers within 5 %
or one of their last digit; its picture must show something."""

import os
import re
import subprocess
import sys
import tempfile

import ssphh

NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def difference(found, expected):
    """What is wrong with a line; "" where nothing is."""
    if NUMBER.sub("#", found) != NUMBER.sub("#", expected):
        return f"printed {found!r}, expected {expected!r}"
    for mine, theirs in zip(NUMBER.findall(found), NUMBER.findall(expected)):
        last = 10.0 ** -len(theirs.partition(".")[2])
        if abs(float(mine) - float(theirs)) > max(0.05 * abs(float(theirs)), last if "." in theirs else 0) * 1.0001:
            return f"printed {mine}, expected {theirs} in {expected!r}"
    return ""


def main(script):
    with open(os.path.splitext(script)[0] + ".expected") as file:
        expected = file.read().splitlines()
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, script, "--small", "-o", folder], text=True, capture_output=True)
        print(done.stdout, done.stderr, sep="")
        found = done.stdout.splitlines()
        problems = [d for d in map(difference, found, expected) if d]
        if len(found) != len(expected):
            problems.append(f"printed {len(found)} lines, expected {len(expected)}")
        if done.returncode:
            problems.append(f"ended with {done.returncode}")
        picture = os.path.join(folder, os.path.basename(script).replace(".py", ".png"))
        if "matplotlib is not installed" not in done.stderr:
            if not os.path.exists(picture):
                problems.append("left no picture")
            elif ssphh.read_image(picture).std() < 0.1:
                problems.append("its picture is empty")
    print(*problems, sep="\n")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
