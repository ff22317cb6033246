// mixed_frames.glsl - a test for frames that are not along their segments, and their correction.
// Value of 1 - cos(angle between a frame and its segment) from which the frame is turned.
#define ASTRAY 1e-4

// Return whether frames are unit quaternions and along their segments.
bool are_aligned()
{
    bool astray = false;
    FOR_VERTICES(guide_count - 1u) {
        vec3  to = AFTER_VEC3(place) - GET(place);
        vec4  q  = SHARED_READ(section);
        float off = dot(q, q) - dot(along_of(q), to) / max(length(to), 1e-30);
        astray = astray || (i + 1u < guide_count && bits_of(off) > floatBitsToUint(ASTRAY));
    }
    return !group_any(bvec2(astray, false)).x;
}

// Turn frames onto their segments by the least rotation. Other methods leave frames that are not
// along them.
void align_frames()
{
    FOR_VERTICES(guide_count) {
        vec3 to = (AFTER_VEC3(place) - GET(place)) + (AFTER_VEC3(moved) - GET(moved));
        vec4 q  = SHARED_READ(section);
        if (!(bits_of(dot(q, q) - 1.0) < floatBitsToUint(0.1)))
            q = quat_multiply(turn_now, rest[min(guide_first + i, params.vertices - 1u)].frame);
        float l = length(to);
        if (i + 1u < guide_count && l > 0.0 && bits_of(l) < 0x7f800000u)
            q = quat_multiply(quat_between(along_of(q), to / l), q);
        SHARED_READ(section) = normalize(q);
    }
    GROUP_BARRIER;
}
