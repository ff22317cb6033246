// style.h - the built-in haircuts, generated from parameters on the built-in scalp.
#ifndef HAIR_GROOM_STYLE_H
#define HAIR_GROOM_STYLE_H

#include "lib/asset/asset.h"

// Build a haircut. `desc` has been checked. On failure *out is untouched.
hair_result hair_style_build(const hair_host* host, const hair_style_desc* desc, hair_asset** out);

#endif
