#!/bin/sh
# windows_cmocka.sh OUT - compile the test framework cmocka by CC, from the source package of Debian, into
# OUT/cmocka.o and OUT/include.
set -eu
out=$1
rm -rf "$out" && mkdir -p "$out/lists/partial" "$out/include"
cd "$out"
echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" >sources.list
apt="-q -o Dir::Etc::SourceList=$out/sources.list -o Dir::Etc::SourceParts=/dev/null"
apt="$apt -o Dir::State::Lists=$out/lists -o Dir::Cache=$out/cache -o APT::Sandbox::User=root"
# shellcheck disable=SC2086
{ apt-get $apt update && apt-get $apt source cmocka; } >log 2>&1 || { cat log >&2; echo "apt-get finds no source of cmocka (above)." >&2; exit 1; }
cp cmocka-*/include/*.h include
"$CC" -w -O1 -Iinclude -DHAVE_STDINT_H -DHAVE_INTTYPES_H -DHAVE_STRING_H -DHAVE_TIME_H -DHAVE_SIGNAL_H \
    -c cmocka-*/src/cmocka.c -o cmocka.o
