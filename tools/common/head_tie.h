// head_tie.h - The place where hair is tied, such as that of a ponytail.
#ifndef TOOLS_COMMON_HEAD_TIE_H
#define TOOLS_COMMON_HEAD_TIE_H

#include "tools/common/head.h"

// Find the place nearest to the roots where nearly all guides at rest pass through a narrow ring.
// Return false if there is none, or if memory runs out.
bool head_find_tie(const hair_groom* groom, struct head_tie* out);

#endif
