# Print arrays of scalars in structs that C and GLSL share. Fail if there is one. std140 gives the
# elements of such an array a stride of 16 bytes, C a stride of 4.
#
#   awk -f tools/check/arrays.awk glsl/shared/*.h
{
    code = $0
    sub(/\/\/.*/, "", code)
    # An array of structs is allowed, because HAIR_SIZE keeps their size a multiple of 16.
    if (code ~ /^[ \t]+(hair_uint|uint|int|float|bool|hair_vec2|vec2|hair_vec3|vec3)[ \t][^(;]*\[/) {
        print FILENAME ":" FNR ": an array of scalars has a stride of 16 bytes in GLSL; use hair_vec4"
        bad = 1
    }
}
END { exit bad }
