// frames.glsl - parallel transport of frames along a guide, by the smallest rotation from each
// segment to the next.
//
// F_i = T_i F_(i-1), where T_i rotates the direction of segment i-1 into that of segment i.
// Products of rotations are associative. The chain is therefore an inclusive scan of log2 n steps
// (Hillis and Steele 1986) and not n steps.
#include "rotation.glsl"

shared vec4 scan_frame[HAIR_GUIDE_THREADS];
shared vec3 segment_direction[HAIR_GUIDE_THREADS];

// Compute the frames of all segments. The whole work group calls it, with one thread per segment i.
// `direction` is the unit direction of segment i, and `root` is the frame of the scalp. Afterwards
// scan_frame[i] is the frame of segment i and segment_direction[i] its direction.
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
