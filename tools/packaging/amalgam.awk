# amalgam.awk - write all of libhair as one C file. Headers of the library are written once, where they
# are first included. A macro of a .c file ends with the file.
#   awk -v version=0.2.0 -f amalgam.awk lib/base/curve.c ... build/release/gen/sources.c >hair.c
# The script fails if two .c files define the same static name.
function fail(sentence) {
    print "amalgam: " sentence >"/dev/stderr"
    failed = 1
}
# Write a file of the library, with the files that the file includes.
function write_file(path, is_source,    line, got, quoted) {
    if (path !~ /\.inl$/) {
        if (path in written) return
        written[path]
    }
    while ((got = (getline line <path)) > 0) {
        if (line ~ /^#include "/) {
            split(line, quoted, "\"")
            # Files of glsl/ name each other from there.
            write_file((path ~ /^glsl\// ? "glsl/" : "") quoted[2], 0)
            continue
        }
        if (is_source) note(path, line)
        print line
    }
    if (got < 0) fail("cannot read " path)
    close(path)
}
# Remember what a line of a .c file defines.
function note(path, line,    name, word) {
    if (match(line, /^# *define [A-Za-z_0-9]+/)) {
        name = substr(line, RSTART, RLENGTH)
        sub(/.* /, "", name)
        macros[++macro_count] = name
    } else if (line ~ /^static / && match(line, /^[^=;(\[]*[A-Za-z_0-9]( *[=;(\[]|$)/)) {
        name = substr(line, RSTART, RLENGTH)
        sub(/ *[=;(\[]$/, "", name)
        sub(/.*[^A-Za-z_0-9]/, "", name)
        define(path, name)
    } else if (match(line, /^(struct|union|enum) [A-Za-z_0-9]+ \{/)) {
        split(line, word, " ")
        define(path, word[1] " " word[2])
    }
}
function define(path, name) {
    if ((name in definer) && definer[name] != path)
        fail(path " and " definer[name] " both define " name)
    definer[name] = path
}
BEGIN {
    print "// hair.c - libhair " version " in one file. Compile it as C17 with the folder of hair/ in the include path."
    print "// GCC without -mavx prints a note about vectors as arguments, which -Wno-psabi hides. All of them are inlined."
    # The C library of Windows has other formats of numbers.
    print "#if defined(_WIN32) && !defined(__USE_MINGW_ANSI_STDIO)\n#define __USE_MINGW_ANSI_STDIO 1\n#endif"
    for (i = 1; i < ARGC; i++) {
        print "\n// " ARGV[i] "\n"
        macro_count = 0
        write_file(ARGV[i], 1)
        for (m = 1; m <= macro_count; m++) print "#undef " macros[m]
    }
    exit failed
}
