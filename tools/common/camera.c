// camera.c - Matrices of the camera and of the shadow maps of lights.
#include "tools/common/camera.h"

#include <cglm/cglm.h>

#include <string.h>

void hair_bounds_add(struct hair_bounds* bounds, const float lower[3], const float upper[3])
{
    for (int i = 0; i < 3; ++i) {
        bounds->lower[i] = fminf(bounds->lower[i], lower[i]);
        bounds->upper[i] = fmaxf(bounds->upper[i], upper[i]);
    }
}

// Return the radius of a sphere that the haircut fills. The corners of the bounds are empty,
// therefore the half diagonal alone is too large.
static float apparent_radius(const struct hair_bounds* bounds)
{
    float sum = 0, max = 0;
    for (int i = 0; i < 3; ++i) {
        float half = 0.5f * (bounds->upper[i] - bounds->lower[i]);
        sum += half * half;
        max = fmaxf(max, half);
    }
    return fmaxf(0.75f * sqrtf(sum), 1.08f * max);
}

void hair_camera_frame(struct hair_scene* scene, const struct hair_bounds* bounds)
{
    float aspect = (float)scene->width / (float)scene->height;
    float half = 0.5f * glm_rad(scene->field_of_view);
    float min = aspect < 1 ? atanf(tanf(half) * aspect) : half;
    float distance = fmaxf(apparent_radius(bounds) / sinf(min), 1e-4f);
    vec3 towards = {0.45f, 0.12f, 1};
    glm_vec3_normalize(towards);
    for (int i = 0; i < 3; ++i) {
        scene->target[i] = 0.5f * (bounds->lower[i] + bounds->upper[i]);
        scene->eye[i] = scene->target[i] + distance * towards[i];
    }
    scene->framed = true;
}

float hair_camera_reach(const struct hair_scene* scene, const struct hair_bounds* bounds)
{
    float sum = 0;
    for (int i = 0; i < 3; ++i) {
        float max =
            fmaxf(bounds->upper[i] - scene->motion.pivot[i], scene->motion.pivot[i] - bounds->lower[i]);
        sum += max * max;
    }
    return fmaxf(sqrtf(sum), 1e-4f);
}

struct hair_bounds hair_camera_measure(const hair_groom_info* info, struct hair_scene* scene, float* reach)
{
    struct hair_bounds bounds;
    for (int i = 0; i < 3; ++i) {
        bounds.lower[i] = info->lower[i];
        bounds.upper[i] = info->upper[i];
        if (!scene->head && !scene->pivot_is_said)
            scene->motion.pivot[i] = 0.5f * (bounds.lower[i] + bounds.upper[i]);
    }
    // Hair swings beyond its bounds at rest.
    *reach = 1.15f * hair_camera_reach(scene, &bounds);
    return bounds;
}

static void copy_in(const float from[3], vec3 to)
{
    memcpy(to, from, 3 * sizeof(float));
}

void hair_camera_pivot(const struct hair_scene* scene, const float transform[16], float out[3])
{
    const float* p = scene->motion.pivot;
    for (int i = 0; i < 3; ++i)
        out[i] = transform[i] * p[0] + transform[4 + i] * p[1] + transform[8 + i] * p[2] + transform[12 + i];
}

// Build a view matrix. The up vector is +y, or +z if the view direction is nearly parallel to y.
static void look(vec3 eye, vec3 target, mat4 out)
{
    vec3 way, up = {0, 1, 0};
    glm_vec3_sub(target, eye, way);
    glm_vec3_normalize(way);
    if (fabsf(way[1]) > 0.999f) glm_vec3_copy((vec3){0, 0, 1}, up);
    glm_lookat(eye, target, up, out);
}

void hair_camera_matrices(const struct hair_scene* scene, const float transform[16], float reach,
                          struct hair_matrices* out)
{
    vec3 eye, target, centre;
    mat4 view, projection;
    copy_in(scene->eye, eye);
    copy_in(scene->target, target);
    hair_camera_pivot(scene, transform, centre);
    float distance = glm_vec3_distance(eye, centre);
    float nearest = fmaxf(distance - 2 * reach, 0.02f * distance + 1e-4f);
    look(eye, target, view);
    glm_perspective(glm_rad(scene->field_of_view), (float)scene->width / (float)scene->height, nearest,
                    nearest + distance + 4 * reach, projection);
    memcpy(out->view, view, sizeof view);
    memcpy(out->projection, projection, sizeof projection);
}

static void find_direction(const hair_light* light, vec3 out)
{
    copy_in(light->direction, out);
    if (glm_vec3_norm(out) < 1e-12f) out[1] = 1;
    glm_vec3_normalize(out);
}

void hair_light_direction(const struct hair_scene* scene, float out[3])
{
    vec3 to;
    find_direction(&scene->settings.light, to);
    memcpy(out, to, sizeof to);
}

static void put(mat4 view, mat4 projection, struct hair_matrices* out)
{
    memcpy(out->view, view, sizeof out->view);
    memcpy(out->projection, projection, sizeof out->projection);
}

static void look_from_afar(const hair_light* light, vec3 centre, float reach, struct hair_matrices* out)
{
    vec3 to, eye;
    mat4 view, projection;
    find_direction(light, to);
    glm_vec3_copy(centre, eye);
    glm_vec3_muladds(to, 2 * reach, eye);
    look(eye, centre, view);
    glm_ortho(-reach, reach, -reach, reach, reach, 3 * reach, projection);
    put(view, projection, out);
}

void hair_light_matrices(const struct hair_scene* scene, const float transform[16], float reach,
                         struct hair_matrices* out)
{
    vec3 centre;
    hair_camera_pivot(scene, transform, centre);
    look_from_afar(&scene->settings.light, centre, reach, out);
}

// Return the half angle that covers the whole sphere of radius `reach`. A lamp inside or close to
// the sphere gets the widest angle.
static float find_angle(float distance, float reach)
{
    const float widest = 1.3f;
    return distance * sinf(widest) > reach ? asinf(reach / distance) : widest;
}

float hair_lamp_matrices(const struct hair_scene* scene, const hair_light* lamp, const float transform[16],
                         float reach, struct hair_matrices* out)
{
    vec3 centre, eye;
    mat4 view, projection;
    hair_camera_pivot(scene, transform, centre);
    if (lamp->kind == HAIR_LIGHT_DIRECTIONAL) {
        look_from_afar(lamp, centre, reach, out);
        return 2 * reach;
    }
    copy_in(lamp->position, eye);
    if (glm_vec3_distance(eye, centre) < 1e-4f) centre[1] -= 1;
    float distance = glm_vec3_distance(eye, centre), angle = find_angle(distance, reach);
    look(eye, centre, view);
    glm_perspective(2 * angle, 1, fmaxf(distance - reach, 0.02f * reach), distance + reach, projection);
    put(view, projection, out);
    return 2 * distance * tanf(angle);
}

void hair_light_clip(const struct hair_matrices* light, float out[16])
{
    mat4 view, projection, clip;
    memcpy(view, light->view, sizeof view);
    memcpy(projection, light->projection, sizeof projection);
    glm_mat4_mul(projection, view, clip);
    memcpy(out, clip, sizeof clip);
}

void hair_light_texture(const struct hair_matrices* light, float out[16])
{
    hair_light_clip(light, out);
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 3; ++i) out[4 * column + i] = 0.5f * (out[4 * column + i] + out[4 * column + 3]);
}

// The crop maps clip-space x in [-1, 1] to x' = (x - c) / s. c is the centre of the rectangle, s is
// its fraction of the picture.
void hair_camera_crop(const float projection[16], const float at[2], const float size[2], float out[16])
{
    memcpy(out, projection, 16 * sizeof *out);
    float centre[2] = {2 * at[0] + size[0] - 1, 1 - 2 * at[1] - size[1]};
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 2; ++i)
            out[4 * column + i] =
                (projection[4 * column + i] - centre[i] * projection[4 * column + 3]) / size[i];
}
