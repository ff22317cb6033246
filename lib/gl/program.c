// program.c - shaders to programs, with errors that name the file and the line.
#include "lib/gl/gl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char* const features[] = {
#define FEATURE(name, define) define,
#include "lib/gl/passes.inl"
};

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
    const struct hair_gl_shader* shader; // NULL: none of the host's
    hair_gl_pass                 pass;   // of which the features are defined
    const char*                  label;
    const char*                  captured; // NULL: nothing is
    char                         prefix[1024];
    size_t                       used;
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
        result =
            report(gl, &stage->source, recipe->shader ? recipe->shader->label : NULL, stage->name, message);
    }
    gl->DeleteShader(shader); // Lives on while it is attached.
    return result;
}

static hair_result define(struct recipe* recipe, const char* name)
{
    size_t left = sizeof recipe->prefix - recipe->used;
    int    size = snprintf(recipe->prefix + recipe->used, left, "#define %s\n", name);
    if ((size_t)size >= left)
        return hair_fail(&recipe->gl->host, HAIR_ERROR_OPENGL, "program %s defines too much", recipe->label);
    recipe->used += (size_t)size;
    return HAIR_OK;
}

static int has_feature(const struct recipe* recipe, uint32_t feature)
{
    return (int)(recipe->pass >> (HAIR_GL_ROW_BITS + 2 + feature) & 1);
}

// What no stage says: what the driver is, the features of the pass, whose shading it is.
static hair_result define_all(struct recipe* recipe)
{
    char threads[32];
    snprintf(threads, sizeof threads, "HAIR_GUIDE_THREADS %u",
             32u << ((recipe->pass & HAIR_GL_SIZES) >> HAIR_GL_ROW_BITS));
    hair_result result =
        define(recipe, recipe->gl->lines_level ? "HAIR_LINES_LEVEL 1" : "HAIR_LINES_LEVEL 0");
    if (!result && recipe->gl->subgroup) result = define(recipe, "HAIR_SUBGROUP 1");
    if (!result) result = define(recipe, threads);
    for (uint32_t i = 0; i < HAIR_GL_FEATURES && !result; ++i)
        if (has_feature(recipe, i)) {
            char name[64];
            snprintf(name, sizeof name, "%s 1", features[i]);
            result = define(recipe, name);
        }
    if (!result && recipe->shader)
        result = define(recipe, recipe->shader->pixels ? "HAIR_OWN_PIXELS 1" : "HAIR_OWN_VERTICES 1");
    return result;
}

// A stage's name after "NAME?", or NULL where the pass has not that feature; after "!NAME?", where it has.
static const char* wanted_stage(const struct recipe* recipe, const char* word)
{
    const char* name = strchr(word, '?');
    if (!name) return word;
    int    without = *word == '!';
    size_t length  = (size_t)(name - word) - (size_t)without;
    for (uint32_t i = 0; i < HAIR_GL_FEATURES; ++i)
        if (strlen(features[i]) == length && strncmp(features[i], word + without, length) == 0)
            return has_feature(recipe, i) != without ? name + 1 : NULL;
    return NULL;
}

// Definitions and stages, as in "NAME=1 draw/patch.vert".
static hair_result read_stages(struct recipe* recipe, const char* stages)
{
    struct hair_gl* gl     = recipe->gl;
    hair_result     result = define_all(recipe);
    for (const char* at = stages; *at && recipe->stages < MOST_STAGES && !result;) {
        struct stage* stage  = &recipe->stage[recipe->stages];
        size_t        length = strcspn(at, " ");
        char          word[64];
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        char*       value  = strchr(word, '=');
        const char* wanted = value ? NULL : wanted_stage(recipe, word);
        if (value) {
            *value = ' ';
            result = define(recipe, word);
        } else if (wanted) {
            snprintf(stage->name, sizeof stage->name, "%s", wanted);
            result = hair_gl_read_source_with(&gl->host, gl->glsl_dir, stage->name, recipe->prefix,
                                              recipe->shader ? recipe->shader->text : NULL, &stage->source);
            if (!result) ++recipe->stages;
        }
        at += length + strspn(at + length, " ");
    }
    return result;
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
                     recipe->shader ? recipe->shader->label : "", recipe->shader ? ": " : "", recipe->label,
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

static hair_result link(struct hair_gl* gl, const struct hair_gl_shader* shader, hair_gl_pass pass,
                        const char* label, const char* stages, const char* captured, GLuint* out)
{
    struct recipe* recipe = hair_alloc(&gl->host, 1, sizeof *recipe);
    if (!recipe) return hair_fail_memory(&gl->host, "a program's text");
    recipe->gl         = gl;
    recipe->shader     = shader;
    recipe->pass       = pass;
    recipe->label      = label;
    recipe->captured   = captured;
    hair_result result = read_stages(recipe, stages);
    if (!result) result = make(recipe, out);
    for (uint32_t i = 0; i < recipe->stages; ++i) hair_free(&gl->host, recipe->stage[i].source.text);
    hair_free(&gl->host, recipe);
    return result;
}

hair_result hair_gl_link(struct hair_gl* gl, const char* label, const char* stages, const char* captured,
                         GLuint* out)
{
    return link(gl, NULL, 0, label, stages, captured, out);
}

hair_result hair_gl_link_pass(struct hair_gl* gl, const struct hair_gl_shader* shader, hair_gl_pass pass,
                              GLuint* out)
{
    const struct hair_gl_program* known  = hair_gl_know(gl, pass);
    const char*                   stages = hair_gl_row_stages(pass);
    if (!known) return HAIR_ERROR_MEMORY;
    return link(gl, shader, pass, known->label, stages, strstr(stages, "sim/feedback.") ? "moved" : NULL,
                out);
}

static hair_result compile_again(struct hair_gl* gl, struct hair_gl_program* own)
{
    GLuint      program = 0;
    hair_result result  = hair_gl_link_pass(gl, NULL, own->pass, &program);
    if (result) return result;
    if (own->program) gl->DeleteProgram(own->program);
    own->program = program;
    return HAIR_OK;
}

hair_result hair_gl_need(struct hair_gl* gl, hair_gl_pass pass)
{
    struct hair_gl_program* own = hair_gl_know(gl, pass);
    if (!own) return HAIR_ERROR_MEMORY;
    return own->program ? HAIR_OK : compile_again(gl, own);
}

hair_result hair_gl_compile(struct hair_gl* gl)
{
    hair_result first = HAIR_OK;
    ++gl->made;
    for (uint32_t i = 0; i < gl->programs; ++i) {
        hair_result result = gl->program[i]->program ? compile_again(gl, gl->program[i]) : HAIR_OK;
        if (!first) first = result;
    }
    return first;
}
