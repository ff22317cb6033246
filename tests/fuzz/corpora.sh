#!/bin/sh
# Replay the public corpora of corpora.txt: sh tests/fuzz/corpora.sh BUILD [FOLDER]
# Corpora are fetched by git into build/corpora. With FOLDER, they are read from FOLDER/NAME instead.
# Each file also runs with flipped bits and, if it is small, cut off. No input may make a parser fail. In
# JSONTestSuite, files of JSON (y_) must be read as JSON by hair-capture, and others (n_) be refused.
build=$1 clones=$2 folder=build/corpora
sources=${clones:-$folder/git}
rm -rf $folder/inputs $folder/others && mkdir -p $folder/inputs $folder/git || exit 1
fail() { echo "corpora: $*" >&2; exit 1; }

# Fetch folder $5 at commit $3 of repository $4.
fetch() {
    [ ! "$clones" ] || return 0
    [ -d $folder/git/$2 ] || { git init -q $folder/git/$2 && git -C $folder/git/$2 remote add origin $4; } || return 1
    git -C $folder/git/$2 cat-file -e $3 2>/dev/null ||
        git -C $folder/git/$2 fetch -q --depth 1 --filter=blob:none origin $3 || return 1
    git -C $folder/git/$2 checkout -q $3 -- $5
}

grep -v '^#' tests/fuzz/corpora.txt >$folder/list || exit 1
while read -r parser name commit licence repository under ending; do
    fetch $parser $name $commit $repository $under || fail "cannot fetch $name"
    mkdir -p $folder/inputs/$parser
    [ -d "$sources"/$name/$under ] || fail "there is no $sources/$name/$under"
    find "$sources"/$name/$under -type f -name "*$ending" | while read -r file; do
        to=$folder/inputs/$parser/$name-$(basename "$file")
        # The first byte chooses the struct.
        if [ $parser = members ]; then { printf '\001'; cat "$file"; } >"$to"; else cp "$file" "$to"; fi
    done
done <$folder/list
for parser in $(ls $folder/inputs); do
    $build/tests/fuzz/replay $folder/inputs $parser || fail "$parser fails"
done

# The library's own reader accepts none of the files that are not JSON.
mkdir -p $folder/others/members && cp $folder/inputs/members/JSONTestSuite-n_* $folder/others/members || exit 1
$build/tests/fuzz/replay $folder/others members | grep -q ' 0 whole accepted' || fail "hair_read_json() reads what is not JSON"

# Syntax of JSON ---------------------------------------------------------------------------------------------

# The syntax errors of scene files begin with the place in the text.
syntax='small.json: line [0-9]+, column [0-9]+: '
work=$folder/json
mkdir -p $work && : >$work/wrong
for file in "$sources"/JSONTestSuite/test_parsing/*.json; do
    name=$(basename "$file" .json)
    cp "$file" $work/small.json
    timeout 60 $build/hair-capture $work/small.json --frames 0:1 --size 16x16 --hash >$work/said 2>&1
    status=$? said=$(tr -d '\0' <$work/said)
    # Only an empty object is a scene.
    is_scene=0 && [ "$(tr -d ' \0' <"$file")" = "{}" ] && is_scene=1
    is_json=1 && echo "$said" | grep -qE "$syntax" && is_json=0
    case $name in
    # A scene has an object at its root, each key once, and no character 0.
    y_structure_lonely_* | y_structure_string_empty | y_string_space | y_object_duplicated_key* | *_null_*) wanted=0 ;;
    y_*) wanted=1 ;;
    n_*) wanted=0 ;;
    *) wanted=$is_json ;;
    esac
    [ $is_json = $wanted ] && [ $status = $((4 * (1 - is_scene))) ] || echo "$name: exit $status, $said" >>$work/wrong
done
[ ! -s $work/wrong ] || { cat $work/wrong; fail "JSONTestSuite is read otherwise"; }
echo "JSONTestSuite: $(ls "$sources"/JSONTestSuite/test_parsing | grep -c '^y_') files of JSON and" \
    "$(ls "$sources"/JSONTestSuite/test_parsing | grep -c '^n_') others are told apart."
