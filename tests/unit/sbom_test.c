// sbom_test.c - the bill of materials is SPDX 2.3, and names all that libraries and tools link.
#include "tests/support/support.h"

#include <stdlib.h>
#include <string.h>

#include <hair/hair.h>

#include "tests/support/shell.h"

static int start(void** state)
{
    (void)state;
    return hair_test_shell_start(HAIR_BUILD_DIR "/hair-groom");
}

static const char* text(const json_t* object, const char* key)
{
    const char* value = json_string_value(json_object_get(object, key));
    if (!value) fail_msg("no text under %s", key);
    return value;
}

// Return whether the bill has an element of that name.
static bool has(const json_t* bill, const char* id)
{
    size_t i;
    json_t* element;
    json_array_foreach(json_object_get(bill, "packages"), i,
                       element) if (strcmp(text(element, "SPDXID"), id) == 0) return true;
    json_array_foreach(json_object_get(bill, "files"), i,
                       element) if (strcmp(text(element, "SPDXID"), id) == 0) return true;
    return strcmp(id, "SPDXRef-DOCUMENT") == 0;
}

static void check_packages(const json_t* bill)
{
    size_t i, licensed = 0;
    json_t* package;
    json_array_foreach(json_object_get(bill, "packages"), i, package)
    {
        assert_true(*text(package, "name") && *text(package, "versionInfo") && *text(package, "supplier"));
        assert_true(*text(package, "downloadLocation"));
        licensed += *text(package, "licenseDeclared") != 0;
    }
    assert_true(i >= 2 && licensed == i);
}

static void check_relationships(const json_t* bill)
{
    size_t i, describes = 0, links = 0;
    json_t* relationship;
    json_array_foreach(json_object_get(bill, "relationships"), i, relationship)
    {
        const char *from = text(relationship, "spdxElementId"),
                   *to = text(relationship, "relatedSpdxElement");
        const char* type = text(relationship, "relationshipType");
        if (!has(bill, from)) fail_msg("%s is no element", from);
        if (!has(bill, to)) fail_msg("%s is no element", to);
        describes += strcmp(type, "DESCRIBES") == 0;
        links += strcmp(type, "DYNAMIC_LINK") == 0;
    }
    assert_int_equal(describes, 1);
    assert_true(links >= 3);
}

// A machine without dpkg skips this test, because there it cannot know versions.
static void bill_of_libraries_and_tools_is_spdx(void** state)
{
    (void)state;
    if (system("command -v dpkg-query >/dev/null") != 0) return;
    hair_test_shell_expect(0,
                           "sh tools/check/sbom.sh 1.2.3 2026-01-01T00:00:00Z " HAIR_BUILD_DIR
                           "/libhair.so " HAIR_BUILD_DIR "/libhair_egl.so $T >$D/bill.json",
                           "");
    json_t* bill = hair_test_shell_json("bill.json");
    assert_string_equal(text(bill, "spdxVersion"), "SPDX-2.3");
    assert_string_equal(text(bill, "dataLicense"), "CC0-1.0");
    assert_string_equal(text(bill, "SPDXID"), "SPDXRef-DOCUMENT");
    assert_non_null(strstr(text(bill, "documentNamespace"), "https://"));
    assert_string_equal(text(json_object_get(bill, "creationInfo"), "created"), "2026-01-01T00:00:00Z");
    assert_int_equal(json_array_size(json_object_get(bill, "files")), 3);
    check_packages(bill);
    check_relationships(bill);
    json_decref(bill);
}

static void unknown_library_stops_the_bill(void** state)
{
    (void)state;
    if (system("command -v dpkg-query >/dev/null") != 0) return;
    hair_test_shell_expect(1, "sh tools/check/sbom.sh 1.2.3 2026-01-01T00:00:00Z /usr/bin/bash", "is not in");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bill_of_libraries_and_tools_is_spdx),
        cmocka_unit_test(unknown_library_stops_the_bill),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
