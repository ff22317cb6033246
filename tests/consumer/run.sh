#!/bin/sh
# run.sh - build and run programs that use hair from an installed tree, through pkg-config and CMake, in C
# and in C++, with the static and the shared libraries. Check the manual pages and the completion of the
# tools. Check that the README shows the program that is run.
#   run.sh PREFIX OUT      The tree is installed in PREFIX/usr. Programs are written to OUT.
# CC and CXX name the compilers. AMALGAM is the folder of hair.c. OPT has the options that the libraries were built with, such as
# sanitizers.
set -eu
prefix=$1
out=$2
here=$(dirname "$0")
CC=${CC:-cc}
CXX=${CXX:-c++}
OPT=${OPT:-}
export PKG_CONFIG_PATH="$prefix/usr/lib/pkgconfig"
mkdir -p "$out"

fail() { echo "consumer: $*" >&2; exit 1; }

strict='-pedantic -Wall -Wextra -Wshadow -Wconversion -Werror'

# Check that FILE is a picture of 480 x 480 pixels with brown hair in it: red above green above blue.
# The hair covers 15 % of the picture. The colliders are pink and blue, the background is grey.
check_picture() {
    [ "$(head -n 3 "$1" | tr '\n' ' ')" = "P6 480 480 255 " ] || fail "$1 is no picture of 480 x 480 pixels"
    covered=$(od -An -v -tu1 -w3 -j15 "$1" | awk '
        {pixels++; color[$0]; if ($1 > $2 + 4 && $2 > $3 + 4) hair++}
        END {
            for (i in color) colors++
            printf "%.1f %% hair, %d colours", 100 * hair / pixels, colors
            exit !(pixels == 480 * 480 && hair > 0.10 * pixels && hair < 0.20 * pixels && colors > 2000)
        }') || fail "$1 does not show the head of hair"
}

# Run the program NAME of the folder $out in a folder of its own, and check its picture.
run_hello() {
    name=$1
    rm -rf "$out/$name.ran" && mkdir -p "$out/$name.ran"
    # Leaks of the driver are not the program's, so a sanitizer must not report them.
    output=$(cd "$out/$name.ran" &&
        ASAN_OPTIONS=detect_leaks=0 LD_LIBRARY_PATH="$prefix/usr/lib" "$out/$name") || fail "$name does not run"
    [ "$output" = "wrote hello.ppm" ] || fail "$name printed \"$output\""
    check_picture "$out/$name.ran/hello.ppm"
    echo "consumer: $name: $output: $covered"
}

# build NAME COMPILER LINKING-OPTIONS...
build() {
    name=$1
    compiler=$2
    shift 2
    # shellcheck disable=SC2086
    $compiler $strict $OPT "$here/hello.c" -x none "$@" -o "$out/$name" || fail "$name does not build"
}

# The .pc files find their tree relative to their own location.
# epoxy finds the OpenGL functions that hello.c calls itself.
epoxy="$(pkg-config --cflags --libs epoxy) -lm"
static="$(pkg-config --static --cflags --libs hair_egl) $epoxy"
shared="$(pkg-config --cflags --libs hair_egl) $epoxy"
case $shared in
*"-L$prefix/usr/lib"*) ;;
*) fail "pkg-config says \"$shared\"" ;;
esac
pkg-config --exists "hair >= 0.2" || fail "hair.pc has no version"
[ "$(pkg-config --modversion hair)" = "$(pkg-config --modversion hair_egl)" ] || fail "two versions are installed"

for standard in "$CC -std=c99 -x c" "$CXX -std=c++11 -x c++" "$CXX -std=c++17 -x c++" "$CXX -std=c++20 -x c++"; do
    language=$(echo "$standard" | sed 's/.*-std=\([^ ]*\).*/\1/')
    # Only hair is linked statically, because the system's EGL has no static library.
    static_hair=$(echo "$static" | sed 's/-lhair_egl/-l:libhair_egl.a/; s/-lhair\( \|$\)/-l:libhair.a\1/')
    # shellcheck disable=SC2086
    build "hello-$language-static" "$standard" $static_hair
    # shellcheck disable=SC2086
    build "hello-$language-shared" "$standard" -DHAIR_SHARED $shared
done
# Programs in other standards differ from these in nothing that runs. The two programs run at once, as
# later ones do.
run_hello hello-c99-static &
static_run=$!
run_hello hello-c++20-shared
wait $static_run

# Build a program with a Bullet world, if libhair_bullet was built.
if pkg-config --exists hair_bullet; then
    shared=$(pkg-config --cflags --libs hair_bullet bullet)
    static=$(echo "$(pkg-config --cflags --libs hair_bullet) $shared -lm" |
        sed 's/-lhair_bullet/-l:libhair_bullet.a/g; s/-lhair /-l:libhair.a /g')
    for linking in "$static" "-DHAIR_SHARED $shared"; do
        # shellcheck disable=SC2086
        $CXX -std=c++11 $OPT "$here/bullet.cpp" $linking -o "$out/bullet" || fail "bullet.cpp does not build"
        output=$(ASAN_OPTIONS=detect_leaks=0 LD_LIBRARY_PATH="$prefix/usr/lib" "$out/bullet") || fail "bullet.cpp does not run"
        [ "$output" = "1 collider, of shape 2" ] || fail "bullet.cpp printed \"$output\""
    done
    echo "consumer: bullet: $output"
fi

# Build the programs by CMake, in an empty folder and with the tree in another place. Both kinds of
# targets are built each time. BUILD_SHARED_LIBS or a component selects the kind of hair::egl.
cmake_programs() {
    kind=$1
    shift
    rm -rf "$out/cmake-$kind"
    cmake -S "$here" -B "$out/cmake-$kind" -DCMAKE_PREFIX_PATH="$out/moved/usr" -DCMAKE_C_COMPILER="$CC" \
        -DCMAKE_CXX_COMPILER="$CXX" -DCMAKE_C_FLAGS="$OPT" -DCMAKE_CXX_FLAGS="$OPT" "$@" >"$out/cmake.log" 2>&1 &&
        cmake --build "$out/cmake-$kind" >>"$out/cmake.log" 2>&1 || { cat "$out/cmake.log"; fail "cmake fails, see above"; }
    for name in hello hello_static hello_shared; do
        links=$(ldd "$out/cmake-$kind/$name")
        case $name-$kind-$links in
        hello_static-*libhair.so* | hello-static-*libhair.so*) fail "$name of cmake-$kind links libhair.so" ;;
        hello_static-* | hello-static-*) ;;
        *"$out/moved/usr/lib/libhair.so"*) ;;
        *) fail "$name of cmake-$kind does not link libhair.so of the tree: $links" ;;
        esac
    done
}
command -v cmake >/dev/null || fail "cmake is missing, which tests find_package(hair)"
rm -rf "$out/moved" && cp -a "$prefix" "$out/moved"
cmake_programs shared -DBUILD_SHARED_LIBS=OFF -DKIND=shared
cmake_programs static -DBUILD_SHARED_LIBS=OFF
run_hello cmake-shared/hello &
moved_run=$!
if [ -e "$out/moved/usr/lib/libhair_bullet.a" ]; then
    for name in shared/bullet shared/bullet_static static/bullet_shared static/bullet; do
        output=$(ASAN_OPTIONS=detect_leaks=0 "$out/cmake-$name") || fail "cmake-$name does not run"
        [ "$output" = "1 collider, of shape 2" ] || fail "cmake-$name printed \"$output\""
    done
fi

# Compile hair.c alone, by clang too where it is installed, and link a program with the object.
for compiler in "$CC" clang-14; do
    command -v "$compiler" >/dev/null || continue
    # shellcheck disable=SC2086
    $compiler -std=c17 -Wall -Wextra -Werror $OPT -O0 -I"$AMALGAM" -c "$AMALGAM/hair.c" -o "$out/hair-$compiler.o" ||
        fail "$compiler does not compile hair.c"
done
# shellcheck disable=SC2086
build hello-amalgam "$CC -std=c99 -x c" "$out/hair-$CC.o" -I"$prefix/usr/include" "$prefix/usr/lib/libhair_egl.a" \
    $(pkg-config --cflags --libs egl) $epoxy
run_hello hello-amalgam
wait $moved_run
echo "consumer: find_package(hair) works in a moved tree"

# Check that a manual page has every option of its tool, that the tool runs, and that bash completes it.
for tool in hair-capture hair-groom hair-bench; do
    help=$(LD_LIBRARY_PATH="$prefix/usr/lib" "$prefix/usr/bin/$tool" --help) || fail "$tool --help fails"
    page=$(sed 's/\\-/-/g' "$prefix/usr/share/man/man1/$tool.1") || fail "$tool has no manual page"
    for option in $(echo "$help" | grep -o '^  --[a-z-]*'); do
        printf "%s\n" "$page" | grep -q "^.fB$option[ \\]" || fail "the manual page of $tool lacks $option"
    done
    for title in NAME SYNOPSIS OPTIONS "EXIT STATUS"; do
        printf "%s\n" "$page" | grep -qx ".SH $title" || fail "the manual page of $tool has no section $title"
    done
done
complete_with() {
    PATH="$prefix/usr/bin:$PATH" bash -c 'source "$0"; COMP_CWORD=$1; compopt() { :; }
        _hair_complete "$2" "$3" "$4"; echo ${COMPREPLY[*]}' \
        "$prefix/usr/share/bash-completion/completions/hair-capture" "$@"
}
expect_completion() {
    expected=$1
    shift
    completed=$(complete_with "$@")
    [ "$completed" = "$expected" ] || fail "bash completes $* to \"$completed\", not \"$expected\""
}
expect_completion "--vertices --verbose --version" 1 hair-capture --ver hair-capture
expect_completion "--vertices --version" 2 hair-groom --ver bob.tfx
expect_completion "gravity.x= gravity.y= gravity.z=" 2 hair-capture gravity. --set
expect_completion "ponytail" 2 hair-capture pony --style
expect_completion "info" 1 hair-groom inf hair-groom
expect_completion "accuracy" 1 hair-bench acc hair-bench
echo "consumer: tools, manual pages and completion are installed"

# Check that a program with the static library does not export the library's symbols, even if it
# exports its own.
# shellcheck disable=SC2086
$CC -std=c99 $OPT -rdynamic "$here/hello.c" $static_hair -o "$out/hello-exporting"
if nm -D --defined-only "$out/hello-exporting" | grep ' hair_'; then fail "the static library exports these (above)"; fi

# Check that every header can be included alone.
for header in "$prefix"/usr/include/hair/*.h; do
    for compiler in "$CC -std=c99 -x c" "$CXX -std=c++11 -x c++"; do
        casts=
        case $compiler in *c++) casts='-Wold-style-cast -Wuseless-cast -Wzero-as-null-pointer-constant' ;; esac
        # shellcheck disable=SC2086
        echo "#include <hair/$(basename "$header")>" | $compiler $strict $casts -I"$prefix/usr/include" -fsyntax-only - ||
            fail "$(basename "$header") cannot be included alone"
    done
done

# Check that the first program of the README is hello.c.
readme=$here/../../README.md
if [ -e "$readme" ]; then
    awk '/^```c$/ {on = 1; next} /^```$/ {if (on) exit} on' "$readme" | diff -u "$here/hello.c" - >"$out/readme.diff" || {
        cat "$out/readme.diff"
        fail "README.md does not show tests/consumer/hello.c"
    }
fi
