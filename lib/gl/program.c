// program.c - compilation of shaders to programs.
#include "lib/gl/gl.h"

#include <stdio.h>
#include <string.h>

#define MAX_ROUND 2.0 // Time after which a round of asynchronous compilation begins nothing, ms.

static const char* const stage_features[] = {
#define FEATURE(name, define) define,
#include "lib/gl/passes.inl"
};

static GLenum stage_of(const char* name)
{
    static const struct {
        char suffix[6];
        GLenum stage;
    } stages[] = {{".comp", GL_COMPUTE_SHADER},      {".vert", GL_VERTEX_SHADER},
                  {".tesc", GL_TESS_CONTROL_SHADER}, {".tese", GL_TESS_EVALUATION_SHADER},
                  {".geom", GL_GEOMETRY_SHADER},     {".frag", GL_FRAGMENT_SHADER}};
    const char* dot = strrchr(name, '.');
    for (size_t i = 0; dot && i < sizeof stages / sizeof *stages; ++i)
        if (strcmp(dot, stages[i].suffix) == 0) return stages[i].stage;
    return 0;
}

// Inputs of a program, which are its stages with their full texts.
#define MAX_STAGES 5
struct recipe {
    struct hair_gl* gl;
    const struct hair_gl_shader* shader; // NULL if there is no shader of the application.
    hair_gl_pass pass; // Pass whose features are defined.
    const char* label;
    const char* captured; // Transform feedback output, or NULL.
    hair_result result; // Result of reading the stages.
    char prefix[1024];
    size_t used;
    uint32_t stages;
    struct stage {
        char name[64];
        struct hair_gl_source source;
        GLuint shader;
    } stage[MAX_STAGES];
};

static hair_result start_stage(const struct recipe* recipe, struct stage* stage, GLuint program)
{
    struct hair_gl* gl = recipe->gl;
    HAIR_ASSERT(stage_of(stage->name) && stage->source.text);
    stage->shader = gl->CreateShader(stage_of(stage->name));
    if (!stage->shader)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no shader for glsl/%s", stage->name);
    const char* text = stage->source.text;
    gl->ShaderSource(stage->shader, 1, &text, NULL);
    gl->CompileShader(stage->shader);
    gl->AttachShader(program, stage->shader);
    gl->DeleteShader(stage->shader); // The shader lives as long as it is attached.
    return HAIR_OK;
}

static hair_result check_stage(const struct recipe* recipe, const struct stage* stage)
{
    struct hair_gl* gl = recipe->gl;
    GLint done = 0;
    char message[HAIR_GL_MAX_INFO_LOG] = "";
    gl->GetShaderiv(stage->shader, GL_COMPILE_STATUS, &done);
    if (done) return HAIR_OK;
    gl->GetShaderInfoLog(stage->shader, sizeof message, NULL, message);
    return hair_gl_report_compile(gl, &stage->source, recipe->shader ? recipe->shader->label : NULL,
                                  stage->name, message);
}

static hair_result define(struct recipe* recipe, const char* name)
{
    HAIR_ASSERT(recipe->used < sizeof recipe->prefix);
    size_t left = sizeof recipe->prefix - recipe->used;
    int size = snprintf(recipe->prefix + recipe->used, left, "#define %s\n", name);
    if ((size_t)size >= left)
        return hair_fail(&recipe->gl->host, HAIR_ERROR_OPENGL, "program %s defines too much", recipe->label);
    recipe->used += (size_t)size;
    return HAIR_OK;
}

// Write the definitions that stages do not name: driver properties, features of the pass, and the
// kind of the application's shader.
static hair_result define_all(struct recipe* recipe)
{
    char threads[32];
    snprintf(threads, sizeof threads, "HAIR_GUIDE_THREADS %u", HAIR_GL_THREADS(recipe->pass));
    HAIR_TRY(define(recipe, recipe->gl->lines_level ? "HAIR_LINES_LEVEL 1" : "HAIR_LINES_LEVEL 0"));
    if (recipe->gl->subgroup) HAIR_TRY(define(recipe, "HAIR_SUBGROUP 1"));
    if (recipe->gl->long_atomics) HAIR_TRY(define(recipe, "HAIR_LONG_ATOMICS 1"));
    HAIR_TRY(define(recipe, threads));
    for (uint32_t i = 0; i < HAIR_GL_FEATURES; ++i)
        if (recipe->pass & HAIR_GL_BIT(i)) {
            char name[64];
            snprintf(name, sizeof name, "%s 1", stage_features[i]);
            HAIR_TRY(define(recipe, name));
        }
    if (!recipe->shader) return HAIR_OK;
    return define(recipe, recipe->shader->pixels ? "HAIR_USER_PIXELS 1" : "HAIR_USER_VERTICES 1");
}

// Return the name of a stage after "NAME?" if the pass has the feature NAME, otherwise NULL.
// "!NAME?" inverts the condition.
static const char* wanted_stage(const struct recipe* recipe, const char* word)
{
    const char* name = strchr(word, '?');
    if (!name) return word;
    int without = *word == '!';
    size_t length = (size_t)(name - word) - (size_t)without;
    for (uint32_t i = 0; i < HAIR_GL_FEATURES; ++i)
        if (strlen(stage_features[i]) == length && strncmp(stage_features[i], word + without, length) == 0)
            return ((recipe->pass & HAIR_GL_BIT(i)) == 0) == without ? name + 1 : NULL;
    return NULL;
}

// Read definitions and stages, as in "NAME=1 draw/patch.vert".
static hair_result read_stages(struct recipe* recipe, const char* stages)
{
    struct hair_gl* gl = recipe->gl;
    HAIR_TRY(define_all(recipe));
    for (const char* at = stages; *at && recipe->stages < MAX_STAGES;) {
        struct stage* stage = &recipe->stage[recipe->stages];
        size_t length = strcspn(at, " ");
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)length, at);
        char* value = strchr(word, '=');
        const char* wanted = value ? NULL : wanted_stage(recipe, word);
        if (value) {
            *value = ' ';
            HAIR_TRY(define(recipe, word));
        } else if (wanted) {
            snprintf(stage->name, sizeof stage->name, "%s", wanted);
            // OpenGL guarantees storage buffers to compute shaders only.
            if (stage_of(stage->name) == GL_COMPUTE_SHADER) HAIR_TRY(define(recipe, "HAIR_STORED 1"));
            HAIR_TRY(hair_gl_read_source_with(&gl->host, gl->glsl_dir, stage->name, recipe->prefix,
                                              recipe->shader ? recipe->shader->text : NULL, &stage->source));
            ++recipe->stages;
        }
        at += length + strspn(at + length, " ");
    }
    return HAIR_OK;
}

static struct hair_gl_key key_of_recipe(const struct recipe* recipe)
{
    struct hair_gl_key key = hair_gl_key_begin(recipe->gl);
    for (uint32_t i = 0; i < recipe->stages; ++i) {
        hair_gl_key_add(&key, recipe->stage[i].name);
        hair_gl_key_add(&key, recipe->stage[i].source.text);
    }
    hair_gl_key_add(&key, recipe->captured);
    return key;
}

// Give the driver everything it needs to link, and query nothing, so that it may compile in
// parallel.
static hair_result start_program(struct recipe* recipe, GLuint program)
{
    struct hair_gl* gl = recipe->gl;
    for (uint32_t i = 0; i < recipe->stages; ++i) HAIR_TRY(start_stage(recipe, &recipe->stage[i], program));
    if (recipe->captured)
        gl->TransformFeedbackVaryings(program, 1, &recipe->captured, GL_INTERLEAVED_ATTRIBS);
    if (gl->cache.put) gl->ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    gl->LinkProgram(program);
    ++gl->compiled;
    return HAIR_OK;
}

static bool is_linked(const struct hair_gl* gl, GLuint program)
{
    GLint done = 0;
    gl->GetProgramiv(program, GL_LINK_STATUS, &done);
    return done != 0;
}

// Report why a program did not link.
static hair_result tell_why(const struct recipe* recipe, GLuint program)
{
    struct hair_gl* gl = recipe->gl;
    for (uint32_t i = 0; i < recipe->stages; ++i) HAIR_TRY(check_stage(recipe, &recipe->stage[i]));
    char message[HAIR_GL_MAX_INFO_LOG] = "";
    gl->GetProgramInfoLog(program, sizeof message, NULL, message);
    return hair_gl_report_link(gl, recipe->shader ? recipe->shader->label : NULL, recipe->label, message);
}

// Start a program, or load it from the application's cache and set *kept.
static hair_result begin_program(struct recipe* recipe, struct hair_gl_key* key, int* kept, GLuint* out)
{
    struct hair_gl* gl = recipe->gl;
    GLuint program = gl->CreateProgram();
    if (!program)
        return hair_fail(&gl->host, HAIR_ERROR_OPENGL, "the driver makes no program for %s", recipe->label);
    gl->ObjectLabel(GL_PROGRAM, program, -1, recipe->label);
    if (gl->cache.get) *key = key_of_recipe(recipe);
    *kept = gl->cache.get && hair_gl_cache_load(gl, *key, program);
    hair_result result = *kept ? HAIR_OK : start_program(recipe, program);
    if (result)
        hair_gl_delete_program(gl, program);
    else
        *out = program;
    return result;
}

static hair_result make_program(struct recipe* recipe, GLuint* out)
{
    struct hair_gl* gl = recipe->gl;
    HAIR_ASSERT(recipe->stages > 0);
    struct hair_gl_key key = {0, 0};
    GLuint program = 0;
    int kept = 0;
    hair_result result = begin_program(recipe, &key, &kept, &program);
    if (!result && !kept && !is_linked(gl, program)) {
        result = tell_why(recipe, program);
        hair_gl_delete_program(gl, program);
    }
    if (result) return result;
    if (!kept) hair_gl_cache_store(gl, key, program);
    *out = program;
    return HAIR_OK;
}

// Read the stages of a program. Return NULL on an error, which is logged.
static struct recipe* open_recipe(struct hair_gl* gl, const struct hair_gl_shader* shader, hair_gl_pass pass,
                                  const char* label, const char* stages)
{
    struct recipe* recipe = hair_alloc(&gl->host, 1, sizeof *recipe);
    if (!recipe) {
        hair_fail_memory(&gl->host, "a program's text");
        return NULL;
    }
    recipe->gl = gl;
    recipe->shader = shader;
    recipe->pass = pass;
    recipe->label = label;
    recipe->result = read_stages(recipe, stages);
    if (strstr(stages, "sim/feedback.")) recipe->captured = "moved";
    return recipe;
}

static void close_recipe(struct recipe* recipe)
{
    struct hair_gl* gl = recipe->gl;
    for (uint32_t i = 0; i < recipe->stages; ++i) hair_free(&gl->host, recipe->stage[i].source.text);
    hair_free(&gl->host, recipe);
}

hair_result hair_gl_link(struct hair_gl* gl, const char* label, const char* stages, const char* captured,
                         GLuint* out)
{
    struct recipe* recipe = open_recipe(gl, NULL, 0, label, stages);
    if (!recipe) return HAIR_ERROR_MEMORY;
    recipe->captured = captured;
    hair_result result = recipe->result ? recipe->result : make_program(recipe, out);
    close_recipe(recipe);
    return result;
}

hair_result hair_gl_link_pass(struct hair_gl* gl, const struct hair_gl_shader* shader, hair_gl_pass pass,
                              GLuint* out)
{
    const struct hair_gl_program* known = hair_gl_get_or_add(gl, pass);
    if (!known) return HAIR_ERROR_MEMORY;
    struct recipe* recipe = open_recipe(gl, shader, pass, known->label, hair_gl_row_stages(pass));
    if (!recipe) return HAIR_ERROR_MEMORY;
    hair_result result = recipe->result ? recipe->result : make_program(recipe, out);
    close_recipe(recipe);
    return result;
}

// Programs compiled on demand or ahead ------------------------------------------------------------

static hair_result compile_again(struct hair_gl* gl, struct hair_gl_program* own)
{
    GLuint program = 0;
    HAIR_TRY(hair_gl_link_pass(gl, NULL, own->pass, &program));
    if (own->program) hair_gl_delete_program(gl, own->program);
    own->program = program;
    own->is_warm = false;
    return HAIR_OK;
}

// Wait for an asynchronous program and use it. If it failed to link, delete it. Compiling it again
// reports the error.
static void finish_program(struct hair_gl* gl, struct hair_gl_program* own)
{
    HAIR_ASSERT(own->begun && !own->program);
    if (is_linked(gl, own->begun)) {
        hair_gl_cache_store(gl, own->key, own->begun);
        own->program = own->begun;
    } else {
        hair_gl_delete_program(gl, own->begun);
    }
    own->begun = 0;
}

static bool needs_warm_up(const struct hair_gl* gl, const struct hair_gl_program* own)
{
    return gl->compiles_late && !own->is_warm && strstr(hair_gl_row_stages(own->pass), ".comp");
}

// Return whether this round may do more work, and count the work. Otherwise the program stays
// pending.
static bool may_work(struct hair_gl* gl)
{
    uint32_t max = gl->parallel && !gl->software ? HAIR_GL_PARALLEL_WORK : HAIR_GL_SERIAL_WORK;
    bool is_late = gl->work > 0 && hair_gl_now() - gl->round_start > MAX_ROUND;
    if (gl->work >= max || is_late) {
        ++gl->pending;
        return false;
    }
    ++gl->work;
    return true;
}

static hair_result begin_async(struct hair_gl* gl, struct hair_gl_program* own)
{
    GLuint program = 0;
    int kept = 0;
    HAIR_ASSERT(gl->async && !own->begun && !own->program);
    if (!may_work(gl)) return HAIR_OK;
    ++gl->pending; // The next round finishes or runs the program.
    struct recipe* recipe = open_recipe(gl, NULL, own->pass, own->label, hair_gl_row_stages(own->pass));
    if (!recipe) return HAIR_ERROR_MEMORY;
    hair_result result = recipe->result ? recipe->result : begin_program(recipe, &own->key, &kept, &program);
    close_recipe(recipe);
    HAIR_TRY(result);
    *(kept ? &own->program : &own->begun) = program;
    if (!kept && !gl->parallel) finish_program(gl, own);
    return own->program || own->begun ? HAIR_OK : compile_again(gl, own);
}

static hair_result look_after(struct hair_gl* gl, struct hair_gl_program* own)
{
    HAIR_ASSERT(gl->async && own->begun);
    GLint there = 0;
    gl->GetProgramiv(own->begun, GL_COMPLETION_STATUS_KHR, &there);
    gl->pending += !there;
    if (there && may_work(gl)) {
        finish_program(gl, own);
        gl->pending += own->program && needs_warm_up(gl, own);
    }
    return own->program || own->begun ? HAIR_OK : compile_again(gl, own);
}

// Advance a program that this round has not looked at.
static hair_result advance_async(struct hair_gl* gl, struct hair_gl_program* own)
{
    if (own->asked == gl->round) return HAIR_OK;
    own->asked = gl->round;
    if (own->begun) return look_after(gl, own);
    if (!own->program) return begin_async(gl, own);
    if (needs_warm_up(gl, own) && may_work(gl)) hair_gl_warm_up(gl, own);
    return HAIR_OK;
}

hair_result hair_gl_ensure_program(struct hair_gl* gl, hair_gl_pass pass)
{
    struct hair_gl_program* own = hair_gl_get_or_add(gl, pass);
    if (!own) return HAIR_ERROR_MEMORY;
    if (gl->async) return advance_async(gl, own);
    if (own->program) return HAIR_OK;
    if (own->begun) finish_program(gl, own);
    return own->program ? HAIR_OK : compile_again(gl, own);
}

hair_result hair_gl_ensure_programs(struct hair_gl* gl, hair_gl_pass first, hair_gl_pass last,
                                    hair_gl_pass wanted)
{
    HAIR_ASSERT(first <= last && last < HAIR_GL_ROWS);
    for (hair_gl_pass row = first; row <= last; ++row)
        HAIR_TRY(hair_gl_ensure_program(gl, hair_gl_add_features(row, wanted)));
    return HAIR_OK;
}

void hair_gl_begin_async(struct hair_gl* gl)
{
    HAIR_ASSERT(!gl->async);
    gl->async = 1;
    ++gl->round;
    gl->pending = gl->work = 0;
    gl->round_start = hair_gl_now();
    // Some drivers use fewer threads than the default promises.
    if (gl->round == 1 && gl->parallel && gl->max_compiler_threads) gl->max_compiler_threads(UINT32_MAX);
}

uint32_t hair_gl_end_async(struct hair_gl* gl)
{
    HAIR_ASSERT(gl->async);
    gl->async = 0;
    return gl->pending;
}

hair_result hair_gl_compile(struct hair_gl* gl)
{
    hair_result first = HAIR_OK;
    ++gl->program_generation;
    for (uint32_t i = 0; i < gl->programs; ++i) {
        if (gl->program[i]->begun) finish_program(gl, gl->program[i]);
        hair_result result = gl->program[i]->program ? compile_again(gl, gl->program[i]) : HAIR_OK;
        if (!first) first = result;
    }
    return first;
}
