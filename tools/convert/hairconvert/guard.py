"""Runs a conversion in a process of its own, so that a crash in a package becomes a sentence."""

import os
import signal
import sys
import traceback

from hairconvert.report import EXIT_INPUT, EXIT_RUNTIME, TOOL


BASE_MEMORY = 3 << 30  # bytes beyond those of the started program
MEMORY_PER_BYTE = 32  # bytes of memory for each byte of the input


def run_guarded(call, temporary=None, input_size=0):
    """Return the exit status of `call`, which runs in a child process with limited memory.

    The child writes nothing of C++ packages to stderr. If it dies, the temporary file is removed.
    """
    if not hasattr(os, "fork"):
        return call()
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        _run_child(call, input_size)
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


def _run_child(call, input_size):
    status = EXIT_RUNTIME
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        _silence_packages()
        _limit_memory(input_size)
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


def _limit_memory(input_size):
    """Refuse allocations beyond what a well-formed input of this size needs."""
    if not os.path.exists("/proc/self/statm"):
        return
    import resource
    page = os.sysconf("SC_PAGE_SIZE")
    with open("/proc/self/statm", encoding="ascii") as file:
        used = int(file.read().split()[0]) * page
    limit = used + BASE_MEMORY + MEMORY_PER_BYTE * input_size
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    if hard == resource.RLIM_INFINITY or hard > limit:
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
