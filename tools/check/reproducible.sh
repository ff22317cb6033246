# reproducible.sh - build libraries and tools twice, and check that the builds are equal byte for byte.
#
#   reproducible.sh OUT MAKE-ARGUMENT...
#
# The builds differ in folder, umask, locale, time zone, times of files, user's name and number of jobs.
set -eu
out=$1
shift
unset MAKEFLAGS MFLAGS
rm -rf "$out"
one="$out/a" two="$out/folder/of/another/length/b"
for folder in "$one" "$two"; do
    mkdir -p "$folder"
    git ls-files | grep -v '^\.readme/' | tar -cf - -T - | tar -xf - -C "$folder"
done
find "$two" -type f -exec touch -d '2001-02-03 04:05:06' {} +
(umask 022; cd "$one" && TZ=UTC LC_ALL=C USER=one make SETUP=0 -j2 "$@" >build.log 2>&1) || { cat "$one/build.log"; exit 1; }
(umask 077; cd "$two" && TZ=Asia/Kolkata LC_ALL=C.UTF-8 LANGUAGE=de USER=two make SETUP=0 -j1 "$@" >build.log 2>&1) || { cat "$two/build.log"; exit 1; }
bad=0 count=0
for file in "$one"/build/release/*.a "$one"/build/release/*.so.*.* "$one"/build/release/hair-*; do
    name=$(basename "$file")
    cmp "$file" "$two/build/release/$name" || bad=1
    count=$((count + 1))
done
[ $bad = 0 ] && echo "$count files are equal" && rm -rf "$out"
exit $bad
