// bench.c - hair-bench, measurements of the library against known results, as rows.
#define _POSIX_C_SOURCE 200809L
#include "tools/bench/bench.h"
#include "tools/common/file.h"
#include "tools/common/stats.h"

#include <epoxy/gl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted;

static void interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

static void catch_signals(void)
{
    struct sigaction action = {0};
    action.sa_handler = interrupt;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    action.sa_handler = SIG_IGN; // A failed write reports a reader that went away.
    sigaction(SIGPIPE, &action, NULL);
}

bool bench_was_interrupted(void)
{
    return interrupted;
}

// Keep the last message for bench_refuse(). Suites provoke too many messages to print each.
static void keep_log(hair_log_level level, const char* sentence, void* user)
{
    struct bench* bench = user;
    if (level != HAIR_LOG_INFO) snprintf(bench->sentence, sizeof bench->sentence, "%s", sentence);
    if (bench->options.verbose) hair_complain(BENCH_TOOL, "%s", sentence);
}

// Rows --------------------------------------------------------------------------------------------

static void note_case(struct bench* bench, const char* name)
{
    size_t length = strlen(bench->cases), size = strlen(name);
    for (const char* at = bench->cases; (at = strstr(at, name)); at += size)
        if ((at == bench->cases || at[-1] == ' ') && (!at[size] || at[size] == ',')) return;
    snprintf(bench->cases + length, sizeof bench->cases - length, "%s%s", length ? ", " : "", name);
}

static void show_progress(const struct bench* bench, const char* name, const char* method)
{
    if (bench->options.quiet || !isatty(STDERR_FILENO)) return;
    double elapsed = 1e-3 * (hair_now() - bench->started);
    fprintf(stderr, "\r\033[K%s: %u of %u, ", BENCH_TOOL, bench->done, bench->planned);
    if (bench->done) fprintf(stderr, "%.0f s left, ", elapsed / bench->done * (bench->planned - bench->done));
    fprintf(stderr, "%s %s", name, method);
}

// Compare a name with the requested one. A trailing * matches any end.
static bool is_wanted(const char* wanted, const char* name)
{
    size_t length = wanted ? strlen(wanted) : 0;
    if (length == 0) return !wanted;
    return wanted[length - 1] == '*' ? !strncmp(wanted, name, length - 1) : !strcmp(wanted, name);
}

bool bench_begin(struct bench* bench, const char* name, const char* method)
{
    const struct bench_options* options = &bench->options;
    if (bench->planning) note_case(bench, name);
    if (!is_wanted(options->only_case, name)) return false;
    if (options->only_method && strcmp(options->only_method, method)) return false;
    if (bench->planning) ++bench->planned;
    if (bench->planning || interrupted) return false;
    show_progress(bench, name, method);
    ++bench->done;
    return true;
}

void bench_refuse(struct bench* bench, const char* name, const char* method)
{
    if (bench_was_interrupted() || !strcmp(bench->sentence, bench->refused)) return;
    memcpy(bench->refused, bench->sentence, sizeof bench->refused);
    hair_complain(BENCH_TOOL, "%s, %s: no row: %s", name, method, bench->sentence);
}

// Main program ------------------------------------------------------------------------------------

static bool is_software(const char* renderer)
{
    static const char* const names[] = {"llvmpipe", "softpipe", "SWR", "SwiftShader"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (strstr(renderer, names[i])) return true;
    return false;
}

static int make_opengl(struct bench* bench)
{
    bench->host = (hair_host){NULL, NULL, hair_print_log, (void*)(uintptr_t)BENCH_TOOL};
    if (!strcmp(bench->options.suite->name, "startup")) { // Drivers keep no programs on the disk.
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
        setenv("__GL_SHADER_DISK_CACHE", "0", 1);
    }
    hair_result result = hair_egl_create(&bench->host, bench->options.device, &bench->egl);
    if (result) return hair_exit_for(result);
    bench->renderer = (const char*)glGetString(GL_RENDERER);
    bench->software = is_software(bench->renderer);
    bench->host = (hair_host){NULL, NULL, keep_log, bench};
    hair_context_desc desc = hair_context_desc_default();
    desc.host = &bench->host;
    desc.get_proc = hair_egl_get_proc;
    desc.timings = !bench->software;
    result = hair_context_create(&desc, &bench->context);
    if (result) hair_complain(BENCH_TOOL, "%s", bench->sentence);
    return hair_exit_for(result);
}

static int plan(struct bench* bench)
{
    const struct bench_options* options = &bench->options;
    bench->planning = true;
    options->suite->run(bench);
    bench->planning = false;
    if (bench->planned) return HAIR_EXIT_OK;
    hair_complain(BENCH_TOOL, "%s has nothing of that case and method; its cases%s are %s",
                  options->suite->name, options->quick ? " under --quick" : "", bench->cases);
    return HAIR_EXIT_USAGE;
}

// Find the processor's name as Linux reports it. The name is empty on other systems.
static void name_processor(char* name, int size)
{
    char line[256];
    FILE* file = fopen("/proc/cpuinfo", "r");
    name[0] = 0;
    while (file && !name[0] && fgets(line, sizeof line, file)) {
        const char* value = strncmp(line, "model name", 10) ? NULL : strchr(line, ':');
        if (value) snprintf(name, (size_t)size, "%.*s", (int)strcspn(value + 2, "\n"), value + 2);
    }
    if (file) fclose(file);
}

static void write_json(const struct bench* bench, FILE* file)
{
    char version[32], processor[128];
    uint32_t number = hair_version();
    snprintf(version, sizeof version, "%u.%u.%u", number / 10000, number / 100 % 100, number % 100);
    name_processor(processor, sizeof processor);
    struct bench_about about = {.suite = bench->options.suite->name,
                                .version = version,
                                .renderer = bench->renderer,
                                .processor = processor,
                                .cores = sysconf(_SC_NPROCESSORS_ONLN),
                                .seconds = 1e-3 * (hair_now() - bench->started)};
    bench_write_json(&bench->rows, &about, file);
}

static void write_csv(const struct bench* bench, FILE* file)
{
    bench_write_csv(&bench->rows, file);
}

// An output file of the tool. It is opened before the measurements, so that an error appears early.
struct target {
    const char* path;
    void (*write)(const struct bench* bench, FILE* file);
    struct hair_output output;
};

static bool open_targets(struct target targets[2])
{
    for (int i = 0; i < 2; ++i)
        if (targets[i].path && !hair_output_open(BENCH_TOOL, targets[i].path, &targets[i].output)) {
            if (i && targets[0].path) hair_output_discard(&targets[0].output);
            return false;
        }
    return true;
}

static bool close_targets(const struct bench* bench, struct target targets[2], bool commit)
{
    bool ok = true;
    for (int i = 0; i < 2; ++i) {
        if (!targets[i].path) continue;
        if (commit) targets[i].write(bench, targets[i].output.file);
        if (!commit) hair_output_discard(&targets[i].output);
        if (commit && !hair_output_commit(&targets[i].output)) ok = false;
    }
    return ok;
}

static int measure(struct bench* bench)
{
    const struct bench_options* options = &bench->options;
    bench->started = hair_now();
    options->suite->run(bench);
    if (!options->quiet && isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
    if (interrupted) {
        hair_complain(BENCH_TOOL, "interrupted after %u of %u", bench->done, bench->planned);
        return HAIR_EXIT_RUNTIME;
    }
    if (json_array_size(bench->rows.rows)) return HAIR_EXIT_OK;
    hair_complain(BENCH_TOOL, "not one row could be made");
    return HAIR_EXIT_RUNTIME;
}

static int print_table(const struct bench* bench)
{
    const struct bench_options* options = &bench->options;
    if ((options->json && !strcmp(options->json, "-")) || (options->csv && !strcmp(options->csv, "-")))
        return HAIR_EXIT_OK;
    bench_write_table(&bench->rows, stdout);
    return hair_flush(BENCH_TOOL);
}

static int run(struct bench* bench)
{
    const struct bench_options* options = &bench->options;
    struct target targets[2] = {{options->json, write_json, {0}}, {options->csv, write_csv, {0}}};
    bench_rows_create(&bench->rows, options->suite->columns);
    int code = plan(bench);
    if (!code) code = make_opengl(bench);
    if (code) return code;
    if (!open_targets(targets)) return HAIR_EXIT_RUNTIME;
    code = measure(bench);
    if (!close_targets(bench, targets, !code)) code = HAIR_EXIT_RUNTIME;
    return code ? code : print_table(bench);
}

int main(int count, char** arguments)
{
    struct bench* bench = calloc(1, sizeof *bench);
    if (!bench) {
        hair_complain(BENCH_TOOL, "out of memory");
        return HAIR_EXIT_RUNTIME;
    }
    catch_signals();
    int code = bench_parse(count, arguments, &bench->options);
    if (code < 0) code = run(bench);
    hair_context_destroy(bench->context);
    hair_egl_destroy(bench->egl);
    bench_rows_free(&bench->rows);
    free(bench);
    return code;
}
