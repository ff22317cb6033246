# Print functions of more than 60 lines from the name to the closing brace. Fail if there is one.
#
#   awk -f tools/check/functions.awk FILES
#
# clang-format puts both braces of a function, and only those, into column 1.
FNR == 1 { name = "" }
/^[A-Za-z_].*\(/ {
    start = FNR
    name = $0
    sub(/\(.*/, "", name)
    sub(/.*[ *&]/, "", name)
}
/^}/ {
    if (name != "" && FNR - start + 1 > 60) {
        print FILENAME ":" start ": " name "() has " FNR - start + 1 " lines, more than 60"
        bad = 1
    }
    name = ""
}
END { exit bad }
