// program.c - shaders to programs, with errors that name the file and the line.
#include "lib/gl/gl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char* label;
    const char* stages;
} passes[] = {
#define PASS(name, label, stages) {label, stages},
#include "lib/gl/passes.inl"
#undef PASS
};

const char* hair_gl_pass_label(hair_gl_pass pass)
{
    return passes[pass].label;
}

static GLenum stage_of(const char* name)
{
    static const struct {
        char   suffix[6];
        GLenum stage;
    } stages[]      = {{".comp", GL_COMPUTE_SHADER},      {".vert", GL_VERTEX_SHADER},
                       {".tesc", GL_TESS_CONTROL_SHADER}, {".tese", GL_TESS_EVALUATION_SHADER},
                       {".geom", GL_GEOMETRY_SHADER},     {".frag", GL_FRAGMENT_SHADER}};
    const char* dot = strrchr(name, '.');
    for (size_t i = 0; dot && i < sizeof stages / sizeof *stages; ++i)
        if (strcmp(dot, stages[i].suffix) == 0) return stages[i].stage;
    return 0;
}

// Drivers begin a message with the number of the file: "2:50(7): error" (Mesa) or "2(50) : error" (NVIDIA). What the host
// has written is told by its own name and lines, in the one sentence of the call that it fails.
static hair_result report(struct hair_gl* gl, const struct hair_gl_source* source, const char* own,
                          const char* name, const char* message)
{
    char        where[128] = "", *rest = NULL;
    const char* at    = strncmp(message, "ERROR: ", 7) == 0 ? message + 7 : message;
    long        file  = strtol(at, &rest, 10);
    int         whose = 0; // the host's
    if (own && file == HAIR_GL_MAX_SOURCES)
        file = 0; // See source.c.
    else
        whose = own && file == 0;
    if (rest != at && (*rest == ':' || *rest == '(') && file >= 0 && file < (long)source->files) {
        char* after = NULL;
        long  line  = strtol(rest + 1, &after, 10);
        while (*after && strchr("(): 0123456789", *after)) ++after;
        snprintf(where, sizeof where, whose ? "%.0s%ld: " : "glsl/%s:%ld: ", source->file[file], line);
        at = after;
    } else {
        snprintf(where, sizeof where, "glsl/%s: ", source->file[0]);
        at    = message;
        whose = 0;
    }
    int length = (int)strcspn(at, "\n");
    if (own)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s:%s%s%.*s", own, whose ? "" : " ", where, length,
                         at);
    hair_log(&gl->host, HAIR_LOG_ERROR, "%s%.*s", where, length, at);
    return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "shader glsl/%s does not compile", name);
}

// A program to be: what its stages are, each with its whole text.
#define MOST_STAGES 5
struct recipe {
    struct hair_gl*              gl;
    const struct hair_gl_shader* of;
    const char*                  label;
    const char*                  captured; // NULL: nothing is
    uint32_t                     stages;
    struct stage {
        char                  name[64];
        struct hair_gl_source source;
    } stage[MOST_STAGES];
};

static hair_result compile_stage(const struct recipe* recipe, const struct stage* stage, GLuint program)
{
    struct hair_gl* gl     = recipe->gl;
    hair_result     result = HAIR_OK;
    GLuint          shader = gl->CreateShader(stage_of(stage->name));
    GLint           done   = 0;
    if (!shader)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no shader for glsl/%s", stage->name);
    const char* text = stage->source.text;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done) {
        gl->AttachShader(program, shader);
    } else {
        char message[1024] = "";
        gl->GetShaderInfoLog(shader, sizeof message, NULL, message);
        result = report(gl, &stage->source, recipe->of->label, stage->name, message);
    }
    gl->DeleteShader(shader); // Lives on while it is attached.
    return result;
}

// Stages and definitions, as in "NAME=1 draw/patch.vert".
static hair_result read_stages(struct recipe* recipe, uint32_t bits, const char* stages)
{
    struct hair_gl* gl          = recipe->gl;
    char            prefix[512] = "";
    size_t used = (size_t)snprintf(prefix, sizeof prefix, "#define HAIR_LINES_LEVEL %d\n", gl->lines_level);
    if (gl->subgroup)
        used += (size_t)snprintf(prefix + used, sizeof prefix - used, "#define HAIR_SUBGROUP 1\n");
    hair_gl_write_variant(recipe->of, bits, prefix + used, sizeof prefix - used);
    used += strlen(prefix + used);
    for (const char* at = stages; *at && recipe->stages < MOST_STAGES;) {
        struct stage* stage  = &recipe->stage[recipe->stages];
        size_t        length = strcspn(at, " ");
        snprintf(stage->name, sizeof stage->name, "%.*s", (int)length, at);
        char* value = strchr(stage->name, '=');
        if (value) {
            *value = ' ';
            used += (size_t)snprintf(prefix + used, sizeof prefix - used, "#define %s\n", stage->name);
            if (used >= sizeof prefix)
                return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "program %s defines too much", recipe->label);
        } else {
            hair_result result = hair_gl_read_source_with(&gl->host, gl->glsl_dir, stage->name, prefix,
                                                          recipe->of->text, &stage->source);
            if (result) return result;
            ++recipe->stages;
        }
        at += length + strspn(at + length, " ");
    }
    return HAIR_OK;
}

static struct hair_gl_key key_of(const struct recipe* recipe)
{
    struct hair_gl_key key = hair_gl_key_begin(recipe->gl);
    for (uint32_t i = 0; i < recipe->stages; ++i) {
        hair_gl_key_add(&key, recipe->stage[i].name);
        hair_gl_key_add(&key, recipe->stage[i].source.text);
    }
    hair_gl_key_add(&key, recipe->captured);
    return key;
}

static hair_result compile(const struct recipe* recipe, GLuint program)
{
    struct hair_gl* gl     = recipe->gl;
    hair_result     result = HAIR_OK;
    GLint           done   = 0;
    for (uint32_t i = 0; i < recipe->stages && !result; ++i)
        result = compile_stage(recipe, &recipe->stage[i], program);
    if (result) return result;
    if (recipe->captured)
        gl->TransformFeedbackVaryings(program, 1, &recipe->captured, GL_INTERLEAVED_ATTRIBS);
    if (gl->cache.put) gl->ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &done);
    if (done) return HAIR_OK;
    char message[512] = "";
    gl->GetProgramInfoLog(program, sizeof message, NULL, message);
    return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s%sprogram %s does not link: %.*s",
                     recipe->of->text ? recipe->of->label : "", recipe->of->text ? ": " : "", recipe->label,
                     (int)strcspn(message, "\n"), message);
}

static hair_result make(const struct recipe* recipe, GLuint* out)
{
    struct hair_gl*    gl      = recipe->gl;
    struct hair_gl_key key     = {0, 0};
    GLuint             program = gl->CreateProgram();
    if (!program)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no program for %s", recipe->label);
    if (gl->cache.get) key = key_of(recipe);
    if (!gl->cache.get || !hair_gl_cached(gl, key, program)) {
        hair_result result = compile(recipe, program);
        if (result) {
            gl->DeleteProgram(program);
            return result;
        }
        hair_gl_keep(gl, key, program);
    }
    gl->ObjectLabel(GL_PROGRAM, program, -1, recipe->label);
    *out = program;
    return HAIR_OK;
}

static hair_result link(struct hair_gl* gl, const struct hair_gl_shader* shader, uint32_t bits,
                        const char* label, const char* stages, const char* captured, GLuint* out)
{
    struct recipe* recipe = hair_alloc(&gl->host, 1, sizeof *recipe);
    if (!recipe) return hair_fail_memory(&gl->host, "a program's text");
    recipe->gl         = gl;
    recipe->of         = shader;
    recipe->label      = label;
    recipe->captured   = captured;
    hair_result result = read_stages(recipe, bits, stages);
    if (!result) result = make(recipe, out);
    for (uint32_t i = 0; i < recipe->stages; ++i) hair_free(&gl->host, recipe->stage[i].source.text);
    hair_free(&gl->host, recipe);
    return result;
}

hair_result hair_gl_link(struct hair_gl* gl, const char* label, const char* stages, const char* captured,
                         GLuint* out)
{
    return link(gl, &gl->ours, 0, label, stages, captured, out);
}

hair_result hair_gl_link_variant(struct hair_gl* gl, const struct hair_gl_shader* shader, uint32_t bits,
                                 hair_gl_pass pass, GLuint* out)
{
    return link(gl, shader, bits, passes[pass].label, passes[pass].stages, NULL, out);
}

static hair_result compile_pass(struct hair_gl* gl, hair_gl_pass pass)
{
    GLuint      program = 0;
    const char* stages  = passes[pass].stages;
    hair_result result  = hair_gl_link(gl, passes[pass].label, stages,
                                      strstr(stages, "sim/feedback.") ? "moved" : NULL, &program);
    if (result) return result;
    if (gl->program[pass]) gl->DeleteProgram(gl->program[pass]);
    gl->program[pass] = program;
    return HAIR_OK;
}

hair_result hair_gl_need(struct hair_gl* gl, hair_gl_pass pass)
{
    return gl->program[pass] ? HAIR_OK : compile_pass(gl, pass);
}

hair_result hair_gl_compile(struct hair_gl* gl)
{
    hair_result first = HAIR_OK;
    ++gl->made;
    for (int pass = 0; pass < HAIR_GL_PASS_COUNT; ++pass) {
        hair_result result = gl->program[pass] ? compile_pass(gl, (hair_gl_pass)pass) : HAIR_OK;
        if (!first) first = result;
    }
    return first;
}
