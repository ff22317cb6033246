# Print loops of shaders without a known bound, and bounds without a loop. Fail if there is one.
#
#   awk -f tools/check/loops.awk tools/check/loops.txt SHADERS
#
# A loop is counted if its header compares the variable that it steps with a limit. Limits and steps
# may have numbers, names in capital letters, members of uniform blocks, and names of loops.txt. Every
# other loop must be in loops.txt with its whole header.
function find_bound(what) {
    if ((name " " what) in bound) used[name " " what] = 1
    else if (("* " what) in bound) used["* " what] = 1
    else return 0
    return 1
}
function is_limit(limit, n, i, word) {
    gsub(/^ +| +$/, "", limit)
    if (find_bound(limit)) return 1
    gsub(/(u?int|float|min|max)\(/, " ", limit)
    gsub(/(draw|hide|lines|params|raster|wind)\.[a-z_]+/, " ", limit)
    gsub(/[^A-Za-z0-9_.]/, " ", limit)
    n = split(limit, word, " ")
    for (i = 1; i <= n; i++)
        if (word[i] !~ /^([0-9.]|[A-Z][A-Z0-9_]*$)/ && !find_bound(word[i])) return 0
    return 1
}
# Return whether a loop steps a variable up to a limit, or down to one.
function is_counted(header, part, side, n, i, counter, found, by) {
    if (header !~ /^for \(/ || split(substr(header, 6, length(header) - 6), part, ";") != 3) return 0
    n = split(part[2], side, "&&")
    for (i = 1; i <= n; i++) {
        if (!match(side[i], /^ *[a-z_]+(--| \+ [0-9]+u)? (<|<=|>|>=) /)) continue
        found = RLENGTH
        counter = side[i]
        sub(/^ */, "", counter)
        sub(/[^a-z_].*/, "", counter)
        if (side[i] !~ /--/ && part[3] !~ ("(^|[^a-z_])\\+\\+" counter)) {
            if (!match(part[3], "(^|[^a-z_])" counter " [^ ]= [^,]*")) continue
            by = substr(part[3], RSTART, RLENGTH)
            sub(/.*= /, "", by)
            if (!is_limit(by)) continue
        }
        if (is_limit(substr(side[i], found + 1))) return 1
    }
    return 0
}
# Cut off the text behind the closing parenthesis. Return an empty text while it is not there.
function cut_header(text, depth, i, letter) {
    for (i = 1; i <= length(text); i++) {
        letter = substr(text, i, 1)
        if (letter == "(") depth++
        if (letter == ")" && --depth == 0) return substr(text, 1, i)
        if (letter == "{" && depth == 0) return substr(text, 1, i)
    }
    return ""
}
FILENAME ~ /loops\.txt$/ {
    at = index($0, " : ")
    if (at && !/^#/) bound[substr($0, 1, at - 1)] = FNR
    next
}
{
    sub(/\/\/.*/, "")
    rest = header == "" ? $0 : header " " $0
    header = ""
    while (match(rest, /(^|[^A-Za-z_])(for|while|do) *[({]/)) {
        rest = substr(rest, RSTART)
        sub(/^[^a-z]/, "", rest)
        text = cut_header(rest)
        if (text == "") { header = rest; break }
        rest = substr(rest, length(text) + 1)
        gsub(/ +/, " ", text)
        name = FILENAME
        sub(/^glsl\//, "", name)
        if (!is_counted(text) && !find_bound(text)) {
            print FILENAME ":" FNR ": this loop has no known bound: " text
            bad = 1
        }
    }
}
END {
    for (what in bound)
        if (!(what in used)) {
            print "tools/check/loops.txt:" bound[what] ": no loop needs this bound"
            bad = 1
        }
    exit bad
}
