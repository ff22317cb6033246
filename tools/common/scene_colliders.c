// scene_colliders.c - Colliders of a scene, from JSON, and their poses over time.
#include "tools/common/scene_colliders.h"

#include <cglm/cglm.h>

#include <string.h>

typedef struct hair_json place;
typedef struct hair_json_entry entry;

#define AT(member) offsetof(struct hair_scene_collider, member)

const char* const hair_scene_shapes[HAIR_SCENE_SHAPES] = {
    "sphere", "capsule", "box", "cylinder", "cone", "plane", NULL, "ellipsoid",
};

static bool read_shape(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene_collider* collider = out;
    const char* name = json_is_string(value) ? json_string_value(value) : "";
    for (int i = 0; i < HAIR_SCENE_SHAPES; ++i)
        if (hair_scene_shapes[i] && strcmp(name, hair_scene_shapes[i]) == 0) {
            collider->collider.shape = (hair_shape)i;
            return true;
        }
    return hair_json_wrong(
        json, key, "\"sphere\", \"capsule\", \"box\", \"cylinder\", \"cone\", \"plane\" or \"ellipsoid\"");
}

bool hair_scene_read_keys(const place* json, const char* key, const json_t* value, struct hair_key* keys,
                          uint32_t max, uint32_t* count)
{
    static const entry entries[] = {
        HAIR_NUMBERS("time", offsetof(struct hair_key, time), 1, 0, HAIR_SCENE_FAR),
        HAIR_NUMBERS("rotation", offsetof(struct hair_key, rotation), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
        HAIR_NUMBERS("position", offsetof(struct hair_key, position), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
        HAIR_END};
    if (!hair_json_array(json, key, value, entries, keys, sizeof *keys, max, count)) return false;
    for (uint32_t i = 1; i < *count; ++i)
        if (keys[i].time <= keys[i - 1].time) return hair_json_wrong(json, key, "in order of time");
    return true;
}

static bool read_motion(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene_collider* collider = out;
    return hair_scene_read_keys(json, key, value, collider->key, HAIR_SCENE_COLLIDER_KEYS,
                                &collider->key_count);
}

bool hair_scene_read_colliders(const place* json, const char* key, const json_t* value,
                               struct hair_scene_collider* colliders, uint32_t max, uint32_t* count)
{
    static const entry entries[] = {
        HAIR_OTHER("shape", read_shape),
        HAIR_NUMBERS("position", AT(collider.position), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
        HAIR_NUMBERS("rotation", AT(collider.rotation), 4, -1, 1),
        HAIR_NUMBERS("radius", AT(collider.size[0]), 1, 0, HAIR_SCENE_FAR),
        HAIR_NUMBERS("half_length", AT(collider.size[1]), 1, 0, HAIR_SCENE_FAR),
        HAIR_NUMBERS("size", AT(collider.size), 3, 0, HAIR_SCENE_FAR),
        HAIR_NUMBERS("rounding", AT(collider.rounding), 1, 0, HAIR_SCENE_FAR),
        HAIR_NUMBERS("friction", AT(collider.friction), 1, 0, 100),
        HAIR_NUMBERS("velocity", AT(velocity), 3, -1e3, 1e3),
        HAIR_NUMBERS("spin", AT(spin), 3, -1e5, 1e5),
        HAIR_OTHER("motion", read_motion),
        HAIR_BOOLEAN("stays", AT(stays)),
        HAIR_END};
    for (uint32_t i = 0; i < max; ++i) {
        colliders[i] = (struct hair_scene_collider){.collider = hair_collider_default()};
        for (int k = 0; k < 3; ++k) colliders[i].collider.size[k] = 0.1f;
    }
    return hair_json_array(json, key, value, entries, colliders, sizeof *colliders, max, count);
}

void hair_collider_carry(const float transform[16], float fraction, hair_collider* collider)
{
    mat4 m;
    versor turn, none = GLM_QUAT_IDENTITY_INIT, own;
    vec3 rest = {collider->position[0], collider->position[1], collider->position[2]}, moved;
    memcpy(m, transform, sizeof m);
    glm_mat4_mulv3(m, rest, 1, moved);
    glm_vec3_lerp(rest, moved, fraction, moved);
    memcpy(collider->position, moved, sizeof collider->position);

    glm_mat4_quat(m, turn);
    glm_quat_slerp(none, turn, fraction, turn);
    memcpy(own, collider->rotation, sizeof own);
    glm_quat_mul(turn, own, own);
    glm_quat_normalize(own);
    memcpy(collider->rotation, own, sizeof own);
}

// Compute the collider at a time. It rotates about its middle by its spin and its keys, and moves
// by its velocity.
hair_collider hair_scene_collider_at(const struct hair_scene_collider* from, float time)
{
    struct hair_motion motion = {.count = from->key_count};
    hair_collider collider = from->collider;
    vec3 spin = {from->spin[0], from->spin[1], from->spin[2]};
    float angle = glm_vec3_norm(spin) * glm_rad(time), transform[16];
    if (angle != 0) {
        versor turn, own;
        memcpy(own, collider.rotation, sizeof own);
        glm_quatv(turn, angle, spin);
        glm_quat_mul(turn, own, own);
        glm_quat_normalize(own);
        memcpy(collider.rotation, own, sizeof own);
    }
    memcpy(motion.key, from->key, from->key_count * sizeof *from->key);
    memcpy(motion.pivot, collider.position, sizeof motion.pivot);
    hair_motion_at(&motion, time, transform);
    hair_collider_carry(transform, 1, &collider);
    for (int k = 0; k < 3; ++k) collider.position[k] += time * from->velocity[k];
    return collider;
}
