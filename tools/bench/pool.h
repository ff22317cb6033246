// pool.h - threads that run the tasks of the library, for measurements of elapsed time.
#ifndef HAIR_TOOLS_BENCH_POOL_H
#define HAIR_TOOLS_BENCH_POOL_H

#include <hair/hair.h>

// Return tasks that run on all processors. `*threads` receives their number.
hair_tasks bench_pool_tasks(uint32_t* threads);

#endif
