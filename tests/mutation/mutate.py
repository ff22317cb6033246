#!/usr/bin/env python3
"""Seed bugs, one after the other, and check that a test fails by an assertion.

Usage: tests/mutation/mutate.py [NAME]...    without names, all mutations of mutations.py
"""
import os
import re
import shutil
import subprocess
import sys
import time

from mutations import MUTATIONS

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COPY = os.path.join(ROOT, "build", "mutation")
MAX_SECONDS = 300  # Maximum time of a test.
# What says that an assertion failed, and what says that the bug is none: the program does not run.
ASSERTION = re.compile(r"\[   LINE   \] --- .*: error: |^\[  ERROR   \] --- ", re.M)
BROKEN = re.compile(r"does not compile|does not link|with exception|Sanitizer")


def copy_tree():
    """Bring the copy up to date. Built files are copied once, with their times."""
    os.makedirs(COPY, exist_ok=True)
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            stdout=subprocess.PIPE).stdout.decode().split("\0")
    for name in filter(None, listed):
        source, target = os.path.join(ROOT, name), os.path.join(COPY, name)
        if not os.path.isfile(source) or read(source) == read(target):
            continue
        os.makedirs(os.path.dirname(target), exist_ok=True)
        shutil.copy2(source, target)
    built, own = os.path.join(ROOT, "build", "release"), os.path.join(COPY, "build", "release")
    if os.path.isdir(built) and not os.path.isdir(own):
        os.makedirs(os.path.dirname(own), exist_ok=True)
        subprocess.run(["cp", "-a", built, own], check=True)


def read(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError:
        return None


def write(path, text):
    with open(path, "w") as file:
        file.write(text)


def build(tests):
    targets = ["build/release/tests/%s_test" % test for test in tests]
    return subprocess.run(["make", "SETUP=0", "-j%d" % (os.cpu_count() or 1)] + targets, cwd=COPY,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def run(test):
    """Return "passes", "fails" by an assertion, or why neither is so."""
    environment = dict(os.environ, HAIR_TEST="required")
    try:
        done = subprocess.run(["build/release/tests/%s_test" % test], cwd=COPY, env=environment,
                              timeout=MAX_SECONDS, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    except subprocess.TimeoutExpired:
        return "runs for more than %d s" % MAX_SECONDS
    said = done.stdout.decode(errors="replace")
    if done.returncode == 0:
        return "passes"
    if done.returncode < 0:
        return "ends by signal %d" % -done.returncode
    if BROKEN.search(said):
        return "does not run: " + BROKEN.search(said).group(0)
    return "fails" if ASSERTION.search(said) else "ends without an assertion"


def try_mutation(mutation):
    """Return (True, "caught by ...") or (False, the reason)."""
    path = os.path.join(COPY, mutation["file"])
    text = read(path).decode() if read(path) is not None else ""
    if text.count(mutation["old"]) != 1:
        return False, "the old text occurs %d times" % text.count(mutation["old"])
    write(path, text.replace(mutation["old"], mutation["new"]))
    try:
        built = build(mutation["tests"])
        if built.returncode:
            return False, "does not build: " + built.stdout.decode(errors="replace").strip().split("\n")[-1]
        results = {test: run(test) for test in mutation["tests"]}
    finally:
        write(path, text)
    for test, result in results.items():
        if result != "fails":
            return False, "%s %s" % (test, result)
    return True, ", ".join(results)


def check_sound(mutations):
    """Check that all named tests pass without a mutation."""
    tests = sorted({test for mutation in mutations for test in mutation["tests"]})
    built = build(tests)
    if built.returncode:
        sys.exit("the tests do not build:\n" + built.stdout.decode(errors="replace"))
    bad = [(test, result) for test in tests for result in [run(test)] if result != "passes"]
    for test, result in bad:
        print("without a mutation, %s %s" % (test, result))
    return not bad


def main():
    names = sys.argv[1:]
    chosen = [mutation for mutation in MUTATIONS if not names or mutation["name"] in names]
    unknown = set(names) - {mutation["name"] for mutation in MUTATIONS}
    if unknown or len({mutation["name"] for mutation in MUTATIONS}) != len(MUTATIONS):
        sys.exit("unknown or double names: " + ", ".join(sorted(unknown)))
    copy_tree()
    is_good = check_sound(chosen)
    for mutation in chosen:
        start = time.time()
        is_caught, why = try_mutation(mutation)
        is_good &= is_caught
        print("%-28s %-10s %s (%d s)" % (mutation["name"], "caught" if is_caught else "NOT CAUGHT", why,
                                         time.time() - start), flush=True)
    sys.exit(0 if is_good else 1)


if __name__ == "__main__":
    main()
