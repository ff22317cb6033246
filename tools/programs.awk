# programs.awk - what `make glsl` compiles: options of glslc, one shader a line, for programs that rows of passes.inl can be compiled to.
# Reads what the preprocessor leaves of the table: '@"DEFINE" NAME' for each feature, '"features" "stages"' for each row. Of the
# mixtures of a row's features those with none, one, all and all but one of them, and any number of solids by themselves; solvers also as one subgroup of 32 threads.

function exists(mixture) # some scene needs it
{
    if (mixture ~ / (ANY|BODIES) / && mixture !~ / SOLIDS /) return 0
    if (mixture ~ / FEW / && (mixture !~ / ANY / || mixture ~ / THREAD /)) return 0
    return 1
}

function print_stage(flags, stage)
{
    print "-DHAIR_GUIDE_THREADS=256" flags " glsl/" stage
    if (stage == "sim/rod.comp" || stage == "sim/mixed.comp")
        print "--target-spv=spv1.3 -DHAIR_SUBGROUP=1 -DHAIR_GUIDE_THREADS=32" flags " glsl/" stage
}

function print_program(mixture, stages,    i, n, name, names, part, define, flags, there)
{
    if (!exists(mixture)) return
    n = split(mixture, names, " ")
    for (i = 1; i <= n; i++) {
        there[define_of[names[i]]] = 1
        flags = flags " -D" define_of[names[i]] "=1"
    }
    n = split(stages, part, " ")
    for (i = 1; i <= n; i++) {
        if (part[i] ~ /=/) {
            flags = flags " -D" part[i]
        } else if (split(part[i], name, "?") == 1) {
            print_stage(flags, part[i])
        } else {
            define = name[1]
            if (sub(/^!/, "", define) ? !(define in there) : (define in there)) print_stage(flags, name[2])
        }
    }
}

/^@/ {
    gsub(/[@"]/, "")
    define_of[$2] = $1
}

/^"/ {
    split($0, field, "\"")
    features = field[2]
    stages = ""
    for (i = 4; i in field; i += 2) stages = stages field[i]
    all = " "
    while (match(features, /HAIR_GL_WITH\([A-Z]+\)/)) {
        all = all substr(features, RSTART + 13, RLENGTH - 14) " "
        features = substr(features, RSTART + RLENGTH)
    }
    # What stands for another thing than colour is not mixed.
    mixed = all
    gsub(/ (DEPTH|IDS|MOTION)/, "", mixed)
    count = split(all, has, " ")
    print_program(" ", stages)
    print_program(mixed, stages)
    if (all ~ / ANY /) print_program(" SOLIDS ANY ", stages)
    if (all ~ / FEW /) print_program(" SOLIDS ANY FEW ", stages)
    if (all ~ / FEW /) print_program(" SOLIDS ANY BODIES FEW ", stages)
    if (all ~ / DEPTH / && all ~ / SHARES /) print_program(" DEPTH SHARES ", stages) # opacity
    for (i = 1; i <= count; i++) {
        print_program(" " has[i] " ", stages)
        without = mixed
        if (sub(" " has[i] " ", " ", without)) print_program(without, stages)
    }
}
