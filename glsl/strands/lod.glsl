// lod.glsl - level of detail: the fraction of its strands with which a patch is drawn, and the
// number of their segments.
#ifndef HAIR_LOD_GLSL
#define HAIR_LOD_GLSL

#include "strands/guide_positions.glsl"

#define MIN_SEGMENTS 2.0
#define GIVE 1.1     // Factor that allows for stretch and for followers that leave their guides.
#define OCCLUDED_BY 0.3 // Depth of the line of sight in the skull, in radii.

struct hair_detail {
    float strands;   // Fraction.
    float segments;
    float thickness; // Factor that compensates for the strands left out.
    float wider;     // Factor that compensates for the curls that long segments cut off.
};

vec3 guide_at(uint guide, uint sample_)
{
    return fetch_position(int(guide * draw.smooth_vertices + sample_)).xyz;
}

float pixels_per_metre(vec3 position)
{
    float w = (draw.view_to_clip * (draw.view * vec4(position, 1.0))).w;
    return draw.pixels_per_unit / max(w, 1e-6);
}

bool is_in_view(vec3 center, float radius)
{
    vec4 p     = vec4(center, 1.0);
    vec4 sides =
        vec4(dot(draw.sides[0], p), dot(draw.sides[1], p), dot(draw.sides[2], p), dot(draw.sides[3], p));
    return all(greaterThan(sides, vec4(-radius)));
}

// Return how strongly the skull occludes a point. 0 means that the line of sight misses the skull.
// 1 means that it enters the skull by OCCLUDED_BY radii or more.
float occluded_at(vec3 eye, vec3 position)
{
    vec3  way  = position - eye;
    float near = clamp(dot(draw.head_sphere.xyz - eye, way) / dot(way, way), 0.0, 1.0);
    float past = distance(eye + near * way, draw.head_sphere.xyz);
    return smoothstep(0.0, OCCLUDED_BY, 1.0 - past / draw.head_sphere.w);
}

// Return whether a sphere lies wholly in the cone that the skull occludes.
bool is_occluded(vec3 eye, vec3 center, float radius)
{
    vec3  to_skull = draw.head_sphere.xyz - eye, to_ball = center - eye;
    float a = length(to_skull), b = length(to_ball);
    if (a <= draw.head_sphere.w || b - radius < a) return false;
    float head_sphere = asin(draw.head_sphere.w / a),
          between = acos(clamp(dot(to_skull, to_ball) / (a * b), -1.0, 1.0));
    return between + asin(min(radius / b, 1.0)) < head_sphere;
}

// Return the fraction of a patch's strands that are drawn where a metre has `size` pixels.
float fraction_at(float size)
{
    float pixels = 2.0 * draw.radius * size;
    return draw.strand_fraction * clamp(pixels / draw.strand_pixels, draw.min_strand_fraction, 1.0);
}

// Return the factor of the width that compensates for the strands left out.
float widening_of(float fraction) { return pow(max(fraction, 1e-6), -draw.width_power); }

// Return the area that a curled strand covers when its segments have a length, m, in areas of a
// straight strand. The sides of a segment are perpendicular to the tangents at its ends, from which
// its own direction differs by the turn between them.
float find_area(float part)
{
    float turn = draw.curl_rate * part;
    return 1.0 + (turn < 3.1415927 ? draw.curl_slope * sin(turn) / max(turn, 1e-6) : 0.0);
}

// Return the factor by which a strand with fewer segments must be wider to cover the same area.
float compensate(float length_, float segments)
{
    float all = float(draw.segments);
    return segments < all ? find_area(length_ / all) / find_area(length_ / segments) : 1.0;
}

// Return the level of detail of a patch. `patch_` holds the patch's reach, length and importance.
hair_detail find_detail(uint guide, vec3 patch_)
{
    float max_value   = float(draw.segments) * draw.segment_fraction;
    float fraction  = draw.strand_fraction, segments = max(max_value, 1.0);
    if (draw.culls == 0u && draw.pixels_per_unit == 0.0)
        return hair_detail(fraction, segments, widening_of(fraction), compensate(patch_.y, segments));
    vec3  root  = guide_at(guide, 0u);
    float reach = draw.max_radius + GIVE * draw.strand.max_width * patch_.x +
                  draw.strand.max_stray * patch_.y + draw.strand.max_offset;
    if (draw.culls > 0u && !is_in_view(root, reach)) return hair_detail(0.0, 1.0, 1.0, 1.0);
    if (draw.pixels_per_unit > 0.0) {
        float scale =
            max(pixels_per_metre(root), max(pixels_per_metre(guide_at(guide, draw.smooth_vertices / 2u)),
                                            pixels_per_metre(guide_at(guide, draw.smooth_vertices - 1u))));
        float size  = scale * patch_.z;
        if (draw.head_sphere.w > 0.0) {
            vec3 eye = draw.eye.w > 0.0 ? draw.eye.xyz
                                        : draw.head_sphere.xyz + 1000.0 * draw.head_sphere.w * draw.eye.xyz;
            if (is_occluded(eye, root, reach)) return hair_detail(0.0, 1.0, 1.0, 1.0);
            size *= mix(1.0, draw.occluded_importance, occluded_at(eye, root));
        }
        fraction = fraction_at(size);
        segments = clamp(patch_.y * size / draw.segment_pixels, min(MIN_SEGMENTS, segments), segments);
    }
    return hair_detail(fraction, segments, widening_of(fraction), compensate(patch_.y, segments));
}

#endif
