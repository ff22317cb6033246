// scene_bullet.c - Shapes and objects of Bullet in a scene, from JSON.
#define _XOPEN_SOURCE 700
#include "tools/common/scene_bullet.h"
#include "tools/common/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_OBJECTS 100000u
#define MAX_PATH 4096
#define MAX_ROWS 1048576u
#define DEEPEST 8 // maximum depth of nested compounds

typedef struct hair_json place;
typedef struct hair_json_entry entry;
typedef struct hair_bullet_shape
    // First member of an object. The readers of an object's keys therefore receive its shape.
    shape;

// Allowed keys of each shape. Exactly one key of `needs` is required.
static const struct {
    const char* name;
    const char* keys;
    const char* needs;
} kinds[] = {
    [HAIR_BULLET_SPHERE] = {"sphere", "radius", NULL},
    [HAIR_BULLET_BOX] = {"box", "size", NULL},
    [HAIR_BULLET_CAPSULE] = {"capsule", "axis radius half_length", NULL},
    [HAIR_BULLET_CYLINDER] = {"cylinder", "axis radius half_length", NULL},
    [HAIR_BULLET_CONE] = {"cone", "axis radius half_length", NULL},
    [HAIR_BULLET_PLANE] = {"plane", "normal distance", NULL},
    [HAIR_BULLET_HULL] = {"hull", "points mesh", "points mesh"},
    [HAIR_BULLET_MULTI_SPHERE] = {"multi_sphere", "spheres", "spheres"},
    [HAIR_BULLET_MESH] = {"mesh", "mesh", "mesh"},
    [HAIR_BULLET_HEIGHT_FIELD] = {"height_field", "axis heights spacing", "heights"},
    [HAIR_BULLET_COMPOUND] = {"compound", "children", "children"},
};
#define KINDS (sizeof kinds / sizeof *kinds)

static bool is_among(const char* key, const char* keys)
{
    size_t length = strlen(key);
    for (const char* at = keys; at && (at = strstr(at, key)); at += length)
        if ((at == keys || at[-1] == ' ') && (at[length] == ' ' || !at[length])) return true;
    return false;
}

static bool read_kind(const place* json, const char* key, const json_t* value, void* out)
{
    char must[256] = "one of";
    const char* name = json_is_string(value) ? json_string_value(value) : "";
    for (size_t i = 0; i < KINDS; ++i) {
        if (strcmp(name, kinds[i].name) == 0) {
            ((shape*)out)->kind = (enum hair_bullet_kind)i;
            return true;
        }
        snprintf(must + strlen(must), sizeof must - strlen(must), "%s %s", i ? "," : "", kinds[i].name);
    }
    return hair_json_wrong(json, key, must);
}

static bool read_axis(const place* json, const char* key, const json_t* value, void* out)
{
    const char* name = json_is_string(value) ? json_string_value(value) : "";
    bool ok = strlen(name) == 1 && *name >= 'x' && *name <= 'z';
    if (ok) ((shape*)out)->axis = (uint32_t)(*name - 'x');
    return ok || hair_json_wrong(json, key, "\"x\", \"y\" or \"z\"");
}

// Numbers -----------------------------------------------------------------------------------------

static bool read_row(const place* json, const char* key, const json_t* row, uint32_t columns, float* out)
{
    char must[64];
    bool ok = json_array_size(row) == columns;
    for (uint32_t i = 0; i < columns && ok; ++i) {
        const json_t* number = json_array_get(row, i);
        ok = json_is_number(number) && fabs(json_number_value(number)) <= HAIR_SCENE_FAR;
        out[i] = (float)json_number_value(number);
    }
    snprintf(must, sizeof must, "%u numbers in [%.10g, %.10g]", columns, -HAIR_SCENE_FAR, HAIR_SCENE_FAR);
    return ok || hair_json_wrong(json, key, must);
}

// Read an array of arrays of numbers. `columns` 0 uses the length of the first row.
static bool read_table(const place* json, const char* key, const json_t* value, uint32_t columns,
                       uint32_t fewest, struct hair_bullet_table* out)
{
    size_t rows = json_array_size(value), each = columns;
    if (!columns) each = json_array_size(json_array_get(value, 0));
    if (rows < fewest || rows > MAX_ROWS || each < fewest || rows * each > 4 * (size_t)MAX_ROWS) {
        char must[96];
        snprintf(must, sizeof must, "an array of %u to %u arrays of numbers, at least %u each", fewest,
                 MAX_ROWS, columns ? columns : fewest);
        return hair_json_wrong(json, key, must);
    }
    *out = (struct hair_bullet_table){calloc(rows * each, sizeof(float)), (uint32_t)rows, (uint32_t)each};
    if (!out->values) return hair_json_wrong(json, key, "shorter: memory ran out");
    for (size_t i = 0; i < rows; ++i) {
        char element[64];
        snprintf(element, sizeof element, "%s[%zu]", key, i);
        if (!read_row(json, element, json_array_get(value, i), (uint32_t)each, out->values + i * each))
            return false;
    }
    return true;
}

static bool read_points(const place* json, const char* key, const json_t* value, void* out)
{
    return read_table(json, key, value, 3, 1, &((shape*)out)->points);
}

static bool read_spheres(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_bullet_table* spheres = &((shape*)out)->spheres;
    if (!read_table(json, key, value, 4, 1, spheres)) return false;
    for (uint32_t i = 0; i < spheres->rows; ++i)
        if (spheres->values[4 * i + 3] < 0) return hair_json_wrong(json, key, "without a radius below 0");
    return true;
}

static bool read_heights(const place* json, const char* key, const json_t* value, void* out)
{
    return read_table(json, key, value, 0, 2, &((shape*)out)->heights);
}

static bool read_mesh(const place* json, const char* key, const json_t* value, void* out)
{
    char path[MAX_PATH];
    return hair_json_path(json, key, value, path, sizeof path) &&
           hair_obj_read(json->tool, path, &((shape*)out)->mesh);
}

// Shapes ------------------------------------------------------------------------------------------

static bool read_children(const place* json, const char* key, const json_t* value, void* out);

_Static_assert(offsetof(struct hair_bullet_object, shape) == 0,
               "what reads an object's keys takes it for its shape");

static bool read_motion(const place* json, const char* key, const json_t* value, void* out)
{
    struct hair_scene_collider* body = &((struct hair_bullet_object*)out)->body;
    return hair_scene_read_keys(json, key, value, body->key, HAIR_SCENE_COLLIDER_KEYS, &body->key_count);
}

#define AT(member) offsetof(struct hair_bullet_object, member)
#define SHAPE                                                                                                \
    HAIR_OTHER("shape", read_kind), HAIR_OTHER("axis", read_axis),                                           \
        HAIR_NUMBERS("radius", AT(shape.radius), 1, 0, HAIR_SCENE_FAR),                                      \
        HAIR_NUMBERS("half_length", AT(shape.half_length), 1, 0, HAIR_SCENE_FAR),                            \
        HAIR_NUMBERS("size", AT(shape.size), 3, 0, HAIR_SCENE_FAR),                                          \
        HAIR_NUMBERS("normal", AT(shape.normal), 3, -1, 1),                                                  \
        HAIR_NUMBERS("distance", AT(shape.distance), 1, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),                    \
        HAIR_NUMBERS("scale", AT(shape.scale), 3, 1e-6, 1e6),                                                \
        HAIR_NUMBERS("margin", AT(shape.margin), 1, 0, HAIR_SCENE_FAR),                                      \
        HAIR_NUMBERS("spacing", AT(shape.spacing), 1, 1e-6, HAIR_SCENE_FAR),                                 \
        HAIR_OTHER("points", read_points), HAIR_OTHER("spheres", read_spheres),                              \
        HAIR_OTHER("heights", read_heights), HAIR_OTHER("mesh", read_mesh),                                  \
        HAIR_OTHER("children", read_children)

static const entry of_child[] = {
    SHAPE, HAIR_NUMBERS("position", AT(shape.position), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
    HAIR_NUMBERS("rotation", AT(shape.rotation), 4, -1, 1), HAIR_END};
static const entry of_object[] = {
    SHAPE,
    HAIR_NUMBERS("position", AT(body.collider.position), 3, -HAIR_SCENE_FAR, HAIR_SCENE_FAR),
    HAIR_NUMBERS("rotation", AT(body.collider.rotation), 4, -1, 1),
    HAIR_NUMBERS("friction", AT(body.collider.friction), 1, 0, 100),
    HAIR_NUMBERS("velocity", AT(body.velocity), 3, -1e3, 1e3),
    HAIR_NUMBERS("spin", AT(body.spin), 3, -1e5, 1e5),
    HAIR_OTHER("motion", read_motion),
    HAIR_BOOLEAN("stays", AT(body.stays)),
    HAIR_END};

// Reject keys of other shapes, and require the keys that define this shape.
static bool check_keys(const place* json, const json_t* object, const shape* own)
{
    const char *needs = kinds[own->kind].needs, *key;
    json_t* value;
    char must[128];
    uint32_t needed = 0;
    json_object_foreach((json_t*)(uintptr_t)object, key, value)
    {
        bool is_of_some = false;
        for (size_t i = 0; i < KINDS; ++i) is_of_some |= is_among(key, kinds[i].keys);
        snprintf(must, sizeof must, "left out: a %s has none", kinds[own->kind].name);
        if (is_of_some && !is_among(key, kinds[own->kind].keys)) return hair_json_wrong(json, key, must);
        needed += is_among(key, needs);
    }
    if (!needs || needed == 1) return true;
    return hair_json_wrong(json, own->kind == HAIR_BULLET_HULL ? "points" : needs,
                           own->kind == HAIR_BULLET_HULL ? "given, or else mesh" : "given");
}

static bool check_values(const place* json, const shape* own, const float rotation[4])
{
    float square = 0;
    for (int k = 0; k < 4; ++k) square += rotation[k] * rotation[k];
    if (!(fabsf(square - 1) < 1e-3f)) return hair_json_wrong(json, "rotation", "a unit quaternion to 1e-3");
    if (own->normal[0] == 0 && own->normal[1] == 0 && own->normal[2] == 0)
        return hair_json_wrong(json, "normal", "longer than 0");
    if (own->kind == HAIR_BULLET_MESH && !own->mesh.triangle_count)
        return hair_json_wrong(json, "mesh", "a file with faces");
    return true;
}

static void set_usual(shape* own)
{
    *own = (shape){.axis = 1, .radius = 0.1f, .half_length = 0.1f, .margin = -1, .spacing = 0.1f};
    own->normal[1] = own->rotation[3] = 1;
    for (int k = 0; k < 3; ++k) own->scale[k] = 1, own->size[k] = 0.1f;
}

// Read element i, which already has the defaults.
static bool read_one(const place* json, const char* key, const json_t* array, size_t i, const entry* entries,
                     shape* out, const float* rotation)
{
    char element[64], name[128];
    const json_t* value = json_array_get(array, i);
    snprintf(element, sizeof element, "%s[%zu]", key, i);
    snprintf(name, sizeof name, "%s%s.", json->place, element);
    const place inside = {json->tool, json->path, name};
    return hair_json_object(json, element, value, entries, out) && check_keys(&inside, value, out) &&
           check_values(&inside, out, rotation);
}

static bool read_children(const place* json, const char* key, const json_t* value, void* out)
{
    shape* own = out;
    size_t count = json_array_size(value), depth = 0;
    for (const char* at = json->place; (at = strstr(at, "children")); ++at) ++depth;
    if (!json_is_array(value) || count < 1 || count > MAX_OBJECTS || depth >= DEEPEST)
        return hair_json_wrong(json, key, "an array of 1 to 100000 objects, at most 8 deep");
    own->children = calloc(count, sizeof *own->children);
    if (!own->children) return hair_json_wrong(json, key, "shorter: memory ran out");
    for (size_t i = 0; i < count; ++i) {
        shape* child = &own->children[own->child_count++];
        set_usual(child);
        if (!read_one(json, key, value, i, of_child, child, child->rotation)) return false;
    }
    return true;
}

// Make the paths of all meshes absolute.
static void make_absolute(const place* json, json_t* value)
{
    char path[MAX_PATH];
    const char* name;
    json_t* member;
    size_t i;
    json_array_foreach(value, i, member)
    {
        make_absolute(json, member);
    }
    json_object_foreach(value, name, member)
    {
        if (strcmp(name, "mesh") || !json_is_string(member)) {
            make_absolute(json, member);
        } else if (hair_json_path(json, name, member, path, sizeof path)) {
            char* absolute = realpath(path, NULL);
            if (absolute) json_string_set(member, absolute);
            free(absolute);
        }
    }
}

static char* write_text(const place* json, const json_t* value)
{
    json_t* copy = json_deep_copy(value);
    make_absolute(json, copy);
    char* text = json_dumps(copy, JSON_COMPACT);
    json_decref(copy);
    return text;
}

bool hair_scene_read_bullet(const place* json, const char* key, const json_t* value,
                            struct hair_bullet_list* out)
{
    size_t count = json_array_size(value);
    if (!json_is_array(value) || count > MAX_OBJECTS)
        return hair_json_wrong(json, key, "an array of at most 100000 objects");
    out->object = calloc(count + 1, sizeof *out->object);
    if (!out->object) return hair_json_wrong(json, key, "shorter: memory ran out");
    for (size_t i = 0; i < count; ++i) {
        struct hair_bullet_object* object = &out->object[out->count++];
        object->body.collider = hair_collider_default();
        set_usual(&object->shape);
        if (!read_one(json, key, value, i, of_object, &object->shape, object->body.collider.rotation))
            return false;
    }
    if (count) out->text = write_text(json, value);
    return true;
}

static void free_shape(shape* own)
{
    for (uint32_t i = 0; i < own->child_count; ++i) free_shape(&own->children[i]);
    free(own->children);
    free(own->points.values);
    free(own->spheres.values);
    free(own->heights.values);
    hair_obj_free(&own->mesh);
}

void hair_scene_free_bullet(struct hair_bullet_list* objects)
{
    for (uint32_t i = 0; i < objects->count; ++i) free_shape(&objects->object[i].shape);
    free(objects->object);
    free(objects->text);
    memset(objects, 0, sizeof *objects);
}
