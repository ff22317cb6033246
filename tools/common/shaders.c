// shaders.c - GLSL of everything that a capture draws except the hair.
#include "tools/common/shaders.h"
#include "tools/common/file.h"

#include <string.h>

#include <epoxy/gl.h>

#define TEXT(x) #x
#define AT(x) "layout(location = " TEXT(x) ") uniform "
#define HEAD "#version 450 core\n"

// clang-format would merge the lines of GLSL.
// clang-format off
const char hair_whole_vert[] = HEAD
    AT(HAIR_AT_TILE) "vec4 tile;\n" // xy from the upper left, zw size, as fractions of the picture
    "layout(location = 0) out vec2 place;\n"
    "void main()\n"
    "{\n"
    "    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "    place       = tile.xy + tile.zw * vec2(0.5 + 0.5 * corner.x, 0.5 - 0.5 * corner.y);\n"
    "    gl_Position = vec4(corner, 0.0, 1.0);\n"
    "}\n";

const char hair_background_frag[] = HEAD
    AT(HAIR_AT_CENTRE) "vec3 centre;\n"
    AT(HAIR_AT_EDGE) "vec3 edge;\n"
    AT(HAIR_AT_ASPECT) "float aspect;\n"
    "layout(location = 0) in vec2 place;\n"
    "layout(location = 0) out vec4 color;\n"
    "void main()\n"
    "{\n"
    "    vec2 from = (place - vec2(0.5, 0.42)) * vec2(aspect, 1.0) / max(0.5 * aspect, 0.5);\n"
    "    color     = vec4(mix(centre, edge, smoothstep(0.0, 1.25, length(from))), 1.0);\n"
    "}\n";

const char hair_mesh_vert[] = HEAD
    AT(HAIR_AT_HEAD) "mat4 head;\n"
    AT(HAIR_AT_VIEW) "mat4 view;\n"
    AT(HAIR_AT_PROJECTION) "mat4 clip;\n"
    AT(HAIR_AT_HEIGHTS) "vec4 heights;\n" // See struct hair_head_pose.
    AT(HAIR_AT_BREATH) "vec4 breath;\n"
    "layout(location = 0) in vec3 rest_position;\n"
    "layout(location = 1) in vec3 rest_normal;\n"
    "layout(location = 2) in vec3 paint;\n"
    "layout(location = 3) in vec3 rest_surface;\n"
    "layout(location = 0) out vec3 position;\n"
    "layout(location = 1) out vec3 normal;\n"
    "layout(location = 2) out vec3 albedo;\n"
    "layout(location = 3) out vec3 surface;\n"
    "layout(location = 4) out vec3 at_rest;\n"
    "void main()\n"
    "{\n"
    "    float y     = rest_position.y;\n"
    "    float chest = 1.0 - smoothstep(heights.w, heights.z, y);\n"
    "    vec3  wide  = vec3(breath.x * rest_position.x, breath.y, breath.z * (rest_position.z - breath.w));\n"
    "    vec3  from  = rest_position + chest * wide;\n"
    "    float w     = y >= heights.x ? 1.0 : smoothstep(heights.y, heights.x, y);\n"
    "    position    = mix(from, (head * vec4(from, 1.0)).xyz, w);\n"
    "    normal      = mix(rest_normal, mat3(head) * rest_normal, w);\n"
    "    albedo      = paint;\n"
    "    surface     = rest_surface;\n"
    "    at_rest     = rest_position;\n"
    "    gl_Position = clip * (view * vec4(position, 1.0));\n"
    "}\n";

const char hair_nothing_frag[] = HEAD "void main() {}\n";

// Shader of skin, garment, eyes and small hairs. Light that enters the skin leaves it millimetres
// away, red light farthest: `wrap` softens the terminator by colour, and the shadow of the body and
// of hair is averaged over a disc that is wider for red. The disc is Vogel's spiral, rotated per
// pixel by interleaved gradient noise (Jimenez 2014). The highlight of skin has two lobes. Noise at
// the place of rest makes pores and blotches. `tone` keeps the bust darker than its paint, so that
// the hair stands out.
const char hair_scalp_motion_frag[] = HEAD
    AT(HAIR_AT_EYE) "vec3 eye;\n"
    AT(HAIR_AT_TAPS) "int taps;\n"
    AT(HAIR_AT_HAIR) "vec3 hair;\n" // reflectance of the hair at its roots
    AT(HAIR_AT_LIGHTS) "int lights;\n"
    AT(HAIR_AT_LIGHT_TO) "vec4 light_to[16];\n"
    AT(HAIR_AT_LIGHT) "vec4 light_color[16];\n"
    AT(HAIR_AT_AXIS) "vec4 light_axis[16];\n"
    AT(HAIR_AT_MORE) "vec2 light_more[16];\n"
    AT(HAIR_AT_AMBIENT) "vec3 ambient;\n"
    AT(HAIR_AT_MAP) "int light_map[16];\n"
    AT(HAIR_AT_SHADOW) "mat4 shadow[4];\n" // from world to texture coordinates and depth, times w
    AT(HAIR_AT_TEXEL) "float texel[4];\n"  // width of a texel, m
    "layout(binding = 0) uniform sampler2DShadow body_map[4];\n"
    "layout(binding = 4) uniform sampler2D opacity_map[4];\n"
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec3 albedo;\n"
    "layout(location = 3) in vec3 surface;\n" // as in struct head_mesh
    "layout(location = 4) in vec3 at_rest;\n"
    "layout(location = 0) out vec4 color;\n"
    "float random(vec3 p)\n"
    "{\n"
    "    uvec3 u = uvec3(ivec3(p));\n"
    "    uint  h = u.x * 0x8da6b343u ^ u.y * 0xd8163841u ^ u.z * 0xcb1ab31fu;\n"
    "    h       = (h ^ (h >> 15)) * 0x2c1b3c6du;\n"
    "    return float((h ^ (h >> 13)) & 0xffffu) * (1.0 / 65536.0);\n"
    "}\n"
    "float noise(vec3 p)\n" // in [0, 1], one cell per unit
    "{\n"
    "    vec3  k = floor(p), x = p - k;\n"
    "    x       = x * x * (3.0 - 2.0 * x);\n"
    "    vec4  a = vec4(random(k), random(k + vec3(1, 0, 0)), random(k + vec3(0, 1, 0)),\n"
    "                   random(k + vec3(1, 1, 0)));\n"
    "    vec4  b = vec4(random(k + vec3(0, 0, 1)), random(k + vec3(1, 0, 1)),\n"
    "                   random(k + vec3(0, 1, 1)), random(k + vec3(1, 1, 1)));\n"
    "    a       = mix(a, b, x.z);\n"
    "    a.xy    = mix(a.xz, a.yw, x.x);\n"
    "    return mix(a.x, a.y, x.y);\n"
    "}\n"
    "vec3 lit(int map, vec3 n)\n"
    "{\n"
    "    if (map < 0) return vec3(1.0);\n"
    "    float off   = 3.0 * texel[map] + 0.0012 * clamp(surface.x, 0.0, 1.0);\n"
    "    vec4  clip  = shadow[map] * vec4(position + off * n, 1.0);\n"
    "    vec3  at    = clip.xyz / max(clip.w, 1e-6);\n"
    // The map covers the reach of the hair. Nothing is known to shadow a place beyond.
    "    if (any(greaterThan(abs(at - 0.5), vec3(0.5)))) return vec3(1.0);\n"
    "    vec2  size  = 1.0 / vec2(textureSize(body_map[map], 0));\n"
    "    float turn  = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));\n"
    "    vec2  way   = vec2(cos(6.2831853 * turn), sin(6.2831853 * turn));\n"
    "    vec3  sum   = vec3(0.0), total = vec3(0.0);\n"
    // Share of the square of the disc's radius within which light of a colour leaves the skin.
    "    vec3  share = mix(vec3(0.6), vec3(0.5, 0.26, 0.18), clamp(surface.x, 0.0, 1.0));\n"
    "    for (int i = 0; i < taps; ++i) {\n"
    "        float part   = (float(i) + 0.5) / float(taps);\n"
    "        vec2  tap    = at.xy + 8.0 * sqrt(part) * size * way;\n"
    // Rotation by the golden angle.
    "        way          = mat2(-0.737369, 0.675490, -0.675490, -0.737369) * way;\n"
    "        float body   = textureLod(body_map[map], vec3(tap, at.z), 0.0);\n"
    "        vec3  weight = exp(-part / share);\n"
    "        sum         += weight * body * (1.0 - textureLod(opacity_map[map], tap, 0.0).r);\n"
    "        total       += weight;\n"
    "    }\n"
    "    return clip.w > 0.0 ? sum / total : vec3(1.0);\n"
    "}\n"
    "float lobe(float facing, float power)\n"
    "{\n"
    "    return 0.125 * (power + 2.0) * pow(facing, power);\n"
    "}\n"
// Return the colour of brows. They have more pigment than the hair of the head. Those of dyed hair
// are brown.
    "vec3 brow()\n"
    "{\n"
    "    vec3 deep = 0.5 * pow(hair, vec3(1.6));\n"
    "    deep      = mix(deep, vec3(dot(deep, vec3(0.2126, 0.7152, 0.0722))), 0.4);\n"
    "    return hair.b > 1.1 * hair.r ? vec3(0.022, 0.014, 0.010) : max(deep, vec3(0.003));\n"
    "}\n"
// Return the colour of skin from which hair grows. Hair never brightens skin.
    "vec3 stubble(vec3 skin)\n"
    "{\n"
    "    return min(skin, mix(hair, vec3(dot(hair, vec3(0.2126, 0.7152, 0.0722))), 0.4));\n"
    "}\n"
    "void main()\n"
    "{\n"
    "    const float tone = 0.56;\n"
    "    vec3  n       = normalize(normal);\n"
    "    vec3  to_eye  = normalize(eye - position);\n"
    "    bool  small   = surface.x > 0.25 && surface.x < 0.75;\n"
    "    float skin    = small ? 0.0 : clamp(surface.x, 0.0, 1.0), grown = max(surface.x - 1.0, 0.0);\n"
    "    float gloss = surface.y, open = clamp(surface.z, 0.0, 1.0);\n"
    "    bool  wet     = gloss > 2.0;\n"
    "    vec3  paint   = small ? brow() : mix(albedo, stubble(albedo), grown);\n"
    "    vec3  bumpy   = n;\n"
    "    if (skin > 0.5) {\n"
    "        float blotch = noise(190.0 * at_rest) - 0.5, grain = noise(1100.0 * at_rest) - 0.5;\n"
    "        float pores  = noise(1700.0 * at_rest) - 0.5;\n"
    "        paint       *= 1.0 + vec3(0.06, 0.13, 0.14) * blotch + 0.10 * grain;\n"
    "        bumpy        = normalize(n + 0.20 * vec3(pores, grain, -0.7 * (pores + grain)));\n"
    "    } else if (gloss < 0.1) {\n"
    "        paint       *= 0.80 + 0.4 * noise(vec3(1300.0, 700.0, 1300.0) * at_rest);\n"
    "    }\n"
    "    paint        *= tone;\n"
    "    vec3  wrap    = mix(vec3(0.05), vec3(0.40, 0.20, 0.12), skin);\n"
    "    float facing_eye = clamp(dot(n, to_eye), 0.0, 1.0);\n"
    "    float grazing = pow(1.0 - facing_eye, 5.0);\n"
    "    vec3  hidden  = pow(vec3(open), mix(vec3(1.0), vec3(0.75, 0.95, 1.0), skin));\n"
    "    float fuzz    = skin > 0.5 ? 0.04 * gloss : 0.05;\n"
    "    vec3  sum     = ambient * (0.65 + 0.35 * n.y) * hidden * (paint + fuzz * grazing);\n"
    "    for (int i = 0; i < lights; ++i) {\n"
    "        vec3  way     = light_to[i].xyz - light_to[i].w * position;\n"
    "        float square  = max(dot(way, way), 1e-8), cone, reach = square * light_more[i].y;\n"
    "        vec3  to      = way * inversesqrt(square);\n"
    "        cone          = (dot(light_axis[i].xyz, to) - light_axis[i].w) * light_more[i].x;\n"
    "        cone          = clamp(cone, 0.0, 1.0);\n"
    "        reach         = clamp(1.0 - reach * reach, 0.0, 1.0);\n"
    "        vec3  light   = light_color[i].rgb * cone * cone * reach * reach /\n"
    "                        max(square, light_color[i].w);\n"
    "        vec3  halfway = normalize(to_eye + to);\n"
    "        float facing  = dot(n, to), mirror = max(dot(bumpy, halfway), 0.0);\n"
    "        vec3  diffuse = pow(clamp((facing + wrap) / (1.0 + wrap), 0.0, 1.0), 1.0 + wrap);\n"
    "        float fresnel = 0.028 + 0.972 * pow(1.0 - max(dot(halfway, to_eye), 0.0), 5.0);\n"
    "        float shine   = wet ? lobe(mirror, 700.0) : gloss * (0.7 * lobe(mirror, 14.0) +\n"
    "                                                            0.3 * lobe(mirror, 70.0));\n"
    "        shine        *= fresnel * max(facing, 0.0);\n"
    "        light        *= smoothstep(0.0, 0.3, open) * mix(1.0, open, 0.35);\n"
    "        sum          += light * lit(light_map[i], n) *\n"
    "                        (paint * diffuse + shine);\n"
    "    }\n"
    "    color         = vec4(sum, 1.0);\n"
    "}\n";

// Tone mapping. The curve is linear up to 0.5, followed by a shoulder that approaches white
// asymptotically. The greatest and the least channel follow the curve, and the middle one keeps its
// place between them. A curve for each channel would turn bright skin and hair yellow. The sRGB
// curve (IEC 61966-2-1) follows. Noise of half a step hides bands in
// gradients.
const char hair_tone_frag[] = HEAD
    AT(HAIR_AT_SUPERSAMPLE) "int supersample;\n"
    AT(HAIR_AT_EXPOSURE) "float exposure;\n"
    AT(HAIR_AT_HEIGHT) "int height;\n" // height of the tile in pixels, because the top row is first
    "layout(binding = 0) uniform sampler2D drawn;\n"
    "layout(location = 0) out vec4 encoded;\n"
    "layout(location = 1) out vec4 linear;\n"
    "float curve(float x) { return x > 0.5 ? 1.0 - 0.5 * exp(1.0 - 2.0 * x) : x; }\n"
    "void main()\n"
    "{\n"
    "    ivec2 at  = ivec2(gl_FragCoord.xy);\n"
    "    ivec2 up  = supersample * ivec2(at.x, height - 1 - at.y);\n"
    "    vec3  sum = vec3(0.0);\n"
    "    for (int y = 0; y < supersample; ++y)\n"
    "        for (int x = 0; x < supersample; ++x) sum += texelFetch(drawn, up + ivec2(x, y), 0).rgb;\n"
    "    linear = vec4(sum / float(supersample * supersample), 1.0);\n"
    "    vec3 c = exposure * linear.rgb;\n"
    "    float high = max(max(c.r, c.g), c.b), low = min(min(c.r, c.g), c.b);\n"
    "    c      = mix(vec3(curve(low)), vec3(curve(high)), (c - low) / max(high - low, 1e-6));\n"
    "    vec3 s = 1.055 * pow(max(c, vec3(1e-9)), vec3(1.0 / 2.4)) - 0.055;\n"
    "    c      = mix(12.92 * c, s, greaterThan(c, vec3(0.0031308)));\n"
    "    uint h = uint(at.x) * 1664525u + uint(at.y) * 22695477u;\n"
    "    h      = (h ^ (h >> 15)) * 0x2c1b3c6du;\n"
    "    h      = (h ^ (h >> 12)) * 0x297a2d39u;\n"
    "    encoded = vec4(c + (float(h >> 8) / 16777216.0 - 0.5) / 255.0, 1.0);\n"
    "}\n";
// clang-format on

static GLuint compile(const char* tool, GLenum stage, const char* text)
{
    GLuint shader = glCreateShader(stage);
    GLint good;
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char reason[512] = "";
    glGetShaderInfoLog(shader, sizeof reason, NULL, reason);
    hair_complain(tool, "a shader does not compile");
    for (char* line = strtok(reason, "\n"); line; line = strtok(NULL, "\n")) hair_complain(tool, "%s", line);
    glDeleteShader(shader);
    return 0;
}

unsigned hair_shaders_link(const char* tool, const char* vert, const char* frag)
{
    GLuint vertex = compile(tool, GL_VERTEX_SHADER, vert), fragment = compile(tool, GL_FRAGMENT_SHADER, frag);
    GLuint program = glCreateProgram();
    GLint good = 0;
    if (vertex && fragment) {
        glAttachShader(program, vertex);
        glAttachShader(program, fragment);
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &good);
        if (!good) hair_complain(tool, "a program does not link");
    }
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    if (good) return program;
    glDeleteProgram(program);
    return 0;
}
