// limits.h - limits that several rooms share.
#ifndef HAIR_SHARED_LIMITS_H
#define HAIR_SHARED_LIMITS_H

#define HAIR_MAX_GROUPS 65535u      // Work groups in one dimension that OpenGL guarantees.
// Threads of a work group, except in passes with a work group per guide. See lib/gl/passes.inl.
#define HAIR_GROUP_SIZE 64

// Isolines per tessellated patch and segments per isoline that OpenGL guarantees.
#define HAIR_MAX_ISOLINES 64
#define HAIR_MAX_ISOLINE_SEGMENTS 64
#define HAIR_STEP_SUBSTEPS 64        // Maximum per dispatch.
#define HAIR_CURVE_INTERVALS 7 // Per curve along a strand.

#endif
