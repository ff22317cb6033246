"""Runs a conversion in a process of its own, so that a crash in a package becomes a sentence."""

import os
import resource
import signal
import sys
import traceback

from hairconvert.report import EXIT_INPUT, EXIT_RUNTIME, TOOL


def run_guarded(call, temporary=None):
    """Return the exit status of `call`, which runs in a child process.

    The child writes nothing of C++ packages to stderr. If it dies, the temporary file is removed.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        _run_child(call)
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
        signal.signal(number, lambda n, _: os.kill(child, n))
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status >= 0:
        return status
    if temporary and os.path.exists(temporary):
        os.remove(temporary)
    if -status in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
        print(f"{TOOL}: interrupted", file=sys.stderr)
        return EXIT_RUNTIME
    print(f"{TOOL}: the input made the reader of its format crash with signal {-status}",
          file=sys.stderr)
    return EXIT_INPUT


def _run_child(call):
    status = EXIT_RUNTIME
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        _silence_packages()
        _limit_memory()
        status = call()
    except BaseException:  # The child must not return into the code of the parent.
        traceback.print_exc()
    finally:
        try:
            sys.stdout.flush()
            sys.stderr.flush()
        except OSError:
            status = EXIT_RUNTIME
        os._exit(status)


def _silence_packages():
    """Keep sys.stderr, and discard what C++ code prints to file descriptor 2."""
    sys.stderr = os.fdopen(os.dup(2), "w", buffering=1, errors="backslashreplace")
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 2)
    os.close(null)


def _limit_memory():
    """Refuse allocations beyond the memory of the machine instead of swapping."""
    physical = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    limit = max(physical, 8 << 30)
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    if hard == resource.RLIM_INFINITY or hard > limit:
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
