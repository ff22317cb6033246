// every_strand.h - A haircut all of whose strands are simulated, as the setting every_strand asks.
#ifndef HAIR_TOOLS_COMMON_EVERY_STRAND_H
#define HAIR_TOOLS_COMMON_EVERY_STRAND_H

#include "tools/common/scene.h"

// Replace a groom by one whose guides are the strands that are drawn of it at rest, if the scene
// asks for that. Return an exit status for the tool, after printing any error. The groom is then
// as before.
int hair_every_strand_make(const char* tool, const hair_host* host, hair_context* context,
                           const struct hair_scene* scene, hair_groom** groom);

// Return the look for an instance. If every strand is simulated, strands have the curls, strays and
// lengths of the look as their shape already, and the result has none.
hair_look hair_every_strand_look(const struct hair_settings* settings);

// Return whether two settings need different grooms because every strand is simulated.
bool hair_every_strand_differs(const struct hair_settings* a, const struct hair_settings* b);

#endif
