// common.h - What all files of hair-view share: the tools' C headers and the name of the tool.
#ifndef HAIR_TOOLS_VIEW_COMMON_H
#define HAIR_TOOLS_VIEW_COMMON_H

#include <hair/hair.h>
#include <hair/hair_egl.h>

extern "C" {
#include "tools/bullet/world.h"
#include "tools/common/camera.h"
#include "tools/common/character.h"
#include "tools/common/cuts.h"
#include "tools/common/every_strand.h"
#include "tools/common/file.h"
#include "tools/common/frame_writer.h"
#include "tools/common/groom_source.h"
#include "tools/common/groups.h"
#include "tools/common/live_colliders.h"
#include "tools/common/render.h"
#include "tools/common/scene.h"
#include "tools/common/scene_mesh.h"
#include "tools/common/scene_write.h"
#include "tools/common/stats.h"
}

#define TOOL "hair-view"

#endif
