// ways.h - every way in which guides are simulated: each solver in each mapping that it has.
#ifndef HAIR_TESTS_SUPPORT_WAYS_H
#define HAIR_TESTS_SUPPORT_WAYS_H

#include <hair/hair.h>

#define HAIR_TEST_SOLVERS (HAIR_SOLVER_REDBLACK + 1) // the last one and all before
#define HAIR_TEST_WAYS (2 * HAIR_TEST_SOLVERS - 1) // redblack has one mapping

// The `way`-th: solver, mapping and the substep that the solver wants, of ordinary hair.
hair_desc hair_test_way(int way);
const char* hair_test_way_name(int way); // "direct, a thread per guide"

// How far a vertex of a hand-made groom may be off, m, where a head's pose is rounded otherwise. Rods' lengths are fitted
// until they are right to 5e-4: whether once more may hang on rounding.
double hair_test_way_rounding(int way);

#endif
