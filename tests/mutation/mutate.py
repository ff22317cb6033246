#!/usr/bin/env python3
"""Seed one bug after the other, and check that the tests named beside it fail by an assertion.

Usage: tests/mutation/mutate.py [NAME]...    all bugs of mutations.py, or those of these names
       tests/mutation/mutate.py --check      check that the table fits the source; builds nothing
"""
import os
import queue
import re
import shutil
import subprocess
import sys
import threading
import time

from mutations import MUTATIONS

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
TREES = os.path.join(ROOT, "build", "mutation")  # Copies of the tree, one for each worker.
WORKERS = max(1, min(4, os.cpu_count() or 1))
MAX_SECONDS = 300  # Maximum time of a test.
# A line that says that an assertion failed.
ASSERTION = re.compile(r"\[ +LINE +\] --- .*: error: |^\[ +ERROR +\] --- |^ERROR: ", re.M)
# Signs that the program did not run as far as its assertions. Such a bug would be found without a test.
BROKEN = re.compile(r"does not compile|does not link|with exception|Sanitizer|cannot open shared object|SKIPPED")


def read(path):
    """Return the text of a file, or None."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return file.read()
    except (OSError, UnicodeDecodeError):
        return None


def write(path, text):
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(text)


def same_bytes(a, b):
    try:
        with open(a, "rb") as one, open(b, "rb") as other:
            return one.read() == other.read()
    except OSError:
        return False


def list_sources(tree):
    """Return all files of a tree outside of build/, relative to the tree."""
    found = set()
    for folder, folders, files in os.walk(tree):
        inside = os.path.relpath(folder, tree)
        folders[:] = [name for name in folders if name not in ("build", ".git", "__pycache__")]
        found.update(os.path.normpath(os.path.join(inside, name)) for name in files)
    return found


def make_tree(number, built):
    """Bring a copy of the tree up to date. A new copy takes over the files that `built` has built."""
    tree = os.path.join(TREES, str(number))
    is_new = not os.path.isdir(tree)
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, check=True,
                            stdout=subprocess.PIPE).stdout.decode().split("\0")
    sources = {name for name in listed if name and os.path.isfile(os.path.join(ROOT, name))}
    for name in list_sources(tree) - sources:
        os.remove(os.path.join(tree, name))
    for name in sources:
        source, target = os.path.join(ROOT, name), os.path.join(tree, name)
        if same_bytes(source, target):
            continue
        os.makedirs(os.path.dirname(target), exist_ok=True)
        # A changed file must be newer than what make has built of it here.
        (shutil.copy2 if is_new else shutil.copy)(source, target)
    if is_new and os.path.isdir(built):
        # Programs are large, and few of them are needed.
        shutil.copytree(built, os.path.join(tree, "build", "release"), symlinks=True,
                        ignore=shutil.ignore_patterns("*_test", "hair-*", "installed", "examples", "consumer"))
    return tree


def targets_of(mutation):
    """Return the files to build. Tests of tools run them."""
    return ["build/release/tests/%s_test" % test for test in mutation["tests"]] + \
           ["build/release/%s" % tool for tool in mutation.get("tools", [])]


def build(tree, targets, jobs):
    return subprocess.run(["make", "SETUP=0", "-j%d" % jobs] + targets, cwd=tree, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)


def run(tree, test):
    """Return "passes", "fails" if an assertion failed, or a sentence that says why neither is so."""
    environment = dict(os.environ, HAIR_TEST="required")
    try:
        done = subprocess.run(["build/release/tests/%s_test" % test], cwd=tree, env=environment,
                              timeout=MAX_SECONDS, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    except subprocess.TimeoutExpired:
        return "runs for more than %d s" % MAX_SECONDS
    said = done.stdout.decode(errors="replace")
    if done.returncode < 0:
        return "ends by signal %d" % -done.returncode
    if BROKEN.search(said):
        return "does not run: " + BROKEN.search(said).group(0)
    if done.returncode == 0:
        return "passes"
    return "fails" if ASSERTION.search(said) else "ends without an assertion"


def try_mutation(tree, mutation):
    """Return whether every named test fails by an assertion, and the reason."""
    path = os.path.join(tree, mutation["file"])
    text = read(path)
    write(path, text.replace(mutation["old"], mutation["new"]))
    try:
        built = build(tree, targets_of(mutation), 1)
        if built.returncode:
            return False, "does not build: " + built.stdout.decode(errors="replace").strip().split("\n")[-1]
        results = {test: run(tree, test) for test in mutation["tests"]}
    finally:
        write(path, text)
    for test, result in results.items():
        if result != "fails":
            return False, "%s %s" % (test, result)
    return True, ", ".join(results)


def check_table():
    """Return the faults of the table, as sentences."""
    faults, names = [], set()
    for mutation in MUTATIONS:
        name, text = mutation["name"], read(os.path.join(ROOT, mutation["file"]))
        count = text.count(mutation["old"]) if text is not None else 0
        if name in names:
            faults.append("%s: the name occurs twice" % name)
        if count != 1:
            faults.append("%s: the old text occurs %d times in %s" % (name, count, mutation["file"]))
        if mutation["old"] == mutation["new"]:
            faults.append("%s: the new text is the old one" % name)
        if not mutation["tests"]:
            faults.append("%s: names no test" % name)
        for test in mutation["tests"]:
            if not any(os.path.isfile(os.path.join(ROOT, "tests", test + "_test" + end)) for end in (".c", ".cpp")):
                faults.append("%s: there is no tests/%s_test" % (name, test))
        names.add(name)
    return faults


def prepare_trees(mutations, count):
    """Return trees in which all named tests are built, and pass without a mutation in the first one."""
    targets = sorted({target for mutation in mutations for target in targets_of(mutation)})
    tests = sorted({test for mutation in mutations for test in mutation["tests"]})
    trees, built = [], os.path.join(ROOT, "build", "release")
    for number in range(count):
        tree = make_tree(number, built)
        done = build(tree, targets, WORKERS)
        if done.returncode:
            sys.exit("the tests do not build:\n" + done.stdout.decode(errors="replace"))
        trees.append(tree)
        built = os.path.join(tree, "build", "release")
    bad = []
    run_all(trees, tests, lambda tree, test: bad.append((test, run(tree, test))))
    bad = [(test, result) for test, result in bad if result != "passes"]
    for test, result in bad:
        print("without a bug, %s %s" % (test, result))
    return trees, not bad


def run_all(trees, items, function):
    """Call function(tree, item) for all items, with one thread per tree."""
    work = queue.Queue()
    for item in items:
        work.put(item)

    def go(tree):
        while True:
            try:
                item = work.get_nowait()
            except queue.Empty:
                return
            function(tree, item)

    threads = [threading.Thread(target=go, args=(tree,)) for tree in trees]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def main():
    names = sys.argv[1:]
    faults = check_table()
    for fault in faults:
        print("tests/mutation/mutations.py: " + fault)
    if names == ["--check"] or faults:
        sys.exit(1 if faults else 0)
    unknown = set(names) - {mutation["name"] for mutation in MUTATIONS}
    if unknown:
        sys.exit("unknown names: " + ", ".join(sorted(unknown)))
    chosen = [mutation for mutation in MUTATIONS if not names or mutation["name"] in names]
    begin = time.time()
    trees, is_sound = prepare_trees(chosen, min(WORKERS, len(chosen)))
    caught = []

    def report(tree, mutation):
        start = time.time()
        is_caught, why = try_mutation(tree, mutation)
        caught.append(is_caught)
        print("%-32s %-10s %s (%d s)" % (mutation["name"], "caught" if is_caught else "NOT CAUGHT", why,
                                         time.time() - start), flush=True)

    run_all(trees, chosen, report)
    print("%d of %d caught, in %d s" % (sum(caught), len(chosen), time.time() - begin))
    sys.exit(0 if is_sound and len(caught) == len(chosen) and all(caught) else 1)


if __name__ == "__main__":
    main()
