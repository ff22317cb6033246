// frames.glsl - frames carried along a guide by the least rotation from each segment to the next.
//
// F_i = T_i F_(i-1), where T_i turns the direction of segment i-1 into that of segment i. Products of rotations
// are associative, so the chain is an inclusive scan: log2 n steps (Hillis and Steele 1986) instead of n.
#include "rotation.glsl"

shared vec4 scan_frame[HAIR_GUIDE_THREADS];
shared vec3 segment_direction[HAIR_GUIDE_THREADS];

// One thread per segment i; `direction` is its unit direction, `root` the frame that the scalp gives. Afterwards
// scan_frame[i] is the frame of segment i and segment_direction[i] its direction. Called by the whole work group.
void carry_frames(uint i, uint segments, vec3 direction, vec4 root)
{
    synchronise();
    segment_direction[i] = direction;
    synchronise();
    vec4 turn = i == 0u ? quat_multiply(quat_between(rotate(root, vec3(0.0, 1.0, 0.0)), direction), root)
                        : quat_between(segment_direction[i - 1u], direction);
    scan_frame[i] = turn;
    for (uint reach = 1u; reach < segments; reach *= 2u) {
        synchronise();
        vec4 before = i >= reach ? scan_frame[i - reach] : vec4(0.0, 0.0, 0.0, 1.0);
        synchronise();
        if (i >= reach) scan_frame[i] = normalize(quat_multiply(scan_frame[i], before));
    }
    synchronise();
}
