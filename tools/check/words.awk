# Print identifiers with a word that has a standard name in graphics. Fail if there is one.
#
#   awk -f tools/check/words.awk FILES
BEGIN {
    use["share"] = "fraction"
    use["most"] = "max"
    use["least"] = "min"
    use["seat"] = "root_binding"
    use["spot"] = "scalp_point"
    use["plot"] = "bin"
    use["sprout"] = "candidate"
    use["knot"] = "pin"
    use["crowd"] = "hair_grid"
    use["ledger"] = "profiler"
    use["lent"] = "view_storage"
    use["tidy"] = "resource_lru"
    standard["HAIR_LIGHT_SPOT"] = 1 # Spotlight.
}
{
    code = $0
    gsub(/\\./, "", code)
    gsub(/"[^"]*"/, "", code)
    sub(/\/\/.*/, "", code)
    n = split(code, names, /[^A-Za-z0-9_]+/)
    for (i = 1; i <= n; i++) {
        parts = split(tolower(names[i]), word, "_")
        if (names[i] in standard) continue
        for (k = 1; k <= parts; k++)
            if (word[k] in use) {
                print FILENAME ":" FNR ": " names[i] " has \"" word[k] "\"; the standard word is \"" use[word[k]] "\""
                bad = 1
            }
    }
}
END { exit bad }
