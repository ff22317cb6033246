// torture.c - calls whose memory, objects and driver are refused at one site after the other.
#include "tests/support/torture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/glstate.h"
#include "tests/support/refusal.h"

#define PIXELS (4 * HAIR_TEST_TORTURE_SIZE * HAIR_TEST_TORTURE_SIZE)
#define BYTES (1 << 20) // Upper bound on the size of a state.
// Sites of a call and of a kind that are visited unless all are, in a context that has compiled all
// programs, and in a context that has compiled none.
#define VISITS 2
#define COLD_VISITS 1
#define MAX_LIMITS 2 // Limits of memory that are tried unless all are.
#define POINTS 4096 // Upper bound on the vertices of a kind.

// Sites that are refused.
enum kind { DRIVER, HOST, LIMIT, CACHE, FUNCTIONS, KINDS };
static const char* const kinds[KINDS] = {"driver", "host", "limit", "cache", "functions"};

#define MAX_TOLD 12 // Defects of a call that are printed.

static uint32_t all_sites, all_visits, all_failures, defects;

// The cache ---------------------------------------------------------------------------------------

#define KEPT 64

struct hair_test_torture_cache {
    struct kept {
        uint64_t key;
        unsigned char* bytes;
        size_t size;
    } kept[KEPT];
    uint32_t count, calls, refuse;
    bool is_lasting;
};

static bool cache_refuses(struct hair_test_torture_cache* cache)
{
    ++cache->calls;
    return cache->refuse &&
           (cache->is_lasting ? cache->calls >= cache->refuse : cache->calls == cache->refuse);
}

// Get an entry, or none, too many bytes, too few, or wrong ones.
static size_t get(uint64_t key, void* bytes, size_t capacity, void* user)
{
    struct hair_test_torture_cache* cache = user;
    const struct kept* kept = NULL;
    for (uint32_t i = 0; i < cache->count; ++i)
        if (cache->kept[i].key == key) kept = &cache->kept[i];
    bool is_bad = cache_refuses(cache);
    if (!kept || (is_bad && cache->calls % 4 == 0)) return 0;
    if (kept->size <= capacity) memcpy(bytes, kept->bytes, kept->size);
    if (is_bad && capacity && cache->calls % 4 == 1) ((unsigned char*)bytes)[capacity / 2] ^= 16;
    if (is_bad && cache->calls % 4 == 2) return SIZE_MAX;
    return is_bad && cache->calls % 4 == 3 ? kept->size / 2 : kept->size;
}

static void put(uint64_t key, const void* bytes, size_t size, void* user)
{
    struct hair_test_torture_cache* cache = user;
    uint32_t i = 0;
    if (cache_refuses(cache)) return;
    while (i < cache->count && cache->kept[i].key != key) ++i;
    assert_true(i < KEPT);
    cache->count += i == cache->count;
    free(cache->kept[i].bytes);
    cache->kept[i] = (struct kept){key, malloc(size), size};
    memcpy(cache->kept[i].bytes, bytes, size);
}

static void free_cache(struct hair_test_torture_cache* cache)
{
    for (uint32_t i = 0; i < cache->count; ++i) free(cache->kept[i].bytes);
    memset(cache, 0, sizeof *cache);
}

hair_result hair_test_torture_context(struct hair_test_torture* t, hair_context** out)
{
    hair_cache own = {get, put, t->cache};
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &t->test->host.host;
    desc.get_proc = hair_test_refusing_proc;
    desc.timings = true;
    desc.cache = t->is_cached ? &own : NULL;
    desc.gl_state = t->has_clobbered_state ? HAIR_GL_STATE_CLOBBER : HAIR_GL_STATE_RESTORE;
    return hair_context_create(&desc, out);
}

// Outcomes ----------------------------------------------------------------------------------------

// Everything that can be seen of an instance.
struct outcome {
    unsigned char* state;
    size_t size;
    float guides[3 * POINTS], smooth[3 * POINTS], followers[3 * POINTS], pixels[PIXELS];
    uint32_t guide_count, smooth_count, follower_count;
    uint64_t bytes;
};

static void save(const struct hair_test_torture* t, struct outcome* out)
{
    if (!out->state) out->state = malloc(BYTES);
    out->size = out->guide_count = out->smooth_count = out->follower_count = 0;
    if (!t->hair) return;
    // Reading tells the instance that it is seen, which is in the state.
    hair_test_ok(t->test,
                 hair_read_positions(t->hair, HAIR_READ_GUIDES, out->guides, POINTS, &out->guide_count));
    hair_test_ok(t->test, hair_save(t->hair, out->state, BYTES, &out->size));
}

static void read_pixels(struct hair_test_torture* t, float* pixels)
{
    if (t->format == GL_RGBA32UI)
        glReadPixels(0, 0, HAIR_TEST_TORTURE_SIZE, HAIR_TEST_TORTURE_SIZE, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                     pixels);
    else
        hair_test_frame_read(&t->frame, pixels);
}

static void observe(struct hair_test_torture* t, struct outcome* out)
{
    hair_memory memory = hair_memory_default();
    read_pixels(t, out->pixels);
    if (t->context) hair_test_ok(t->test, hair_get_memory(t->context, &memory));
    out->bytes = memory.bytes;
    save(t, out);
    if (!t->hair) return;
    hair_test_ok(t->test,
                 hair_read_positions(t->hair, HAIR_READ_SMOOTH, out->smooth, POINTS, &out->smooth_count));
    hair_test_ok(t->test, hair_read_positions(t->hair, HAIR_READ_FOLLOWERS, out->followers, POINTS,
                                              &out->follower_count));
}

static bool same_numbers(const float* a, const float* b, uint32_t count)
{
    assert_true(count <= 3 * POINTS);
    return memcmp(a, b, count * sizeof *a) == 0;
}

// Return what differs, or NULL. The state and the guides are compared in any case.
static const char* find_difference(const struct hair_test_torture* t, const struct outcome* a,
                                   const struct outcome* b, bool everything)
{
    if (a->size != b->size || memcmp(a->state, b->state, a->size)) return "the saved state";
    if (!same_numbers(a->guides, b->guides, 3 * a->guide_count)) return "the guides";
    if (!everything) return NULL;
    if (!same_numbers(a->smooth, b->smooth, 3 * a->smooth_count)) return "the smoothed guides";
    if (!same_numbers(a->followers, b->followers, 3 * a->follower_count)) return "the followers";
    if (a->bytes != b->bytes && !t->has_varying_memory) return "the memory in use";
    if (t->format == GL_RGBA32UI || t->tolerance == 0)
        return same_numbers(a->pixels, b->pixels, PIXELS) ? NULL : "the pixels";
    return hair_test_max_difference(a->pixels, b->pixels, PIXELS) <= t->tolerance ? NULL : "the pixels";
}

// Visits ------------------------------------------------------------------------------------------

struct visit {
    enum kind kind;
    bool is_lasting;
    bool may_keep; // True if the context may keep the programs that the call has compiled.
    uint32_t site; // From 1. 0 refuses nothing.
    uint64_t limit; // Limit of memory, bytes.
    uint32_t sites[KINDS]; // Sites of an undisturbed call.
};

static void arm(struct hair_test_torture* t, const struct visit* v)
{
    struct hair_test_host* host = &t->test->host;
    bool is_of_functions = v->kind == FUNCTIONS;
    hair_test_refusal.refusable = is_of_functions ? HAIR_TEST_REFUSE_FUNCTIONS : HAIR_TEST_REFUSE_ALL;
    hair_test_refusal.creations = hair_test_refusal.refused = host->allocations = t->cache->calls = 0;
    hair_test_refusal.is_lasting = t->cache->is_lasting = v->is_lasting;
    host->is_lasting = v->is_lasting;
    if (v->kind == DRIVER || is_of_functions) hair_test_refusal.refuse = v->site;
    if (v->kind == HOST) host->refuse = v->site;
    if (v->kind == CACHE) t->cache->refuse = v->site;
    if (v->kind == LIMIT) hair_test_ok(t->test, hair_set_memory_limit(t->context, v->limit));
}

static void disarm(struct hair_test_torture* t, struct visit* v)
{
    hair_test_refusal.refuse = t->test->host.refuse = t->cache->refuse = 0;
    t->test->host.is_lasting = 0;
    if (!v->site) {
        v->sites[v->kind == FUNCTIONS ? FUNCTIONS : DRIVER] = hair_test_refusal.creations;
        v->sites[HOST] = t->test->host.allocations;
        v->sites[CACHE] = t->cache->calls;
    }
    hair_test_refusal.refusable = HAIR_TEST_REFUSE_ALL;
    if (v->kind == LIMIT) hair_test_ok(t->test, hair_set_memory_limit(t->context, 0));
}

static void tell_defect(const struct hair_test_torture* t, const struct visit* v, const char* what)
{
    if (defects++ - t->defects < MAX_TOLD)
        print_error("%s, site %u of %s%s (%s): %s: %s\n                    ", t->name, v->site,
                    kinds[v->kind], v->is_lasting ? " and all later ones" : "",
                    hair_test_refusal.last ? hair_test_refusal.last : "", what, t->test->host.sentence);
}

// Check that the state of OpenGL and the error flag are untouched.
static void check_gl(const struct hair_test_torture* t, const struct visit* v,
                     const struct hair_test_glstate* before)
{
    static struct hair_test_glstate after;
    if (glGetError()) tell_defect(t, v, "the error flag is set");
    if (t->has_clobbered_state) return;
    hair_test_glstate_read(&after);
    size_t at = hair_test_glstate_differ(before, &after, 0);
    if (at < after.count) tell_defect(t, v, after.values[at].name);
}

// Make the call. Return its result.
static hair_result disturb(struct hair_test_torture* t, struct visit* v)
{
    static struct hair_test_glstate before;
    hair_test_glstate_read(&before);
    *t->test->host.sentence = 0;
    arm(t, v);
    hair_result result = t->call(t);
    disarm(t, v);
    check_gl(t, v, &before);
    if (result && !*t->test->host.sentence) tell_defect(t, v, "there is no message");
    if ((hair_test_forgive(t->test) > 0) != (result != HAIR_OK))
        tell_defect(t, v, "the log does not fit the result");
    if (result && result != HAIR_ERROR_MEMORY && result != HAIR_ERROR_OPENGL)
        tell_defect(t, v, hair_result_string(result));
    return result;
}

static void open(struct hair_test_torture* t)
{
    hair_test_frame_make(&t->frame, HAIR_TEST_TORTURE_SIZE, HAIR_TEST_TORTURE_SIZE,
                         t->format ? t->format : GL_RGBA32F, t->samples);
    if (!t->start) return;
    t->context = t->kept;
    if (!t->kept) hair_test_ok(t->test, hair_test_torture_context(t, &t->context));
    t->start(t);
    hair_test_frame_clear(&t->frame);
}

static void close(struct hair_test_torture* t, const struct visit* v)
{
    hair_memory memory = hair_memory_default();
    hair_destroy(t->hair);
    hair_shader_destroy(t->shader);
    if (t->finish) t->finish(t);
    hair_collision_mesh_destroy(t->mesh);
    if (t->context) hair_test_ok(t->test, hair_get_memory(t->context, &memory));
    if (memory.bytes) tell_defect(t, v, "memory in use remains");
    if (t->context != t->kept) hair_context_destroy(t->context);
    hair_test_frame_free(&t->frame);
    t->hair = NULL, t->shader = NULL, t->context = NULL, t->mesh = NULL;
}

// Make the call with the refusals of a visit. Return whether it has failed.
static bool visit(struct hair_test_torture* t, struct visit* v, struct outcome* expected)
{
    static struct outcome before, after;
    struct hair_test_host* host = &t->test->host;
    uint32_t blocks = host->blocks;
    size_t live = host->live;
    int32_t objects = hair_test_refusal.live;
    open(t);
    save(t, &before);
    hair_result result = disturb(t, v);
    if (!v->site && result) tell_defect(t, v, "the undisturbed call fails");
    if (result) {
        save(t, &after);
        const char* what = find_difference(t, &before, &after, false);
        if (what) tell_defect(t, v, what);
        hair_test_frame_clear(&t->frame);
        if (t->call(t) && hair_test_forgive(t->test)) tell_defect(t, v, "the repeated call fails");
    }
    observe(t, v->site ? &after : expected);
    const char* what = v->site ? find_difference(t, expected, &after, true) : NULL;
    if (what) tell_defect(t, v, what);
    if (glGetError()) tell_defect(t, v, "the error flag is set later");
    close(t, v);
    if (v->may_keep) return false;
    if (host->blocks != blocks || host->live != live) tell_defect(t, v, "memory of the host remains");
    if (hair_test_refusal.live != objects) tell_defect(t, v, "objects of OpenGL remain");
    all_visits += v->site > 0;
    all_failures += result != HAIR_OK;
    return result != HAIR_OK;
}

// Set limits of memory between those that the call has reported. Return the number of failures.
static uint32_t visit_limits(struct hair_test_torture* t, struct outcome* expected, bool is_full)
{
    uint32_t failures = 0;
    struct visit v = {.kind = LIMIT, .may_keep = true};
    visit(t, &v, expected); // Compiles all programs.
    v = (struct visit){.kind = LIMIT, .site = 1, .limit = 1};
    while (v.site <= (is_full ? 200 : MAX_LIMITS) && visit(t, &v, expected)) {
        unsigned long long more = 0, used = 0;
        const char* at = strstr(t->test->host.sentence, ": ");
        assert_true(at && sscanf(at, ": %llu more bytes than the %llu in use", &more, &used) == 2);
        assert_true(used + more > v.limit);
        v.limit = used + more;
        ++v.site;
        ++failures;
    }
    return failures;
}

// Visit `visits` evenly spread sites of every kind, once alone and once with all later ones. Return
// the number of sites.
static uint32_t sweep(struct hair_test_torture* t, struct outcome* expected, uint32_t visits)
{
    struct visit v = {.kind = DRIVER};
    uint32_t sites = 0, chosen = hair_hash((uint32_t)strlen(t->name) + 7 * (uint32_t)t->variant);
    v.may_keep = t->kept != NULL;
    if (t->is_cached || t->kept) visit(t, &v, expected); // Fills the cache, or compiles programs.
    v.may_keep = false;
    visit(t, &v, expected);
    for (v.kind = 0; v.kind < KINDS; ++v.kind) {
        if (v.kind == FUNCTIONS && !t->start) {
            v.site = 0;
            visit(t, &v, expected);
        }
        uint32_t count = v.sites[v.kind], step = (count + visits - 1) / visits;
        sites += count;
        for (int i = 0; i < 2 && step; ++i) {
            v.is_lasting = i;
            for (v.site = 1 + (chosen + (uint32_t)i * step / 2) % step; v.site <= count; v.site += step)
                visit(t, &v, expected);
        }
        v.is_lasting = false;
    }
    return sites;
}

void hair_test_torture_run(struct hair_test_torture* t)
{
    static struct outcome expected;
    static struct hair_test_torture_cache cache;
    bool is_full = getenv("HAIR_TEST_FULL") != NULL;
    uint32_t failures = all_failures, sites;
    t->cache = &cache;
    t->defects = defects;
    t->groom = hair_test_torture_groom(t->test);
    sites = sweep(t, &expected, is_full ? UINT32_MAX / 2 : COLD_VISITS);
    if (t->start) {
        hair_test_ok(t->test, hair_test_torture_context(t, &t->kept));
        if (!is_full) sweep(t, &expected, VISITS);
        sites += visit_limits(t, &expected, is_full);
        hair_context_destroy(t->kept);
        t->kept = NULL;
    }
    print_message("    %s: %u sites, %u failures\n", t->name, sites, all_failures - failures);
    all_sites += sites;
    free_cache(&cache);
    hair_groom_destroy(t->groom);
}

void hair_test_torture_tell(uint32_t min)
{
    print_message("    %u sites, %u refusals, %u failures\n", all_sites, all_visits, all_failures);
    assert_true(all_failures >= min);
    assert_int_equal(defects, 0);
}
