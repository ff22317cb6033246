# programs.awk - List the shader programs that `make glsl` compiles, as options -D and a
# shader, one per line.
#
# The input is the preprocessed table of passes.inl, with '@"DEFINE" NAME' for each feature and
# '"features" "stages"' for each row. Not all combinations of a row's features are listed. The list
# has those with none, one, all, and all but one of the features, and any combination of collider
# features alone. Solvers are also compiled for one subgroup of 32 threads.

function exists(mixture) # return whether some scene needs the combination
{
    if (mixture ~ / (COLLIDER_GRID|BODIES) / && mixture !~ / COLLIDERS /) return 0
    if (mixture ~ / FEW_GUIDES / && (mixture !~ / COLLIDER_GRID / || mixture ~ / THREAD_PER_GUIDE /)) return 0
    # Pixels of a batch have colour alone.
    if (mixture ~ / BATCH / && mixture ~ / (DEPTH|ALPHA_COVERAGE|MOTION_OUTPUT) /) return 0
    return 1
}

function print_stage(flags, stage)
{
    if (stage ~ /\.comp$/) flags = flags " -DHAIR_STORED=1" # As lib/gl/program.c does.
    print "-DHAIR_GUIDE_THREADS=256" flags " glsl/" stage
    if (stage == "sim/rod.comp" || stage == "sim/mixed.comp")
        print "-DHAIR_SUBGROUP=1 -DHAIR_GUIDE_THREADS=32" flags " glsl/" stage
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
    while (match(features, /HAIR_GL_WITH\([A-Z0-9_]+\)/)) {
        all = all substr(features, RSTART + 13, RLENGTH - 14) " "
        features = substr(features, RSTART + RLENGTH)
    }
    # Features that replace colour output are not combined. MOTION does not with MOTION_OUTPUT.
    mixed = all
    gsub(/ (DEPTH|IDS)/, "", mixed)
    if (mixed !~ / MOTION_OUTPUT /) sub(/ MOTION /, " ", mixed)
    count = split(all, has, " ")
    print_program(" ", stages)
    print_program(mixed, stages)
    if (all ~ / COLLIDER_GRID /) print_program(" COLLIDERS COLLIDER_GRID ", stages)
    if (all ~ / FEW_GUIDES /) print_program(" COLLIDERS COLLIDER_GRID FEW_GUIDES ", stages)
    if (all ~ / FEW_GUIDES /) print_program(" COLLIDERS COLLIDER_GRID BODIES FEW_GUIDES ", stages)
    if (all ~ / DEPTH / && all ~ / ALPHA_COVERAGE /) print_program(" DEPTH ALPHA_COVERAGE ", stages) # opacity pass
    for (i = 1; i <= count; i++) {
        print_program(" " has[i] " ", stages)
        without = mixed
        if (sub(" " has[i] " ", " ", without)) print_program(without, stages)
    }
}
