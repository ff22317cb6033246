// ways.c - all combinations of solvers and their mappings by which guides are simulated.
#include "tests/support/ways.h"

hair_desc hair_test_way(int way)
{
    static const float substeps[HAIR_TEST_SOLVERS] = {1.0f / 240, 1.0f / 960, 1.0f / 120, 1.0f / 120};

    hair_desc desc = hair_desc_default();
    desc.solver = (hair_solver)(way / 2);
    desc.thread_mapping =
        way % 2 ? HAIR_THREAD_MAPPING_THREAD_PER_GUIDE : HAIR_THREAD_MAPPING_WORKGROUP_PER_GUIDE;
    desc.substep = substeps[desc.solver];
    return desc;
}

const char* hair_test_way_name(int way)
{
    static const char* const names[HAIR_TEST_WAYS] = {"direct, a work group per guide",
                                                      "direct, a thread per guide",
                                                      "accurate, a work group per guide",
                                                      "accurate, a thread per guide",
                                                      "follow, a work group per guide",
                                                      "follow, a thread per guide",
                                                      "redblack"};
    return names[way];
}

double hair_test_way_rounding(int way)
{
    switch (hair_test_way(way).solver) {
    case HAIR_SOLVER_REDBLACK: return 1e-5;
    // It has no damping of its own, so differences grow after an impact.
    case HAIR_SOLVER_ACCURATE: return 2e-2;
    default: return 2e-4;
    }
}
