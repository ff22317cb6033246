// impulses.glsl - impulses of colliders on the vertices of a guide, for hair_get_contacts().
//
// The push of a collider is a displacement of a vertex beyond the one that is wanted.
// accept_impulses.glsl turns the pushes of a substep into impulses.
//
// A vertex keeps the impulses of two colliders. Those of a third count for the second.
#ifdef HAIR_IMPULSES
layout(rgba32f, binding = HAIR_IMAGE_IMPULSE) uniform imageBuffer impulse_image;

// Effect of a collider on a vertex.
struct press {
    vec4 push;   // xyz: push, m, or impulse by line density, m^2/s. w: collider from 1. 0 for none.
    vec3 normal; // Part of `push` along normals of the collider.
};

press press_one, press_two;  // Pushes of the displacement that is computed
float presser;               // Collider that pushes next, from 1
LOCAL(vec4, push_one);       // Pushes in the last displacement of vertex i
LOCAL(vec4, push_two);
LOCAL(vec3, normal_one);
LOCAL(vec3, normal_two);
LOCAL(vec4, impulse_one);    // Impulses of vertex i since the last sum
LOCAL(vec4, impulse_two);
LOCAL(vec3, thrust_one);     // Parts of the impulses along normals
LOCAL(vec3, thrust_two);
LOCAL(float, last_touch);    // Collider that vertex i touched in the last substep, from 1

void set_presser(uint k) { presser = float(k + 1u); }

void begin_pushes() { press_one = press_two = press(vec4(0.0), vec3(0.0)); }

void add_press(inout press one, inout press two, float who, vec3 push, vec3 normal)
{
    bool  is_first = one.push.w == 0.0 || one.push.w == who;
    float name     = is_first || two.push.w == 0.0 ? who : two.push.w;
    if (is_first) one = press(vec4(one.push.xyz + push, name), one.normal + normal);
    else two = press(vec4(two.push.xyz + push, name), two.normal + normal);
}

// Note a push of the collider `presser`.
void note_push(vec3 push, vec3 normal) { add_press(press_one, press_two, presser, push, normal); }

// Keep the pushes of the displacement that has been computed for vertex i.
void keep_pushes(uint i)
{
    local(push_one)   = press_one.push;
    local(push_two)   = press_two.push;
    local(normal_one) = press_one.normal;
    local(normal_two) = press_two.normal;
}

void clear_pushes(uint i)
{
    begin_pushes();
    keep_pushes(i);
}

// Add an impulse of collider `who` on vertex i, divided by line density. 0 is no collider.
void add_impulse(uint i, float who, vec3 impulse, vec3 normal)
{
    press one = press(local(impulse_one), local(thrust_one)),
          two = press(local(impulse_two), local(thrust_two));
    if (who == 0.0) return;
    add_press(one, two, who, impulse, normal);
    local(impulse_one) = one.push;
    local(impulse_two) = two.push;
    local(thrust_one)  = one.normal;
    local(thrust_two)  = two.normal;
}

void load_impulses(uint i, uint at)
{
    int texel = int(uint(HAIR_IMPULSE_TEXELS) * at);
    local(impulse_one) = imageLoad(impulse_image, texel);
    local(impulse_two) = imageLoad(impulse_image, texel + 1);
    vec4 thrust        = imageLoad(impulse_image, texel + 2);
    local(thrust_one)  = thrust.xyz;
    // Another step may have fewer colliders.
    local(last_touch)  = thrust.w <= float(params.colliders) ? thrust.w : 0.0;
    local(thrust_two)  = imageLoad(impulse_image, texel + 3).xyz;
    clear_pushes(i);
}

void store_impulses(uint i, uint at)
{
    int texel = int(uint(HAIR_IMPULSE_TEXELS) * at);
    imageStore(impulse_image, texel, local(impulse_one));
    imageStore(impulse_image, texel + 1, local(impulse_two));
    imageStore(impulse_image, texel + 2, vec4(local(thrust_one), local(last_touch)));
    imageStore(impulse_image, texel + 3, vec4(local(thrust_two), 0.0));
}
#else
void set_presser(uint k) {}
void begin_pushes() {}
void note_push(vec3 push, vec3 normal) {}
void keep_pushes(uint i) {}
void clear_pushes(uint i) {}
#endif
