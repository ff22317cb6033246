# man.awk - turn the --help text of a tool into a manual page.
#   hair-groom --help | awk -v version=0.2.0 -f man.awk >hair-groom.1
function roff(text) {
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    sub(/^[.']/, "\\\\\\&&", text)
    return text
}
function section(name) {
    if (name != current) print ".SH " name
    current = name
}
# Print a term and its description. The description may go on in further lines.
function entry(term, text) {
    print ".TP"
    print "\\fB" roff(term) "\\fR"
    if (text != "") print roff(text)
}
NR == 1 {
    name = $1
    about = substr($0, length(name) + 4)
    title = toupper(name)
    printf ".TH \"%s\" 1 \"\" \"hair %s\" \"User Commands\"\n", roff(title), version
    section("NAME")
    print roff(name) " \\- " roff(about)
    next
}
/^$/ { next }
index($0, "  " name) == 1 {
    section("SYNOPSIS")
    term = substr($0, 3)
    text = ""
    if (match(term, /   +/)) {
        text = substr(term, RSTART + RLENGTH)
        term = substr(term, 1, RSTART - 1)
    }
    entry(term, text)
    next
}
/^Exit status: / {
    section("EXIT STATUS")
    print roff(substr($0, 14))
    next
}
match($0, /^  --[a-z-]+( [A-Z][^ ]*)?/) {
    section("OPTIONS")
    text = substr($0, RLENGTH + 1)
    sub(/^ +/, "", text)
    entry(substr($0, 3, RLENGTH - 2), text)
    next
}
/^          / {
    sub(/^ +/, "")
    print roff($0)
    next
}
/^  / {
    term = substr($0, 3)
    text = ""
    if (match(term, /  +/)) {
        text = substr(term, RSTART + RLENGTH)
        term = substr(term, 1, RSTART - 1)
        # A table of settings has their defaults in its second column.
        if (settings && match(text, /^[^ ]+ +/)) {
            value = substr(text, 1, RLENGTH)
            sub(/ +$/, "", value)
            term = term "=" value
            text = substr(text, RLENGTH + 1)
        }
    }
    if (current == "SYNOPSIS" || current == "NAME") section("DESCRIPTION")
    entry(term, text)
    next
}
{
    settings = /^Settings for/
    section(settings ? "SETTINGS" : current == "OPTIONS" || current == "NOTES" ? "NOTES" : "DESCRIPTION")
    print ".PP"
    print roff($0)
}
