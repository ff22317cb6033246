// mixed.comp - the mixed scheme for guides that are curved at rest, fine, or heavy at the tip. A
// dispatch does all substeps of a step for every guide.
//
// A substep by BDF2 that fails is done again in parts. Follow-the-leader does the parts that cannot
// be solved. A guide that is not finite even then returns to its rest pose. Each of these events is
// counted in solver_stats[].
#version 450 core
// NVIDIA's compiler would unroll loops, would take twice as long, and its program would be slower.
#pragma optionNV(unroll none)
#ifdef HAIR_SUBGROUP
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#endif
#include "sim/rod.glsl"
layout(local_size_x = GROUP_THREADS) in;
#include "sim/methods.glsl"
#ifdef HAIR_WIND
#include "sim/drag.glsl"
#endif
#include "sim/contact.glsl"
#include "sim/velocity_history.glsl"
#ifdef HAIR_PINNED
#include "sim/pins.glsl"
#endif
#include "sim/follow_the_leader.glsl"
#include "sim/mixed.glsl"
#include "sim/mixed_rows.glsl"
#include "sim/mixed_chain.glsl"
#include "sim/mixed_contact.glsl"
#include "sim/mixed_system.glsl"
#include "sim/mixed_solve.glsl"
#include "sim/mixed_step.glsl"
#include "sim/root_transforms.glsl"
#include "sim/load_store.glsl"
#include "sim/finish_substep.glsl"
#include "sim/substeps.glsl"

#include "sim/mixed_parts.glsl"
#include "sim/guide_level.glsl"

void main()
{
    uint k = hair_guide_number();
    if (k < params.simulated) {
        guide_number = simulated_guide(k);
        solve();
    }
}
