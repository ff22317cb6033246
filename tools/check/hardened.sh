# hardened.sh - check that libraries and programs resist an attack on their memory, and that a build
# in another folder would be equal.
#
#   hardened.sh FILE...
bad=0
fail() { echo "$1"; bad=1; }
for file; do
    segments=$(readelf -lW "$file") dynamic=$(readelf -dW "$file") names=$(nm -D "$file")
    echo "$segments" | grep -q GNU_RELRO || fail "$file: no GNU_RELRO"
    echo "$dynamic" | grep -qE 'BIND_NOW|Flags:.* NOW' || fail "$file: symbols are bound late, not at the start"
    ! echo "$segments" | grep -q ' RWE ' || fail "$file: a segment is writable and executable"
    echo "$names" | grep -q __stack_chk_fail || fail "$file: no stack protector"
    readelf -hW "$file" | grep -q 'Type:.*DYN' || fail "$file: a fixed address"
    ! grep -qF "$PWD" "$file" || fail "$file: names the folder it was built in"
done
readelf -sW "$1" | grep -q '__[a-z]*_chk' || fail "$1: no _FORTIFY_SOURCE"
exit $bad
