# Print the circles among the files of each folder of lib/: files that reach each other through calls
# or data. Fail if there is one.
#
#   nm -A build/release/lib/*/*.c.o | awk -f tools/circles.awk
#
# A line of the input is "build/release/lib/ROOM/FILE.c.o:ADDRESS TYPE SYMBOL", without the address
# for an undefined symbol.
{
    colon = index($0, ":")
    file = substr($0, 1, colon - 1)
    sub(/^.*lib\//, "", file)
    sub(/\.o$/, "", file)
    n = split(substr($0, colon + 1), word, " ")
    if (word[n - 1] == "U") uses[file, ++used[file]] = word[n]
    else if (word[n - 1] ~ /^[TDBRC]$/) owner[word[n]] = file
    if (!seen[file]++) files[++count] = file
}

function room(file) { return substr(file, 1, index(file, "/") - 1) }

END {
    for (f in used)
        for (i = 1; i <= used[f]; i++) {
            symbol = uses[f, i]
            if (!(symbol in owner)) continue
            g = owner[symbol]
            if (g == f || room(g) != room(f)) continue
            reach[f, g] = 1
            names[f, g] = names[f, g] " " symbol
        }
    # Warshall's transitive closure.
    for (k = 1; k <= count; k++)
        for (i = 1; i <= count; i++) {
            if (!((files[i], files[k]) in reach)) continue
            for (j = 1; j <= count; j++)
                if ((files[k], files[j]) in reach) reach[files[i], files[j]] = 1
        }
    for (i = 1; i <= count; i++) {
        f = files[i]
        if (f in told || !((f, f) in reach)) continue
        bad = 1
        size = 0
        for (j = 1; j <= count; j++)
            if ((f, files[j]) in reach && (files[j], f) in reach) {
                circle[++size] = files[j]
                told[files[j]] = 1
            }
        print "lib/" room(f) " has a circle of " size " files:"
        for (j = 1; j <= size; j++)
            for (k = 1; k <= size; k++)
                if ((circle[j], circle[k]) in names)
                    print "  " circle[j] " -> " circle[k] ":" names[circle[j], circle[k]]
    }
    exit bad
}
