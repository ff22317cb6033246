# Print comments that begin with a subordinate clause, and comment lines of more than 100 columns.
# Fail if there is one.
#
#   LC_ALL=C awk -f tools/check/comments.awk FILES
#
# A comment begins after `//`, except in a line that continues the comment of the line above.
function report(why)
{
    print FILENAME ":" FNR ": " why
    bad = 1
}

FNR == 1 { continues = 0 }
{
    code = $0
    gsub(/\\./, "", code)
    gsub(/"[^"]*"/, "\"\"", code)
    if (!match(code, /\/\/[\/!]*<? */)) {
        continues = 0
        next
    }
    text = substr(code, RSTART + RLENGTH)
    columns = $0
    gsub(/[\200-\277]/, "", columns) # UTF-8 continues a character by these bytes.
    if (length(columns) > 100) report("the comment ends at column " length(columns) ", beyond 100")
    alone = code ~ /^[ \t]*\/\//
    if (!(alone && continues) && match(text, /^(The same|[A-Z][a-z]*)([ ,.:]|$)/)) {
        word = substr(text, 1, RLENGTH)
        sub(/[ ,.:]$/, "", word)
        if (word in clause) report("the comment begins with \"" word "\", not with a verb or a noun")
    }
    continues = alone
}

BEGIN {
    n = split("Of What Whatever Where Wherever Which Whichever Who Whoever Whose Whom That Those Such As" \
              " So Whether How Than Likewise Else And But Or", words, " ")
    for (i = 1; i <= n; i++) clause[words[i]] = 1
    clause["The same"] = 1
}
END { exit bad }
