// assert.h - assertions of invariants. Errors of the application, of files and of drivers are
// results, not assertions.
#ifndef HAIR_BASE_ASSERT_H
#define HAIR_BASE_ASSERT_H

#include <assert.h>

// Stop the program unless `condition` holds. Name the condition with its file and line on stderr.
// With NDEBUG, as in releases, the condition is not evaluated.
#ifdef NDEBUG
#define HAIR_ASSERT(condition) ((void)(0 && (condition)))
#else
#define HAIR_ASSERT(condition) assert(condition)
#endif

#endif
