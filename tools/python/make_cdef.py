"""Write the declarations of libhair's headers for cffi, by the C preprocessor.

    make_cdef.py INCLUDE OUT [COMPILER]
"""

import pathlib
import re
import subprocess
import sys
import tempfile

HEADERS = ("hair_base", "hair_members", "hair_asset", "hair", "hair_diagnostics", "hair_egl")
VALUE = "libhair_version_of_headers"


def preprocess(include, compiler):
    """Return the headers without macros. cffi knows the names of the standard headers itself."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("stdbool.h", "stddef.h", "stdint.h"):
            pathlib.Path(folder, name).write_text("", "utf-8")
        text = "".join(f"#include <hair/{name}.h>\n" for name in HEADERS) + f"{VALUE} HAIR_VERSION\n"
        command = [compiler, "-E", "-P", "-nostdinc", "-I", folder, "-I", include, "-x", "c", "-"]
        return subprocess.run(command, input=text, capture_output=True, check=True, text=True).stdout


def remove_inline_functions(text):
    """Remove functions with a body, which cffi does not take."""
    while (start := text.find("static inline ")) >= 0:
        end, depth = text.index("{", start), 0
        while True:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
            if depth == 0:
                break
        text = text[:start] + text[end:]
    return text


def main():
    """Write the file. The version of the headers becomes a constant."""
    include, out, compiler = (sys.argv[1:] + ["cc"])[:3]
    text = remove_inline_functions(preprocess(include, compiler))
    text, expression = re.split(rf"^{VALUE} ", text, flags=re.MULTILINE)
    major, minor, patch = re.fullmatch(r"\((\d+) \* 10000u \+ (\d+) \* 100u \+ (\d+)\)", expression.strip()).groups()
    version = int(major) * 10000 + int(minor) * 100 + int(patch)
    text += f"#define HAIR_VERSION {version}\n"
    pathlib.Path(out).write_text(text, "utf-8")


if __name__ == "__main__":
    main()
