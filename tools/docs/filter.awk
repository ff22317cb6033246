# filter.awk - Rewrite the headers and the guide of include/hair for doxygen, line by line.
FNR == 1 { is_header = FILENAME ~ /\.h$/ }

# Headers. The first line, "/// hair.h - text.", describes the file.
is_header && FNR == 1 && match($0, / - ./) {
    $0 = "/// @file " substr($0, 5, RSTART - 5) " @brief " toupper(substr($0, RSTART + 3, 1)) substr($0, RSTART + 4)
}
is_header { sub(/^\/\/\/ Errors:/, "/// @errors"); sub(/^\/\/\/ OpenGL:/, "/// @opengl") }
# A # begins a link, and a number at the start of a line begins a list. Neither is meant.
is_header { gsub(/#version/, "\\#version") }
is_header && match($0, /^ *\/\/\/ [0-9]+\./) { $0 = substr($0, 1, RLENGTH - 1) "\\" substr($0, RLENGTH) }
# Lines of terms, which are indented by two columns, become a list.
is_header && match($0, /^\/\/\/   [a-z][a-z, ]*  +/) {
    term = substr($0, 7, RLENGTH - 6)
    sub(/ +$/, "", term)
    $0 = "/// - **" term "**: " substr($0, RLENGTH + 1)
}
is_header && /^    hair_struct_header header;$/ { $0 = $0 " ///< Written by the default function." }
# HAIR_DESC declares two functions.
is_header && match($0, /^HAIR_DESC\([a-z_]+\)/) {
    type = substr($0, 11, RLENGTH - 11)
    $0 = "/** Write the defaults of " type " into `desc`. " type "_default() calls it. */ " \
         "void " type "_init(" type "* desc, hair_struct_header header); " \
         "/** Return a " type " with all defaults. */ " type " " type "_default(void);"
}

# The guide. Headings get the anchors that GitHub gives them. Names of headers become links by
# themselves. Files outside have no page here.
!is_header && /^```/ { is_code = !is_code }
!is_header && !is_code && /^## / {
    anchor = tolower(substr($0, 4))
    gsub(/[^a-z0-9 ]/, "", anchor)
    gsub(/ /, "-", anchor)
    $0 = $0 " {#" anchor "}"
}
!is_header && !is_code {
    while (match($0, /\[[^]]+\]\(([a-z_]+\.h|\.\.\/[^)]*)\)/)) {
        text = substr($0, RSTART + 1, index(substr($0, RSTART), "]") - 2)
        gsub(/`/, "", text)
        $0 = substr($0, 1, RSTART - 1) text substr($0, RSTART + RLENGTH)
    }
}
{ print }
