// capture_bullet_test.c - scenes of hair-capture with Bullet objects: positions and errors.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-capture"
#define QUICK "--size 64x48 --samples 1 --show colliders"
#define REST                                                                                                 \
    "\"fur\": {\"strands\": 200, \"length\": 0.3}, \"settings\": {\"guides\": 32}, "                         \
    "\"camera\": {\"eye\": [0, 0.3, 1], \"target\": [0, 0, 0]}, \"fps\": 30"

#define expect hair_test_shell_expect

static int start(void** state)
{
    (void)state;
    if (hair_test_shell_start(TOOL)) return -1;
    return hair_test_shell("printf 'v 0 0 0\\nv .1 0 0\\nv 0 .1 0\\nv 0 0 .1\\nvn 1 0 0\\nf 1/1/1 3//2 2\\n"
                           "f 1 2 4 \\r\\nf -4 -1 -2\\nf 2 3 4\\n' >$D/corner.obj");
}

// Capture frame 3 of a scene with these lists into $D/NAME.
static void capture(const char* lists, const char* name)
{
    char command[2048];
    snprintf(command, sizeof command,
             "echo '{%s, " REST "}' >$D/s.json; $T $D/s.json " QUICK " --frames 3:4 -o $D/%s", lists, name);
    expect(0, command, "");
}

static int is_without_bullet(void)
{
    expect(0,
           "echo '{\"bullet\": [{}], " REST "}' >$D/s.json; $T $D/s.json " QUICK
           " --frames 0:1 -o $D/a.png || true",
           "");
    if (!strstr(hair_test_said, "built without Bullet")) return 0;
    assert_non_null(
        strstr(hair_test_said, "s.json: bullet has 1 objects, but this hair-capture was built without"));
    print_message("    without Bullet\n");
    return 1;
}

// Compare Bullet's sphere, capsule and plane with the library's, bit for bit.
static void bullet_objects_move_like_colliders(void** state)
{
    (void)state;
    static const char* const pairs[][2] = {
        {"{\"shape\": \"sphere\", \"radius\": 0.05, \"position\": [0.1, 0.1, 0.1]}",
         "{\"shape\": \"sphere\", \"radius\": 0.05, \"position\": [0.1, 0.1, 0.1]}"},
        {"{\"shape\": \"capsule\", \"radius\": 0.05, \"half_length\": 0.1, \"stays\": true, "
         "\"position\": [0.1, 0.1, 0.2], \"rotation\": [0, 0, 0.6, 0.8]}",
         "{\"shape\": \"capsule\", \"radius\": 0.05, \"half_length\": 0.1, \"stays\": true, "
         "\"position\": [0, 0.1, 0.2], \"rotation\": [0, 0, 0.6, 0.8], \"velocity\": [1, 0, 0]}"},
        {"{\"shape\": \"capsule\", \"radius\": 0.05, \"half_length\": 0.1, \"stays\": true, "
         "\"position\": [0.1, 0.1, 0.2], \"rotation\": [0.70710678, 0, 0, 0.70710678]}",
         "{\"shape\": \"capsule\", \"axis\": \"z\", \"radius\": 0.05, \"half_length\": 0.1, \"stays\": true, "
         "\"position\": [0.1, 0.1, 0.2], \"motion\": [{\"time\": 0, \"position\": [5, 0, 0]}, {\"time\": "
         "0.1}]}"},
        {"{\"shape\": \"plane\", \"position\": [0, -0.1, 0], \"stays\": true}",
         "{\"shape\": \"plane\", \"distance\": -0.1, \"stays\": true}"},
    };
    if (is_without_bullet()) return;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        char list[512];
        snprintf(list, sizeof list, "\"colliders\": [%s]", pairs[i][0]);
        capture(list, "colliders.png");
        snprintf(list, sizeof list, "\"bullet\": [%s]", pairs[i][1]);
        capture(list, "bullet.png");
        expect(0, "cmp $D/colliders.png $D/bullet.png", "");
    }
    capture("\"bullet\": []", "none.png");
    expect(0, "! cmp -s $D/none.png $D/bullet.png", "");
    // Objects out of reach have no effect.
    capture("\"bullet\": [{\"shape\": \"sphere\", \"position\": [3, 0, -1], \"stays\": true}]", "far.png");
    expect(0, "cmp $D/none.png $D/far.png", "");
}

static void every_bullet_shape_can_be_in_a_scene(void** state)
{
    (void)state;
    static const char* const shapes[] = {
        "\"shape\": \"box\", \"size\": [0.1, 0.05, 0.02], \"margin\": 0.01",
        "\"shape\": \"cylinder\", \"axis\": \"x\", \"radius\": 0.05",
        "\"shape\": \"cylinder\", \"axis\": \"z\", \"radius\": 0.05",
        "\"shape\": \"cone\", \"axis\": \"x\"",
        "\"shape\": \"cone\", \"axis\": \"y\"",
        "\"shape\": \"hull\", \"points\": [[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]]",
        "\"shape\": \"hull\", \"mesh\": \"corner.obj\", \"scale\": [1, 2, 1]",
        "\"shape\": \"mesh\", \"mesh\": \"corner.obj\", \"margin\": 0.01",
        "\"shape\": \"multi_sphere\", \"spheres\": [[0, 0, 0, 0.05], [0.1, 0, 0, 0.02]]",
        "\"shape\": \"height_field\", \"heights\": [[0, 0.1, 0], [0, 0.05, 0.1]], \"spacing\": 0.05",
        "\"shape\": \"compound\", \"children\": [{\"shape\": \"sphere\", \"position\": [0.1, 0, 0], "
        "\"radius\": 0.05},"
        " {\"shape\": \"compound\", \"children\": [{\"shape\": \"box\", \"rotation\": [0, 0.6, 0, 0.8]}]}]",
    };
    if (is_without_bullet()) return;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; ++i) {
        char list[512];
        snprintf(list, sizeof list, "\"bullet\": [{%s, \"position\": [0.1, 0, 0.1]}]", shapes[i]);
        capture(list, "a.png");
        expect(0, "cat $D/a.png | cksum >>$D/sums", "");
    }
    expect(0, "sort -u $D/sums | wc -l", "11\n"); // All pictures differ.
}

static void invalid_bullet_values_are_named_with_their_range(void** state)
{
    (void)state;
    static const char* const wrong[][2] = {
        {"{\"shape\": \"cube\"}", "bullet[0].shape must be one of sphere, box, capsule"},
        {"{\"dance\": 1}", "there is no bullet[0].dance"},
        {"{\"radius\": -1}", "bullet[0].radius must be a number in [0, 1000000]"},
        {"{\"scale\": [1, 0, 1]}", "bullet[0].scale[1] must be a number in [1e-06, 1000000]"},
        {"{\"axis\": \"w\"}", "bullet[0].axis must be \"x\", \"y\" or \"z\""},
        {"{}, {\"rotation\": [0, 0, 0, 0]}", "bullet[1].rotation must be a unit quaternion"},
        {"{\"shape\": \"box\", \"radius\": 1}", "bullet[0].radius must be left out: a box has none"},
        {"{\"shape\": \"plane\", \"normal\": [0, 0, 0]}", "bullet[0].normal must be longer than 0"},
        {"{\"shape\": \"hull\"}", "bullet[0].points must be given, or else mesh"},
        {"{\"shape\": \"hull\", \"points\": []}", "bullet[0].points must be an array of 1 to 1048576 arrays"},
        {"{\"shape\": \"hull\", \"points\": [[0, 0]]}",
         "bullet[0].points[0] must be 3 numbers in [-1000000, 1000000]"},
        {"{\"shape\": \"hull\", \"points\": [[0, 0, 1e7]]}", "bullet[0].points[0] must be 3 numbers"},
        {"{\"shape\": \"hull\", \"points\": [[0, 0, 0]], \"mesh\": \"corner.obj\"}", "or else mesh"},
        {"{\"shape\": \"multi_sphere\", \"spheres\": [[0, 0, 0, -1]]}",
         "spheres must be without a radius below 0"},
        {"{\"shape\": \"height_field\", \"heights\": [[0, 1]]}", "heights must be an array of 2 to 1048576"},
        {"{\"shape\": \"height_field\", \"heights\": [[0, 1], [0]]}", "heights[1] must be 2 numbers"},
        {"{\"shape\": \"mesh\"}", "bullet[0].mesh must be given"},
        {"{\"shape\": \"mesh\", \"mesh\": \"none.obj\"}", "none.obj"},
        {"{\"shape\": \"mesh\", \"mesh\": \"bad1.obj\"}",
         "bad1.obj: line 2 has a vertex that is not 3 numbers"},
        {"{\"shape\": \"mesh\", \"mesh\": \"bad2.obj\"}",
         "bad2.obj: line 2 has a face with a vertex that is not among"},
        {"{\"shape\": \"mesh\", \"mesh\": \"bad3.obj\"}",
         "bad3.obj: line 3 has a face of fewer than 3 corners"},
        {"{\"shape\": \"mesh\", \"mesh\": \"bad4.obj\"}", "bullet[0].mesh must be a file with faces"},
        {"{\"shape\": \"mesh\", \"mesh\": \"bad5.obj\"}", "bad5.obj: there is no vertex in it"},
        {"{\"shape\": \"compound\", \"children\": []}",
         "bullet[0].children must be an array of 1 to 100000 objects"},
        {"{\"shape\": \"compound\", \"children\": [{\"velocity\": [0, 0, 0]}]}",
         "no bullet[0].children[0].velocity"},
        {"{\"shape\": \"compound\", \"children\": [{}, {\"shape\": \"cone\", \"children\": [{}]}]}",
         "bullet[0].children[1].children must be left out: a cone has none"},
        {"{\"motion\": [{\"time\": 1}, {\"time\": 1}]}", "bullet[0].motion must be in order of time"},
        {"7", "bullet[0] must be an object"},
    };
    assert_int_equal(
        hair_test_shell(
            "cd $D; printf 'v 0 0 0\\nv 0 0 nan\\n' >bad1.obj; printf 'v 0 0 0\\nf 1 2 3\\n' >bad2.obj;"
            "printf 'v 0 0 0\\nv 1 0 0\\nf 1 2\\n' >bad3.obj; printf 'v 0 0 0\\n' >bad4.obj; : >bad5.obj"),
        0);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char command[512];
        snprintf(command, sizeof command, "echo '{\"bullet\": [%s]}' >$D/s.json; $T $D/s.json -o $D/b.png",
                 wrong[i][0]);
        expect(4, command, wrong[i][1]);
    }
    if (is_without_bullet()) return;
    expect(4,
           "echo '{\"bullet\": [{}, {\"radius\": 0}], " REST "}' >$D/s.json; $T $D/s.json " QUICK
           " --frames 0:1 -o $D/b.png",
           "bullet[1] must be a shape that hair can collide with");
    assert_non_null(strstr(hair_test_said, "SPHERE of type 8 has no size"));
    expect(1, "test -e $D/b.png", "");
}

// Check that no text of a mesh file, such as a material's name, can command a terminal, and that a
// file without an end is refused.
static void hostile_mesh_file_is_refused_with_escaped_text(void** state)
{
    (void)state;
    expect(0,
           "printf 'mtllib \\033]0;owned\\007\\nusemtl \\033[2J\\nv \\033[2J\\n' >\"$D/$(printf "
           "'a\\033b').obj\"",
           "");
    expect(4,
           "echo '{\"bullet\": [{\"shape\": \"mesh\", \"mesh\": \"a\\u001bb.obj\"}]}' >$D/s.json; "
           "$T $D/s.json -o $D/b.png",
           "a\\x1bb.obj: line 3 has a vertex that is not 3 numbers");
    assert_null(strchr(hair_test_said, '\033'));
    assert_null(strchr(hair_test_said, '\007'));
    expect(0, "echo '{\"bullet\": [{\"shape\": \"mesh\", \"mesh\": \"/dev/zero\"}]}' >$D/s.json", "");
    char command[128];
    snprintf(command, sizeof command, "%s timeout 20 $T $D/s.json -o $D/b.png",
             hair_test_shell_limit(4000000));
    expect(4, command, "/dev/zero has more than the 268435456 bytes allowed");
}

static void example_bullet_scene_can_be_captured(void** state)
{
    (void)state;
    if (is_without_bullet()) return;
    expect(0,
           "$T tools/scenes/bullet.json --size 64x48 --samples 1 --followers 300 --frames 0:2 --verbose -o "
           "$D/b_%d.png",
           "a collision mesh of 84 triangles is not closed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bullet_objects_move_like_colliders),
        cmocka_unit_test(every_bullet_shape_can_be_in_a_scene),
        cmocka_unit_test(invalid_bullet_values_are_named_with_their_range),
        cmocka_unit_test(hostile_mesh_file_is_refused_with_escaped_text),
        cmocka_unit_test(example_bullet_scene_can_be_captured),
    };
    return cmocka_run_group_tests(tests, start, hair_test_shell_finish);
}
