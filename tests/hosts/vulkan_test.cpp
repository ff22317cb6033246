// vulkan_test.cpp - hair that OpenGL draws into images of Vulkan, and triangles of Vulkan, hide
// each other, and Vulkan draws beads on the tips of the strands. The picture is that of
// tools/examples/vulkan_host.c.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
extern "C" {
#include <cmocka.h>
}

#include <cstdio>
#include <cstdlib>

namespace
{
constexpr int WIDTH = 256, HEIGHT = 192;
using picture = unsigned char[HEIGHT][WIDTH][3];
picture pixels, copied;

// Leaks of the drivers are not the example's, so a sanitizer must not report them.
#define COMMAND(name, argument)                                                                              \
    "ASAN_OPTIONS=detect_leaks=0 " HAIR_BUILD_DIR "/examples/vulkan_host " HAIR_BUILD_DIR "/" name           \
    " 256 " argument

// Colours of the program. All other pixels are of hair and of what it grows on.
enum class color { background, first, second, bead, hair };

color color_of(int y, int x, const picture& from = pixels)
{
    static const int known[4][3] = {{111, 121, 134}, {231, 160, 63}, {63, 149, 231}, {0, 218, 137}};
    for (int i = 0; i < 4; ++i) {
        bool is_near = true;
        for (int k = 0; k < 3; ++k) is_near &= std::abs(from[y][x][k] - known[i][k]) <= 2;
        if (is_near) return static_cast<color>(i);
    }
    return color::hair;
}

int count(int first_y, int end_y, color wanted)
{
    int out = 0;
    for (int y = first_y; y < end_y; ++y)
        for (int x = 0; x < WIDTH; ++x) out += color_of(y, x) == wanted;
    return out;
}

// Count the changes from one of the colours to the other in a row, from the left to the right.
int count_changes(int y, color from, color to)
{
    int out = 0;
    for (int x = 1; x < WIDTH; ++x) out += color_of(y, x - 1) == from && color_of(y, x) == to;
    return out;
}

void draw_picture(const char* command, const char* path, picture& out)
{
    int width = 0, height = 0;
    assert_int_equal(std::system(command), 0);
    FILE* file = std::fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(std::fscanf(file, "P6 %d %d 255%*c", &width, &height), 2);
    assert_true(width == WIDTH && height == HEIGHT);
    assert_int_equal(std::fread(out, 1, sizeof out, file), sizeof out);
    assert_int_equal(std::fclose(file), 0);
}

int draw_pictures(void**)
{
    draw_picture(COMMAND("vulkan_host.ppm", ""), HAIR_BUILD_DIR "/vulkan_host.ppm", pixels);
    draw_picture(COMMAND("vulkan_copy.ppm", "copy"), HAIR_BUILD_DIR "/vulkan_copy.ppm", copied);
    return 0;
}

void images_of_vulkan_have_triangles_and_hair(void**)
{
    const int first = count(0, HEIGHT, color::first), second = count(0, HEIGHT, color::second),
              hair = count(0, HEIGHT, color::hair), background = count(0, HEIGHT, color::background);
    print_message("    %d and %d pixels of triangles, %d of hair, %d of background\n", first, second, hair,
                  background);
    assert_true(first > 6000 && second > 3000 && hair > 6000 && background > 15000);
    // The head is upright, and the tip of the first triangle is above the head.
    assert_true(count(0, HEIGHT / 12, color::first) > 20 && count(0, HEIGHT / 12, color::hair) < 20);
}

// Locks fall in front of the first triangle, which hides the hair of the neck.
void hair_is_before_and_behind_the_first_triangle(void**)
{
    const int y = HEIGHT * 3 / 4;
    assert_true(count_changes(y, color::first, color::hair) >= 2);
    assert_true(count_changes(y, color::hair, color::first) >= 2);
    for (int x = WIDTH * 38 / 100; x < WIDTH * 52 / 100; ++x) assert_true(color_of(y, x) == color::first);
}

// The second triangle is drawn after hair. Hair of the temple hides the tip of the triangle where
// the skull does not.
void depth_of_hair_hides_the_second_triangle(void**)
{
    const int y = HEIGHT * 31 / 100;
    for (int x = WIDTH * 63 / 100; x < WIDTH * 65 / 100; ++x) assert_true(color_of(y, x) == color::hair);
    for (int x = WIDTH * 70 / 100; x < WIDTH * 95 / 100; ++x) assert_true(color_of(y, x) == color::second);
}

// Beads are on the tips below the chin, and are the same pixels if main memory has the strands.
void beads_are_on_the_tips_of_strands(void**)
{
    int changes = 0;
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            changes += (color_of(y, x) == color::bead) != (color_of(y, x, copied) == color::bead);
    print_message("    %d pixels of beads\n", count(0, HEIGHT, color::bead));
    assert_int_equal(count(0, HEIGHT * 3 / 4, color::bead), 0);
    assert_true(count(HEIGHT * 3 / 4, HEIGHT, color::bead) > 60);
    assert_int_equal(changes, 0);
}
} // namespace

int main()
{
    const CMUnitTest tests[] = {
        cmocka_unit_test(images_of_vulkan_have_triangles_and_hair),
        cmocka_unit_test(hair_is_before_and_behind_the_first_triangle),
        cmocka_unit_test(depth_of_hair_hides_the_second_triangle),
        cmocka_unit_test(beads_are_on_the_tips_of_strands),
    };
    return cmocka_run_group_tests_name("vulkan", tests, draw_pictures, nullptr);
}
