#!/bin/sh
# deb.sh OUT VERSION - make Debian packages of the tree OUT/hair/tree, into OUT. lintian must accept them.
set -eu
out=$1
version=$2
here=$(dirname "$0")
debian=$out/hair/debian
maintainer=${MAINTAINER:-The developers of hair <hair@users.noreply.github.com>}
date=$(git log -1 --format=%cD 2>/dev/null || date -R -r "$here/../../LICENSE")
copyright=$(sed -n 's/^Copyright (c) //p' LICENSE)
licence=$(sed '1,/^Copyright/d; s/^$/./; s/^/ /' LICENSE | sed '1{/^ \.$/d}')

for tool in dpkg-buildpackage dh lintian; do
    command -v "$tool" >/dev/null || { echo "make deb needs the packages dpkg-dev, debhelper and lintian." >&2; exit 1; }
done
cp "$here"/debian/* "$debian"
chmod 755 "$debian/rules"
rm -f "$out/hair/tree/usr/share/doc/libhair-dev/LICENSE"
sed -i "s|@MAINTAINER@|$maintainer|" "$debian/control"
{
    sed -n "s|@COPYRIGHT@|$copyright|; /@LICENSE@/!p" "$here/debian/copyright"
    echo "$licence"
} >"$debian/copyright"
cat >"$debian/changelog" <<END
hair ($version-1) unstable; urgency=medium

  * Version $version. CHANGELOG.md of libhair-dev lists the changes.

 -- $maintainer  $date
END
(cd "$out/hair" && dpkg-buildpackage -b -us -uc -d -nc >"../build.log" 2>&1) || { cat "$out/build.log" >&2; exit 1; }
lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "$out"/*.changes
echo "  $(cd "$out" && echo ./*.deb)"
