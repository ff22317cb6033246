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

static hair_result compile_stage(struct hair_gl* gl, const struct hair_gl_shader* of, GLuint program,
                                 const char* name, const char* prefix)
{
    struct hair_gl_source source;
    hair_result result = hair_gl_read_source_with(&gl->host, gl->glsl_dir, name, prefix, of->text, &source);
    if (result) return result;

    GLuint shader = gl->CreateShader(stage_of(name));
    GLint  done   = 0;
    if (!shader)
        result = hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no shader for glsl/%s", name);
    else {
        const char* text = source.text;
        gl->ShaderSource(shader, 1, &text, NULL);
        gl->CompileShader(shader);
        gl->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
        if (done) {
            gl->AttachShader(program, shader);
        } else {
            char message[1024] = "";
            gl->GetShaderInfoLog(shader, sizeof message, NULL, message);
            result = report(gl, &source, of->label, name, message);
        }
        gl->DeleteShader(shader); // Lives on while it is attached.
    }
    hair_free(&gl->host, source.text);
    return result;
}

static hair_result link(struct hair_gl* gl, const struct hair_gl_shader* shader, uint32_t bits,
                        const char* label, const char* stages, const char* captured, GLuint* out)
{
    GLuint program = gl->CreateProgram();
    if (!program) return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no program for %s", label);
    hair_result result      = HAIR_OK;
    char        prefix[512] = "";
    size_t used = (size_t)snprintf(prefix, sizeof prefix, "#define HAIR_LINES_LEVEL %d\n", gl->lines_level);
    if (gl->subgroup)
        used += (size_t)snprintf(prefix + used, sizeof prefix - used, "#define HAIR_SUBGROUP 1\n");
    hair_gl_write_variant(shader, bits, prefix + used, sizeof prefix - used);
    used += strlen(prefix + used);
    for (const char* at = stages; *at && !result;) {
        char   word[64];
        size_t length = strcspn(at, " ");
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        char* value = strchr(word, '=');
        if (value) {
            *value = ' ';
            used += (size_t)snprintf(prefix + used, sizeof prefix - used, "#define %s\n", word);
            if (used >= sizeof prefix)
                result = hair_fail(&gl->host, HAIR_ERROR_OPENGL, "program %s defines too much", label);
        } else {
            result = compile_stage(gl, shader, program, word, prefix);
        }
        at += length + strspn(at + length, " ");
    }
    if (!result) {
        GLint done = 0;
        if (captured) gl->TransformFeedbackVaryings(program, 1, &captured, GL_INTERLEAVED_ATTRIBS);
        gl->LinkProgram(program);
        gl->GetProgramiv(program, GL_LINK_STATUS, &done);
        if (!done) {
            char message[512] = "";
            gl->GetProgramInfoLog(program, sizeof message, NULL, message);
            result = hair_fail(&gl->host, HAIR_ERROR_OPENGL, "%s%sprogram %s does not link: %.*s",
                               shader->text ? shader->label : "", shader->text ? ": " : "", label,
                               (int)strcspn(message, "\n"), message);
        }
    }
    if (result) {
        gl->DeleteProgram(program);
        return result;
    }
    gl->ObjectLabel(GL_PROGRAM, program, -1, label);
    *out = program;
    return HAIR_OK;
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
    hair_result result  = hair_gl_link(gl, passes[pass].label, passes[pass].stages, NULL, &program);
    if (result) return result;
    if (gl->program[pass]) gl->DeleteProgram(gl->program[pass]);
    gl->program[pass] = program;
    return HAIR_OK;
}

// Of a size that no guide may have, of what hair can do without, or one of the ways to draw it.
static int is_optional(hair_gl_pass pass)
{
    const char* stages = passes[pass].stages;
    return strstr(stages, "HAIR_GUIDE_THREADS=") || strstr(stages, "HAIR_CROWD=") ||
           strstr(stages, "HITS=") || strstr(stages, "HAIR_STYLED=") || strstr(stages, "HAIR_LISTED=") ||
           strstr(stages, "HAIR_SKINNED=") || strstr(stages, "HAIR_FLUID=") || strstr(stages, "sim/stir.") ||
           strstr(stages, "draw/strand.") || strstr(stages, "draw/depth.");
}

hair_result hair_gl_compile(struct hair_gl* gl)
{
    hair_result first = HAIR_OK;
    ++gl->made;
    for (int pass = 0; pass < HAIR_GL_PASS_COUNT; ++pass) {
        if (is_optional((hair_gl_pass)pass) && !gl->program[pass]) continue;
        hair_result result = compile_pass(gl, (hair_gl_pass)pass);
        if (!first) first = result;
    }
    return first;
}

hair_result hair_gl_need(struct hair_gl* gl, hair_gl_pass pass)
{
    return gl->program[pass] ? HAIR_OK : compile_pass(gl, pass);
}
