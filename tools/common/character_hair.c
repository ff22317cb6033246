// character_hair.c - Hair on a character: roots on the head, scalp on the joints, and the body that
// hair collides with.
#include "tools/common/character.h"
#include "tools/common/file.h"

#include <cglm/cglm.h>

#include <stdlib.h>
#include <string.h>

#define VOXEL 0.008f // m, of the body where its resolution allows it
#define MARGIN 0.03f // m, from the reach of the hair, and from the mesh, to the box of the body
#define POSES 64 // of the animation, from which the box is found

// The skull of the built-in haircuts (hair_asset.h), m.
static const float skull_center[3] = {0, 1.63f, 0}, skull_axes[3] = {0.077f, 0.098f, 0.096f};

// Head --------------------------------------------------------------------------------------------

bool hair_character_is_of_head(const struct hair_character* character, uint32_t vertex)
{
    float sum = 0;
    for (size_t k = 4 * (size_t)vertex; k < 4 * (size_t)vertex + 4; ++k) {
        uint32_t node = character->joint_nodes[character->joints[k]];
        while (node != character->head && node != HAIR_GLTF_NONE) node = character->gltf.nodes[node].parent;
        if (node != HAIR_GLTF_NONE) sum += character->weights[k];
    }
    return sum >= 0.5f;
}

// Compute the box of the head at rest above a height. Return whether a vertex is in it.
static bool find_head_box(const struct hair_character* character, float above, struct hair_bounds* out)
{
    bool any = false;
    *out = (struct hair_bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < character->mesh.vertex_count; ++i) {
        const float* p = character->rest_positions + 3 * (size_t)i;
        if (p[1] < above || !hair_character_is_of_head(character, i)) continue;
        hair_bounds_add(out, p, p);
        any = true;
    }
    return any;
}

void hair_character_bounds(const struct hair_character* character, struct hair_bounds* bounds)
{
    struct hair_bounds head, out = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    mat4 transform;
    if (find_head_box(character, -INFINITY, &head)) hair_bounds_add(bounds, head.lower, head.upper);
    memcpy(transform, character->transform, sizeof transform);
    for (int corner = 0; corner < 8; ++corner) {
        vec3 p;
        for (int k = 0; k < 3; ++k) p[k] = corner >> k & 1 ? bounds->upper[k] : bounds->lower[k];
        glm_mat4_mulv3(transform, p, 1, p);
        hair_bounds_add(&out, p, p);
    }
    *bounds = out;
}

// Fit ---------------------------------------------------------------------------------------------

// Map from the space of a haircut to the head, and the triangles of the head.
struct fit {
    const struct hair_character* character;
    const uint32_t** triangles; // of the mesh, those of the head first
    uint32_t triangle_count, head_count;
    float scale, center[3], offset[3];
};

// Find the size of the skull from the upper part of the head, which has no jaw.
static bool measure_head(const struct hair_character* character, const struct hair_scene* scene,
                         struct fit* out)
{
    struct hair_bounds head, top;
    if (!find_head_box(character, -INFINITY, &head)) {
        hair_complain(character->tool, "%s: no vertex moves with the node %s", character->path,
                      character->gltf.nodes[character->head].name);
        return false;
    }
    float height = head.upper[1] - head.lower[1];
    find_head_box(character, head.upper[1] - 0.45f * height, &top);
    float width = 0.5f * (top.upper[0] - top.lower[0]), depth = 0.5f * (top.upper[2] - top.lower[2]);
    out->scale = 0.5f * (width / skull_axes[0] + depth / skull_axes[2]) * scene->character.hair_scale;
    out->scale = fmaxf(out->scale, 1e-3f);
    out->center[0] = 0.5f * (top.lower[0] + top.upper[0]);
    out->center[1] = head.upper[1] - out->scale * skull_axes[1];
    out->center[2] = 0.5f * (top.lower[2] + top.upper[2]);
    memcpy(out->offset, scene->character.hair_offset, sizeof out->offset);
    return true;
}

// List the triangles of the mesh, those of the head first.
static bool find_triangles(struct fit* fit)
{
    const struct head_mesh* mesh = &fit->character->mesh;
    fit->triangles = calloc(mesh->triangle_count, sizeof *fit->triangles);
    if (!fit->triangles) return false;
    for (int pass = 0; pass < 2; ++pass) {
        for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
            const uint32_t* t = mesh->triangles + 3 * (size_t)i;
            bool is_head = true;
            for (int k = 0; k < 3; ++k) is_head &= hair_character_is_of_head(fit->character, t[k]);
            if (is_head == !pass) fit->triangles[fit->triangle_count++] = t;
        }
        if (!pass) fit->head_count = fit->triangle_count;
    }
    return true;
}

static void load_corners(const struct hair_character* character, const uint32_t* triangle, vec3 corner[3])
{
    for (int k = 0; k < 3; ++k)
        memcpy(corner[k], character->rest_positions + 3 * (size_t)triangle[k], sizeof(vec3));
}

// Return the multiple of a ray at which the ray meets a triangle (Moeller and Trumbore 1997), or 0
// if there is none.
static float hit_triangle(vec3 from, vec3 ray, vec3 corner[3])
{
    vec3 a, b, across, to, other;
    glm_vec3_sub(corner[1], corner[0], a);
    glm_vec3_sub(corner[2], corner[0], b);
    glm_vec3_cross(ray, b, across);
    float determinant = glm_vec3_dot(a, across);
    if (fabsf(determinant) < 1e-20f) return 0;
    glm_vec3_sub(from, corner[0], to);
    glm_vec3_cross(to, a, other);
    float u = glm_vec3_dot(to, across) / determinant, v = glm_vec3_dot(ray, other) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 ? glm_vec3_dot(b, other) / determinant : 0;
}

// Move a root along its ray from the centre to the outermost surface of the head. A root of the
// nape, whose ray meets no head, moves to the nearest surface on the ray. Any other root stays.
static void project(const struct fit* fit, vec3 root)
{
    vec3 center = {fit->center[0], fit->center[1], fit->center[2]}, ray, corner[3];
    float outermost = 0, nearest = 0;
    glm_vec3_sub(root, center, ray);
    for (uint32_t i = 0; i < fit->triangle_count; ++i) {
        load_corners(fit->character, fit->triangles[i], corner);
        float t = hit_triangle(center, ray, corner);
        if (t < 0.5f || t > 2) continue;
        if (i < fit->head_count) outermost = fmaxf(outermost, t);
        if (nearest == 0 || fabsf(t - 1) < fabsf(nearest - 1)) nearest = t;
    }
    float t = outermost > 0 ? outermost : nearest > 0 ? nearest : 1;
    for (int k = 0; k < 3; ++k) root[k] = center[k] + t * ray[k];
}

// Place one strand, or one vertex of the scalp, whose root moves onto the head.
static void place_strand(const struct fit* fit, bool fits, uint32_t count, float* positions)
{
    vec3 root, before, way = {0, 0, 0};
    for (uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            float* p = positions + 3 * (size_t)i + k;
            if (fits) *p = fit->center[k] + fit->scale * (*p - skull_center[k]);
            *p += fit->offset[k];
        }
    if (!fits || !count) return;
    memcpy(root, positions, sizeof root);
    glm_vec3_copy(root, before);
    project(fit, root);
    glm_vec3_sub(root, before, way);
    for (uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) positions[3 * (size_t)i + (size_t)k] += way[k];
}

// Find the point of a triangle nearest to p, by its fractions of the corners (Ericson 2005, 5.1.5).
// Return the squared distance.
static float find_nearest(vec3 p, vec3 corner[3], float fraction[3])
{
    vec3 ab, ac, ap, bp, cp, at;
    glm_vec3_sub(corner[1], corner[0], ab);
    glm_vec3_sub(corner[2], corner[0], ac);
    glm_vec3_sub(p, corner[0], ap);
    glm_vec3_sub(p, corner[1], bp);
    glm_vec3_sub(p, corner[2], cp);
    float d1 = glm_vec3_dot(ab, ap), d2 = glm_vec3_dot(ac, ap), d3 = glm_vec3_dot(ab, bp),
          d4 = glm_vec3_dot(ac, bp), d5 = glm_vec3_dot(ab, cp), d6 = glm_vec3_dot(ac, cp);
    float a = d3 * d6 - d5 * d4, b = d5 * d2 - d1 * d6, c = d1 * d4 - d3 * d2, v = 0, w = 0;
    if (d1 <= 0 && d2 <= 0)
        v = w = 0;
    else if (d3 >= 0 && d4 <= d3)
        v = 1;
    else if (d6 >= 0 && d5 <= d6)
        w = 1;
    else if (c <= 0 && d1 >= 0 && d3 <= 0)
        v = d1 / (d1 - d3);
    else if (b <= 0 && d2 >= 0 && d6 <= 0)
        w = d2 / (d2 - d6);
    else if (a <= 0 && d4 >= d3 && d5 >= d6)
        w = (d4 - d3) / (d4 - d3 + d5 - d6), v = 1 - w;
    else
        v = b / (a + b + c), w = c / (a + b + c);
    if (!(v >= 0 && w >= 0 && v + w <= 1.001f)) v = w = 0; // A triangle without area.
    fraction[0] = 1 - v - w, fraction[1] = v, fraction[2] = w;
    for (int k = 0; k < 3; ++k)
        at[k] = fraction[0] * corner[0][k] + v * corner[1][k] + w * corner[2][k] - p[k];
    return glm_vec3_dot(at, at);
}

// Blend the weights of a triangle's corners. Keep the four largest.
static void blend_weights(const struct hair_character* character, const uint32_t* triangle,
                          const float fraction[3], uint16_t joints[4], float weights[4])
{
    uint16_t joint[12];
    float weight[12] = {0}, sum = 0;
    uint32_t count = 0;
    for (uint32_t i = 0; i < 12; ++i) {
        size_t from = 4 * (size_t)triangle[i / 4] + i % 4;
        uint32_t k = 0;
        while (k < count && joint[k] != character->joints[from]) ++k;
        if (k == count) joint[count++] = character->joints[from];
        weight[k] += fmaxf(fraction[i / 4], 0) * character->weights[from];
    }
    for (uint32_t i = 0; i < 4; ++i) {
        uint32_t largest = 0;
        for (uint32_t k = 1; k < count; ++k)
            if (weight[k] > weight[largest]) largest = k;
        joints[i] = joint[largest];
        weights[i] = weight[largest];
        sum += weight[largest];
        weight[largest] = 0;
    }
    for (uint32_t i = 0; i < 4; ++i) weights[i] /= fmaxf(sum, 1e-6f);
}

// Bind each vertex of the scalp to the joints of the nearest triangle of `fit`.
static bool bind_scalp(struct hair_character* character, const struct fit* fit, const hair_groom_desc* desc)
{
    uint32_t count = desc->scalp_positions ? desc->scalp_vertex_count : 0;
    free(character->scalp_joints);
    free(character->scalp_weights);
    character->scalp_count = count;
    character->scalp_joints = calloc(count ? count : 1, 4 * sizeof *character->scalp_joints);
    character->scalp_weights = calloc(count ? count : 1, 4 * sizeof *character->scalp_weights);
    if (!character->scalp_joints || !character->scalp_weights) return false;
    for (size_t i = 0; i < count; ++i) {
        float nearest = INFINITY, fraction[3], best[3] = {1, 0, 0};
        const uint32_t* found = character->mesh.triangles;
        vec3 p, corner[3];
        memcpy(p, desc->scalp_positions + 3 * i, sizeof p);
        for (uint32_t t = 0; t < fit->triangle_count; ++t) {
            load_corners(character, fit->triangles[t], corner);
            float square = find_nearest(p, corner, fraction);
            if (square >= nearest) continue;
            nearest = square;
            found = fit->triangles[t];
            memcpy(best, fraction, sizeof best);
        }
        blend_weights(character, found, best, character->scalp_joints + 4 * i,
                      character->scalp_weights + 4 * i);
    }
    return true;
}

static void place_all(const struct fit* fit, bool fits, hair_groom_desc* desc, float* changed)
{
    size_t vertices = 0, at = 0;
    for (uint32_t i = 0; i < desc->strand_count; ++i) vertices += desc->strand_vertices[i];
    float* scalp = changed + 3 * vertices;
    memcpy(changed, desc->positions, 3 * vertices * sizeof *changed);
    for (uint32_t i = 0; i < desc->strand_count; at += 3 * (size_t)desc->strand_vertices[i++])
        place_strand(fit, fits, desc->strand_vertices[i], changed + at);
    desc->positions = changed;
    if (!desc->scalp_positions) return;
    memcpy(scalp, desc->scalp_positions, 3 * (size_t)desc->scalp_vertex_count * sizeof *scalp);
    for (uint32_t i = 0; i < desc->scalp_vertex_count; ++i) place_strand(fit, fits, 1, scalp + 3 * (size_t)i);
    desc->scalp_positions = scalp;
}

int hair_character_fit(struct hair_character* character, const struct hair_scene* scene,
                       hair_groom_desc* desc, float** changed)
{
    const struct hair_scene_character* from = &scene->character;
    bool fits = from->fit_is_said ? from->fit : scene->subject == HAIR_SUBJECT_STYLE;
    struct fit fit = {.character = character};
    size_t count = desc->scalp_positions ? desc->scalp_vertex_count : 0;
    for (uint32_t i = 0; i < desc->strand_count; ++i) count += desc->strand_vertices[i];
    *changed = NULL;
    if (!measure_head(character, scene, &fit)) return HAIR_EXIT_INPUT;
    *changed = malloc(3 * (count + 1) * sizeof **changed);
    bool ok = *changed && find_triangles(&fit);
    if (ok) {
        place_all(&fit, fits, desc, *changed);
        ok = bind_scalp(character, &fit, desc);
    }
    free(fit.triangles);
    if (!ok) hair_complain(character->tool, "%s: out of memory for the hair", character->path);
    return ok ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
}

// Body --------------------------------------------------------------------------------------------

// Write the positions of the mesh within the box. A closed surface stays closed if the vertices
// outside are moved to the box.
static void clamp_positions(struct hair_character* character)
{
    for (size_t i = 0; i < character->mesh.vertex_count; ++i)
        for (size_t k = 0; k < 3; ++k)
            character->clamped[3 * i + k] =
                glm_clamp(character->mesh.positions[3 * i + k], character->box[0][k], character->box[1][k]);
}

// Find the box that the part of the mesh in the present box keeps to during the animation.
static bool shrink_box(struct hair_character* character)
{
    struct hair_bounds out = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    uint32_t count = character->duration > 0 ? POSES : 1;
    bool ok = true;
    for (uint32_t i = 0; i < count && ok; ++i) {
        ok = hair_character_pose(character, character->duration * (float)i / POSES);
        clamp_positions(character);
        for (size_t k = 0; k < character->mesh.vertex_count && ok; ++k)
            hair_bounds_add(&out, character->clamped + 3 * k, character->clamped + 3 * k);
    }
    for (int k = 0; k < 3 && ok; ++k) {
        character->box[0][k] = fmaxf(character->box[0][k], out.lower[k] - MARGIN);
        character->box[1][k] = fminf(character->box[1][k], out.upper[k] + MARGIN);
    }
    return ok && hair_character_pose(character, 0);
}

hair_result hair_character_create_body(struct hair_character* character, hair_context* context,
                                       const float pivot[3], float reach)
{
    hair_body_desc desc = hair_body_desc_default();
    float longest = 0;
    for (int k = 0; k < 3; ++k) {
        character->box[0][k] = pivot[k] - reach - MARGIN;
        character->box[1][k] = pivot[k] + reach + MARGIN;
    }
    if (!shrink_box(character)) return HAIR_ERROR_FILE;
    for (int k = 0; k < 3; ++k) {
        desc.lower[k] = character->box[0][k];
        desc.upper[k] = character->box[1][k];
        longest = fmaxf(longest, desc.upper[k] - desc.lower[k]);
    }
    clamp_positions(character);
    desc.positions = character->clamped;
    desc.triangles = character->mesh.triangles;
    desc.vertex_count = character->mesh.vertex_count;
    desc.triangle_count = character->mesh.triangle_count;
    desc.resolution = (uint32_t)glm_clamp(ceilf(longest / VOXEL), 16, 128);
    return hair_body_create(context, &desc, &character->body);
}

// Set the scalp by the joints. A joint takes the groom's space to the world by the inverse of its
// matrix at rest.
static hair_result move_scalp(struct hair_character* character, hair_instance* hair)
{
    for (uint32_t i = 0; i < character->joint_count; ++i) {
        mat4 now, rest;
        memcpy(now, character->matrices + 16 * (size_t)i, sizeof now);
        memcpy(rest, character->rest_inverses + 16 * (size_t)i, sizeof rest);
        glm_mat4_mul(now, rest, now);
        memcpy(character->scalp_matrices + 16 * (size_t)i, now, sizeof now);
    }
    return hair_set_scalp_joints(hair, character->scalp_matrices, character->joint_count, NULL);
}

hair_result hair_character_move_hair(struct hair_character* character, hair_instance* hair)
{
    hair_result result = hair_set_transform(hair, character->transform);
    return !result && character->scalp_count ? move_scalp(character, hair) : result;
}

hair_result hair_character_move(struct hair_character* character, hair_instance* hair)
{
    hair_result result = hair_character_move_hair(character, hair);
    if (result || !character->body) return result;
    clamp_positions(character);
    return hair_body_set_positions(character->body, character->clamped, character->mesh.vertex_count,
                                   3 * sizeof(float));
}

hair_result hair_character_attach(struct hair_character* character, hair_instance* hair)
{
    hair_result result = HAIR_OK;
    if (character->scalp_count)
        result = hair_set_scalp_weights(hair, character->scalp_joints, character->scalp_weights,
                                        character->scalp_count, character->joint_count);
    if (!result) result = hair_character_move(character, hair);
    return result ? result : hair_reset(hair);
}

hair_collider hair_character_collider(const struct hair_character* character)
{
    hair_collider collider = hair_collider_default();
    collider.shape = HAIR_SHAPE_MESH;
    collider.mesh = hair_body_get_mesh(character->body);
    hair_collider_carry(character->transform, 1, &collider);
    return collider;
}
