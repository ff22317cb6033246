#!/bin/sh
# run.sh BUILD FOLDER KIND... - run the commands of the tutorial in blocks of these kinds: "sh",
# "convert" and "blender". Tools come from BUILD, and files go to FOLDER. Pictures are small and
# films are short, because only the commands are tested.
set -eu
cd "$(dirname "$0")/../../.."
build=$1 folder=$2
shift 2
awk -v kinds=" $* " '
    /^```/ { kind = NF > 1 ? $2 : "sh"; on = !on && /^```sh/ && index(kinds, " " kind " "); next }
    on' tools/convert/tutorial/README.md |
    sed -e "s|build/tutorial|$folder|g" -e "s|build/release|$build|g" -e 's/--frames 0:24/--frames 0:4/' \
        -e 's/--size [0-9x]*/--size 64x64 --followers 500 --samples 1 --supersample 1/' >"$folder/commands.sh"
[ -s "$folder/commands.sh" ] || { echo "the tutorial has no commands of these kinds"; exit 1; }
sh -eu "$folder/commands.sh"
