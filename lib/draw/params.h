// params.h - one draw's parameters, from the application's view and look to the head's own coordinates.
#ifndef HAIR_DRAW_PARAMS_H
#define HAIR_DRAW_PARAMS_H

#include "lib/draw/draw.h"

// `view` NULL: only what places followers.
void hair_draw_write_params(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out);

// detail.c: of them what is about the level of detail. Those about the view are there.
void hair_draw_write_detail(const struct hair_draw* draw, const struct hair_pose* head, const hair_view* view,
                            struct hair_draw_params* out);

#endif
