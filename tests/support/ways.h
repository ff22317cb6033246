// ways.h - all combinations of solvers and their mappings by which guides are simulated.
#ifndef HAIR_TESTS_SUPPORT_WAYS_H
#define HAIR_TESTS_SUPPORT_WAYS_H

#include <hair/hair.h>

#define HAIR_TEST_SOLVERS (HAIR_SOLVER_REDBLACK + 1) // Number of solvers.
#define HAIR_TEST_WAYS (2 * HAIR_TEST_SOLVERS - 1) // The solver redblack has one mapping.

// Return the `way`-th combination: solver, mapping and the solver's own substep for ordinary hair.
hair_desc hair_test_way(int way);
const char* hair_test_way_name(int way); // such as "direct, a thread per guide"

// Return the tolerance of a vertex of a handmade groom if the head's pose is rounded otherwise, m.
// Lengths of rods are fitted until they are correct within 5e-4, and rounding may decide on one
// more iteration.
double hair_test_way_rounding(int way);

#endif
