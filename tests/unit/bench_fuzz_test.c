// bench_fuzz_test.c - a few of the random scenes of hair-bench stability, because all ten thousand
// take hours.
#include "tests/support/shell.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#define TOOL HAIR_BUILD_DIR "/hair-bench"
#define FUZZ "$T stability --case fuzz --csv - "
#define ROW " | tail -1 | cut -d, -f2,4,18,29" // method, finite, scenes, pass.

static int make_folder(void** state)
{
    (void)state;
    return hair_test_shell_start(TOOL);
}

static void direct_solver_does_not_stretch_in_random_scenes(void** state)
{
    (void)state;
    hair_test_shell_expect(0, FUZZ "--method direct --scene 1-2" ROW, "direct,true,2,true");
}

static void accurate_solver_does_not_stretch_in_random_scenes(void** state)
{
    (void)state;
    hair_test_shell_expect(0, FUZZ "--method accurate --scene 4-5" ROW, "accurate,true,2,true");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(direct_solver_does_not_stretch_in_random_scenes),
        cmocka_unit_test(accurate_solver_does_not_stretch_in_random_scenes),
    };
    return cmocka_run_group_tests(tests, make_folder, hair_test_shell_finish);
}
