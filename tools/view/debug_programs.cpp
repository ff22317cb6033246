// debug_programs.cpp - Programs and shaders of the debug view.
#include "tools/view/debug_programs.h"
#include "tools/view/debug_guides.h"

#include <epoxy/gl.h>

namespace
{

// A triangle that covers the target.
const char cover_vertex[] = R"(
void main()
{
    gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
}
)";

// The first row of the picture is its top.
const char background_fragment[] = R"(
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform vec2 size;
layout(location = 0) out vec4 color;
void main()
{
    vec2 at = gl_FragCoord.xy / size;
    color = vec4(0.4 * texture(picture, vec2(at.x, 1 - at.y)).rgb, 1);
}
)";

const char segments_vertex[] = R"(
layout(location = 0) uniform vec2 size;
layout(location = 1) uniform float width;
layout(location = 2) uniform mat4 clip;
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 from_color;
layout(location = 2) in vec3 to;
layout(location = 3) in vec3 to_color;
layout(location = 0) out vec3 vertex_color;
void main()
{
    vec4 a = clip * vec4(from, 1), b = clip * vec4(to, 1);
    bool is_end = gl_VertexID == 1 || gl_VertexID > 3;
    float side = gl_VertexID == 0 || gl_VertexID == 1 || gl_VertexID == 5 ? 1 : -1;
    vertex_color = is_end ? to_color : from_color;
    gl_Position = vec4(2, 2, 2, 1);
    if (min(a.w, b.w) < 1e-4) return;
    vec2 along = size * (b.xy / b.w - a.xy / a.w);
    along = length(along) > 1e-6 ? normalize(along) : vec2(1, 0);
    gl_Position = is_end ? b : a;
    gl_Position.xy += side * width * vec2(-along.y, along.x) / size * gl_Position.w;
}
)";

const char segments_fragment[] = R"(
layout(location = 0) in vec3 vertex_color;
layout(location = 0) out vec4 color;
void main()
{
    color = vec4(vertex_color, 1);
}
)";

const char counts_fragment[] = R"(
layout(std430, binding = 8) readonly buffer counts { uint row, count[]; };
layout(location = 1) uniform vec3 stops[5];
layout(location = 0) out vec4 color;
void main()
{
    uint n = count[uint(gl_FragCoord.y) * row + uint(gl_FragCoord.x)];
    if (n == 0) discard;
    float at = clamp(4 * log2(float(n)) / 6, 0.0, 4.0);
    int stop = min(int(at), 3);
    color = vec4(mix(stops[stop], stops[stop + 1], at - float(stop)), 1);
}
)";

// Shaders of the library for hair_shader_create().
const char* const shaders[][2] = {
    {"paint", R"(layout(std430, binding = 8) readonly buffer view_paint { vec4 view_color[]; };
vec4 hair_shade(hair_fragment f)
{
    return vec4(view_color[f.strand].rgb * sqrt(1.0 - 0.7 * f.across * f.across), 1.0);
}
)"},
    {"mark", R"(layout(std430, binding = 8) buffer view_marks { uint view_drawn[]; };
vec4 hair_shade(hair_fragment f)
{
    view_drawn[f.strand] = 1u;
    return vec4(0.0);
}
)"},
    {"count", R"(layout(early_fragment_tests) in;
layout(std430, binding = 8) buffer view_counts { uint view_row, view_count[]; };
vec4 hair_shade(hair_fragment f)
{
    atomicAdd(view_count[uint(gl_FragCoord.y) * view_row + uint(gl_FragCoord.x)], 1u);
    return vec4(0.0);
}
)"},
};

bool add(unsigned program, unsigned kind, const char* text)
{
    const char* texts[] = {"#version 450 core\n", text};
    GLint ok = 0;
    unsigned shader = glCreateShader(kind);
    glShaderSource(shader, 2, texts, nullptr);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) glAttachShader(program, shader);
    glDeleteShader(shader);
    return ok;
}

bool make(const char* vertex, const char* fragment, unsigned& out)
{
    GLint ok = 0;
    if (out) return true;
    unsigned program = glCreateProgram();
    if (add(program, GL_VERTEX_SHADER, vertex) && add(program, GL_FRAGMENT_SHADER, fragment)) {
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &ok);
    }
    if (ok)
        out = program;
    else
        glDeleteProgram(program);
    return ok;
}

void make_vertex_array(view_debug& debug)
{
    if (debug.vertex_array) return;
    glCreateVertexArrays(1, &debug.vertex_array);
    glCreateBuffers(1, &debug.segments);
    glCreateBuffers(2, debug.storage);
    glVertexArrayVertexBuffer(debug.vertex_array, 0, debug.segments, 0, sizeof(view_debug_segment));
    glVertexArrayBindingDivisor(debug.vertex_array, 0, 1);
    for (unsigned i = 0; i < 4; ++i) {
        glEnableVertexArrayAttrib(debug.vertex_array, i);
        glVertexArrayAttribFormat(debug.vertex_array, i, 3, GL_FLOAT, GL_FALSE, 3 * i * sizeof(float));
        glVertexArrayAttribBinding(debug.vertex_array, i, 0);
    }
    float stops[5][3];
    for (int i = 0; i < 5; ++i) view_debug_color(VIEW_DEBUG_OVERDRAW, 0.25f * (float)i, stops[i]);
    glProgramUniform3fv(debug.programs[VIEW_DEBUG_COUNTS], 1, 5, stops[0]);
}

} // namespace

int view_debug_make_programs(view_debug& debug, hair_context* context)
{
    bool ok = make(cover_vertex, background_fragment, debug.programs[VIEW_DEBUG_BACKGROUND]) &&
              make(segments_vertex, segments_fragment, debug.programs[VIEW_DEBUG_SEGMENTS]) &&
              make(cover_vertex, counts_fragment, debug.programs[VIEW_DEBUG_COUNTS]);
    if (!ok) {
        hair_complain(TOOL, "the shaders of the debug view do not compile");
        return HAIR_EXIT_OPENGL;
    }
    make_vertex_array(debug);
    for (int i = 0; i < 3; ++i) {
        if (debug.shaders[i]) continue;
        hair_shader_desc desc = hair_shader_desc_default();
        desc.label = shaders[i][0];
        desc.glsl = shaders[i][1];
        desc.at = HAIR_SHADE_PIXELS;
        hair_result result = hair_shader_create(context, &desc, &debug.shaders[i]);
        if (result) return hair_exit_for(result);
    }
    return HAIR_EXIT_OK;
}
