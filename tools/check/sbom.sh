# sbom.sh - print the software bill of materials of libraries and tools, as SPDX 2.3 in JSON.
#
#   sbom.sh VERSION DATE FILE...
#
# Names and versions come from the loader and from dpkg, licences from licences.txt. DATE is that of
# the last commit, so that equal builds have equal bills.
set -eu
here=$(dirname "$0") version=$1 date=$2
shift 2
rows=$(mktemp)
trap 'rm -f "$rows"' EXIT

# Print the fields of a package: name, version, maintainer, home page.
package_of() { dpkg-query -W -f '${Package}\t${Version}\t${Maintainer}\t${Homepage}\n' "$1" | head -n 1; }
licence_of() { awk -v name="$1" '!/^#/ && $1 == name { sub(/^[^ ]+ +/, ""); sub(/ +(dynamic|static).*/, ""); print }' "$here/licences.txt"; }

for file; do
    name=$(basename "$(readlink -f "$file")")
    printf 'file\t%s\t%s\n' "$name" "$(sha256sum <"$file" | cut -d' ' -f1)"
    for library in $(readelf -dW "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
        case $library in libhair*)
            printf 'link\t%s\t%s\n' "$name" "${library%.so*}"
            continue ;;
        esac
        licence=$(licence_of "${library%%.so*}")
        [ "$licence" ] || { echo "$file: $library is not in $here/licences.txt" >&2; exit 1; }
        path=$(ldd "$file" | awk -v name="$library" '$1 == name { print $3 }')
        real=$(readlink -f "$path")
        package=$({ dpkg -S "$path" || dpkg -S "$real" || dpkg -S "${real#/usr}"; } 2>/dev/null | head -n 1 | cut -d: -f1)
        [ "$package" ] || { echo "$file: no package has $path" >&2; exit 1; }
        printf 'uses\t%s\tDYNAMIC_LINK\t%s\t%s\n' "$name" "$licence" "$(package_of "$package")"
    done
    awk -v file="$(basename "$file")" '!/^#/ { for (i = 1; i <= NF; i++) if ($i == "static") { for (k = i + 1; k <= NF; k++) if ($k == file) print $1 } }' \
        "$here/licences.txt" | while read -r package; do
        printf 'uses\t%s\tSTATIC_LINK\t%s\t%s\n' "$name" "$(licence_of "$package")" "$(package_of "$package")"
    done
done >"$rows"

awk -F '\t' -v version="$version" -v date="$date" '
function id(text) { gsub(/[^A-Za-z0-9.-]/, "-", text); return "SPDXRef-" text }
function quote(text) { gsub(/["\\]/, "\\\\&", text); return "\"" text "\"" }
function package(name, of, licence, supplier, home) {
    list = list (list ? ",\n" : "") "    {\"SPDXID\": " quote(id(name)) ", \"name\": " quote(name) ", \"versionInfo\": " quote(of) \
        ", \"supplier\": " quote(supplier) ", \"downloadLocation\": " quote(home ? home : "NOASSERTION") \
        ", \"filesAnalyzed\": false, \"licenseConcluded\": " quote(licence) ", \"licenseDeclared\": " quote(licence) \
        ", \"copyrightText\": \"NOASSERTION\"}"
}
function relate(a, how, b) {
    relations = relations (relations ? ",\n" : "") "    {\"spdxElementId\": " quote(a) ", \"relationshipType\": " quote(how) \
        ", \"relatedSpdxElement\": " quote(b) "}"
}
BEGIN { package("hair", version, "MIT", "Organization: The hair authors", ""); relate("SPDXRef-DOCUMENT", "DESCRIBES", id("hair")) }
$1 == "file" {
    files = files (files ? ",\n" : "") "    {\"SPDXID\": " quote(id($2)) ", \"fileName\": " quote("./" $2) \
        ", \"checksums\": [{\"algorithm\": \"SHA256\", \"checksumValue\": " quote($3) "}], \"licenseConcluded\": \"MIT\", \"copyrightText\": \"NOASSERTION\"}"
    relate(id("hair"), "CONTAINS", id($2)); all = all $3
}
$1 == "link" { relate(id($2), "DYNAMIC_LINK", id($3 ".so." version)) }
$1 == "uses" {
    if (!known[$5]++) { supplier = $7; gsub(/[<]/, "(", supplier); gsub(/[>]/, ")", supplier); package($5, $6, $4, "Organization: " supplier, $8) }
    if (!related[$2 $3 $5]++) relate(id($2), $3, id($5))
}
END {
    printf "{\n  \"spdxVersion\": \"SPDX-2.3\",\n  \"dataLicense\": \"CC0-1.0\",\n  \"SPDXID\": \"SPDXRef-DOCUMENT\",\n"
    printf "  \"name\": \"hair-%s\",\n  \"documentNamespace\": \"https://spdx.org/spdxdocs/hair-%s-%s\",\n", version, version, substr(all, 1, 16)
    printf "  \"creationInfo\": {\"created\": %s, \"creators\": [\"Tool: sbom.sh\"]},\n", quote(date)
    printf "  \"packages\": [\n%s\n  ],\n  \"files\": [\n%s\n  ],\n  \"relationships\": [\n%s\n  ]\n}\n", list, files, relations
}' "$rows"
