# variants.awk - Write each shader of the list of programs.awk with its defines to a file in `folder`,
# and print the names of the files. One process compiles many files, much faster than one process each.
{
    shader = $NF
    sub(/.*\//, "", shader)
    name = sprintf("%04d_%s", NR, shader)
    file = folder "/" name
    defines = ""
    for (i = 1; i < NF; i++) {
        define = substr($i, 3) # Without -D.
        sub(/=/, " ", define)
        defines = defines "#define " define "\n"
    }
    number = 0
    while ((getline line <$NF) > 0) {
        number++
        print line >file
        if (line ~ /^#version /) printf "%s#line %d \"%s\"\n", defines, number + 1, $NF >file
    }
    close($NF)
    close(file)
    if (!number) exit 1
    print name
}
