#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""Changes one comparison or number of the core at a time and asks whether a test notices.

    scripts/mutate.py --count 100 --seed 1        # about a minute each on two cores
    scripts/mutate.py --list --files judgement    # what could be changed

Works on a copy of the sources, in build/mutation, with the core alone (no PCL). The
same seed chooses the same changes of the same sources. A change that no test notices is
printed with its line ("survived"); one that does not compile, or leaves the compiler's output
as it was ("same code"), counts for nothing. Python's standard library is enough.
"""

import argparse
import hashlib
import os
import random
import re
import shutil
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ROOMS = ["estimation", "judgement", "matching", "math", "registration", "scan"]

# The tests of a room, the most likely to notice first; each is run only if those before it
# have not.
TESTS = {
    "estimation": ["test_stages", "test_estimator", "test_backend_conformance",
                   "test_parameters", "test_estimator_robustness",
                   "test_real_correspondences", "test_pair_registration",
                   "test_cloud_check"],
    "judgement": ["test_verdict", "test_cloud_check", "test_free_motion",
                  "test_pair_registration", "test_estimator",
                  "test_backend_conformance"],
    "matching": ["test_feature_matching", "test_feature_tree", "test_equal_rows",
                 "test_pair_registration"],
    "math": ["test_alignment", "test_stages", "test_surface_kernels", "test_kernels",
             "test_feature_extractor", "test_cloud_check", "test_verdict",
             "test_free_motion", "test_backend_conformance", "test_estimator",
             "test_pair_registration"],
    "registration": ["test_pair_registration", "test_estimator", "test_verdict",
                     "test_estimator_robustness", "test_scan",
                     "test_real_correspondences"],
    "scan": ["test_scan", "test_viewpoint", "test_left_out", "test_equal_points",
             "test_feature_extractor", "test_resolution", "test_surface_kernels",
             "test_pair_registration"],
}

# What is replaced by what. Operators stand between blanks, which templates' brackets don't.
OPERATORS = [
    (r"(?<= )<(?= )", "<="), (r"(?<= )<=(?= )", "<"),
    (r"(?<= )>(?= )", ">="), (r"(?<= )>=(?= )", ">"),
    (r"(?<= )<(?= )", ">"), (r"(?<= )>(?= )", "<"),
    (r"(?<= )==(?= )", "!="), (r"(?<= )!=(?= )", "=="),
    (r"(?<= )&&(?= )", "||"), (r"(?<= )\|\|(?= )", "&&"),
    (r"(?<= )\+(?= )", "-"), (r"(?<= )-(?= )", "+"),
    (r"\bstd::min\b", "std::max"), (r"\bstd::max\b", "std::min"),
    (r"\btrue\b", "false"), (r"\bfalse\b", "true"),
]
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+|\d+)(f?)(?![\w.])")


def other_number(text):
    """Near enough that only a test that looks closely sees it, but not equal."""
    if re.fullmatch(r"\d+", text):
        return str(int(text) + 1)
    value = float(text)
    changed = f"{value * 1.3:.6g}" if value != 0 else "1"
    return changed if re.search(r"[.e]", changed) else changed + ".0"


def code_of(source):
    """The source with comments, strings and directives blanked out, of the same length."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    source = re.sub(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', blank, source)
    source = re.sub(r"//[^\n]*|/\*.*?\*/", blank, source, flags=re.S)
    source = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, source, flags=re.M)
    # Sizes of types: another one does not compile.
    return re.sub(r"static_assert\s*\([^;]*;|<[\w:, ]*\b\d+(?:, \d+)*>", blank, source)


def mutations_of(path):
    """All changes of a file: (path, line number, begin, end, replacement)."""
    with open(os.path.join(ROOT, path)) as file:
        code = code_of(file.read())
    found = []
    def add(begin, end, replacement):
        found.append((path, code.count("\n", 0, begin) + 1, begin, end, replacement))
    for pattern, replacement in OPERATORS:
        for match in re.finditer(pattern, code):
            add(match.start(), match.end(), replacement)
    for match in NUMBER.finditer(code):
        add(match.start(1), match.end(1), other_number(match.group(1)))
    return sorted(found, key=lambda m: (m[2], m[4]))


def all_mutations(pattern):
    found = []
    for room in ROOMS:
        for folder, folders, files in os.walk(os.path.join(ROOT, "src", room)):
            folders.sort()
            for name in sorted(files):
                path = os.path.relpath(os.path.join(folder, name), ROOT)
                if name.endswith((".cpp", ".h")) and re.search(pattern, path):
                    found += mutations_of(path)
    return found


class Workshop:
    """A copy of the sources, its build, and how long its tests take."""

    def __init__(self, folder, jobs):
        self.source = os.path.join(folder, "source")
        self.build = os.path.join(folder, "build")
        self.jobs = jobs
        self.seconds = {}

    def run(self, command, timeout=None):
        """The exit status and the output; None for a status if it takes too long."""
        try:
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  timeout=timeout, cwd=self.build, text=True,
                                  errors="replace")
            return done.returncode, done.stdout
        except subprocess.TimeoutExpired:
            return None, ""

    def prepare(self, tests):
        os.makedirs(self.build, exist_ok=True)
        names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True,
                               stdout=subprocess.PIPE, text=True).stdout.split("\0")
        for name in filter(None, names):
            self.put(name)
        status, output = self.run([
            "cmake", "-S", self.source, "-B", self.build, "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -D_GLIBCXX_ASSERTIONS", "-DPCL_FLASHREG_WITH_PCL=OFF",
            "-DPCL_FLASHREG_WITH_CUDA=OFF", "-DPCL_FLASHREG_BUILD_TESTS=ON",
            "-DPCL_FLASHREG_DATASETS=" + datasets()])
        if status == 0:
            status, output = self.make(tests)
        if status != 0:
            sys.exit(output[-3000:] + "\nscripts/mutate.py: the sources don't build")
        for test in tests:
            start = time.time()
            status, output = self.run([self.executable(test)])
            if status != 0:
                sys.exit(output[-3000:] + f"\nscripts/mutate.py: {test} fails as it is")
            self.seconds[test] = time.time() - start

    def put(self, name, text=None):
        """A file as it is in the project, or another text; unchanged files keep their time."""
        target = os.path.join(self.source, name)
        if text is None:
            with open(os.path.join(ROOT, name), "rb") as file:
                text = file.read()
        if os.path.exists(target):
            with open(target, "rb") as file:
                if file.read() == text:
                    return
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "wb") as file:
            file.write(text)

    def make(self, targets):
        return self.run(["cmake", "--build", self.build, "--parallel", str(self.jobs),
                         "--target"] + targets)

    def executable(self, test):
        return os.path.join(self.build, "test", test)

    def library(self):
        """What the compiler made of the core."""
        with open(os.path.join(self.build, "src", "libpcl_flashreg_core.a"), "rb") as file:
            return hashlib.sha256(file.read()).hexdigest()

    def judge(self, tests):
        """Which test notices what was built last; nothing if none does."""
        for test in tests:
            status, output = self.make([test])
            if status != 0:
                return "not compiled" if "error" in output else "not built: " + output[-500:]
            limit = 20 + 5 * self.seconds[test]
            status, _ = self.run([self.executable(test), "--gtest_fail_fast",
                                  "--gtest_brief=1"], limit)
            if status is None:
                return test + " took too long"
            if status != 0:
                return test
        return ""


def datasets():
    return os.environ.get("PCL_FLASHREG_DATASETS") or os.path.join(
        os.path.dirname(ROOT), "shared", "data")


def try_one(workshop, mutation, before):
    path, _, begin, end, replacement = mutation
    with open(os.path.join(ROOT, path)) as file:
        text = file.read()
    workshop.put(path, (text[:begin] + replacement + text[end:]).encode())
    status, output = workshop.make(["pcl_flashreg_core"])
    if status != 0:
        return "not compiled"
    if workshop.library() == before:
        return "same code"
    verdict = workshop.judge(TESTS[path.split("/")[1]])
    return "noticed by " + verdict if verdict else "survived"


def describe(mutation):
    path, number, begin, end, replacement = mutation
    with open(os.path.join(ROOT, path)) as file:
        text = file.read()
    start, stop = text.rfind("\n", 0, begin) + 1, text.find("\n", end)
    line = text[start:begin] + "{" + text[begin:end] + " -> " + replacement + "}"
    return f"{path}:{number}: {(line + text[end:stop]).strip()}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100, help="changes to try")
    parser.add_argument("--seed", type=int, default=1, help="which of them")
    parser.add_argument("--skip", type=int, default=0, help="so many of them are done")
    parser.add_argument("--minutes", type=float, help="begin no other after so many")
    parser.add_argument("--files", default="", help="only paths that match this")
    parser.add_argument("--list", action="store_true", help="list all changes, try none")
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", "mutation"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()

    chosen = all_mutations(options.files)
    if options.list:
        print("\n".join(describe(mutation) for mutation in chosen))
        return
    random.Random(options.seed).shuffle(chosen)
    chosen = chosen[options.skip:options.skip + options.count]
    rooms = {mutation[0].split("/")[1] for mutation in chosen}
    tests = sorted({test for room in rooms for test in TESTS[room]})
    workshop = Workshop(options.folder, options.jobs)
    workshop.prepare(tests)
    before = workshop.library()
    start, counts = time.time(), {}
    for number, mutation in enumerate(chosen, options.skip):
        if options.minutes and time.time() - start > 60 * options.minutes:
            break
        verdict = try_one(workshop, mutation, before)
        workshop.put(mutation[0])
        print(f"{number} {verdict}: {describe(mutation)}", flush=True)
        kind = verdict.split(" by ")[0]
        counts[kind] = counts.get(kind, 0) + 1
    print(", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())))


if __name__ == "__main__":
    main()
