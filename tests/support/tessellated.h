// tessellated.h - the default view by the tessellator, whatever HAIR_RENDER_PATH_AUTO selects.
#ifndef HAIR_TESTS_SUPPORT_TESSELLATED_H
#define HAIR_TESTS_SUPPORT_TESSELLATED_H

#include <hair/hair_view.h>

static inline hair_view hair_test_tessellated(void)
{
    hair_view view = hair_view_default();
    view.render_path = HAIR_RENDER_PATH_TESSELLATION;
    return view;
}

#endif
