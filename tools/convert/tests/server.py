"""A process that runs hair-convert for tests as a user does, in a child process per command.

The process starts before any package has threads, because a process with threads cannot be forked
safely. Packages are loaded once, which saves most of the time of a command.
"""

import json
import os
import socket

TIMEOUT = 120  # s of a command
CONNECTION = None


def start():
    """Start the process."""
    global CONNECTION
    CONNECTION, theirs = socket.socketpair()
    if os.fork() == 0:
        CONNECTION.close()
        _serve(theirs)
        os._exit(0)
    theirs.close()
    CONNECTION.settimeout(TIMEOUT)


def run(arguments, errors):
    """Run hair-convert with its stderr in the file `errors`. Return the exit status."""
    CONNECTION.sendall(json.dumps([arguments, errors]).encode() + b"\n")
    return int(CONNECTION.recv(64))


def _serve(connection):
    import alembic3d  # noqa: F401
    import imath  # noqa: F401
    from pxr import Usd, UsdGeom  # noqa: F401
    from hairconvert.cli import main
    null = os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    for line in connection.makefile("rb"):
        arguments, errors = json.loads(line)
        file = os.open(errors, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        os.dup2(file, 2)
        os.close(file)
        try:
            status = main(arguments)
        except SystemExit as end:
            status = end.code
        connection.sendall(str(status).encode())
