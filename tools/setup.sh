#!/bin/sh
# setup.sh [LIST] - Print and install the missing Debian packages of LIST (default packages.txt).
set -eu
file=${1:-$(dirname "$0")/packages.txt}
list=$(sed 's/#.*//' "$file" | tr -s ' \n' ' ')

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "This is not a Debian system: install what corresponds to $file, then call make with SETUP=0." >&2
    exit 1
fi

missing=
for package in $list; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || { echo "These packages are missing and need root to install:$missing" >&2; exit 1; }
    as_root=sudo
fi
echo "Installing with apt-get:$missing"
$as_root env DEBIAN_FRONTEND=noninteractive sh -c "
    apt-get -q -o DPkg::Lock::Timeout=120 update &&
    apt-get -q -y -o DPkg::Lock::Timeout=120 install --no-install-recommends $missing" >/tmp/hair-setup.$$ 2>&1 ||
    { cat /tmp/hair-setup.$$ >&2; rm -f /tmp/hair-setup.$$; echo "apt-get failed (above)." >&2; exit 1; }
rm -f /tmp/hair-setup.$$
