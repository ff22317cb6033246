// groom.c - hair-groom, which describes haircuts, converts them between formats, and makes the
// built-in ones.
#define _GNU_SOURCE
#include "tools/common/file.h"
#include "tools/common/groom_options.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>

#define TOOL "hair-groom"
#define MAX_BYTES ((size_t)4 << 30)

static const hair_host host = {NULL, NULL, hair_print_log, TOOL};

// Reading and writing -----------------------------------------------------------------------------

static int read_asset(const char* path, const struct hair_groom_options* options, hair_asset** out)
{
    struct hair_bytes bytes;
    if (!hair_file_read_haircut(TOOL, path, MAX_BYTES, &bytes)) return HAIR_EXIT_INPUT;
    hair_host named = {NULL, NULL, hair_print_log, (void*)hair_log_name(TOOL, path)};
    hair_asset_desc desc = hair_asset_desc_default();
    desc.host = &named;
    desc.import = &options->import;
    hair_result result = hair_asset_read(&desc, bytes.data, bytes.size, out);
    free(bytes.data);
    return hair_exit_for(result);
}

// Find the format by the end of a name. A name without an end is taken for .hair.
static bool find_format(const char* path, hair_format* out)
{
    const char *slash = strrchr(path, '/'), *end = strrchr(slash ? slash : path, '.');
    bool is_tfx = end && !strcasecmp(end, ".tfx"), is_groom = end && !strcasecmp(end, ".groom");
    bool is_hair = !end || !strcasecmp(end, ".hair");
    *out = is_tfx ? HAIR_FORMAT_TFX4 : is_groom ? HAIR_FORMAT_GROOM : HAIR_FORMAT_HAIR;
    if (!is_tfx && !is_groom && !is_hair)
        hair_complain(TOOL, "%s ends in none of .groom, .hair and .tfx: --format names the format", path);
    return is_tfx || is_groom || is_hair;
}

static int write_bytes(const char* path, const void* bytes, size_t size)
{
    struct hair_output output;
    if (!hair_output_open(TOOL, path, &output)) return HAIR_EXIT_RUNTIME;
    fwrite(bytes, 1, size, output.file); // hair_output_commit() reports a failed write.
    return hair_output_commit(&output) ? HAIR_EXIT_OK : HAIR_EXIT_RUNTIME;
}

// Say that a file is written without something that the haircut has.
static void report_lost(const char* path, hair_format format, const char* what)
{
    const char* end = format == HAIR_FORMAT_TFX4 ? ".tfx" : ".hair";
    hair_complain(TOOL, "%s is written without the %s, which %s files do not hold", path, what, end);
}

static void report_lost_attributes(const char* path, hair_format format, const hair_asset_info* info)
{
    char what[64];
    for (uint32_t i = 0; i < info->strand_attribute_count; ++i) {
        const hair_strand_attribute* attribute = &info->strand_attributes[i];
        const char* name = hair_strand_attribute_name(attribute->kind);
        snprintf(what, sizeof what, "attribute %s of strands", name);
        if (attribute->strand_values) report_lost(path, format, what);
        snprintf(what, sizeof what, "map of the attribute %s", name);
        if (attribute->map.source) report_lost(path, format, what);
    }
    for (uint32_t i = 0; i < 4 && info->map_sets[i]; ++i) {
        snprintf(what, sizeof what, "map set %u", i);
        report_lost(path, format, what);
    }
}

// Say what a file that is not .groom does not hold, a sentence for each.
static void report_losses(const char* path, hair_format format, const hair_asset* asset)
{
    hair_asset_info info = hair_asset_info_default();
    if (format == HAIR_FORMAT_GROOM || hair_asset_describe(asset, &info)) return;
    bool is_tfx = format == HAIR_FORMAT_TFX4;
    const struct {
        bool is_lost;
        const char* what;
    } losses[] = {
        {info.strand_groups, "groups of strands"},
        {info.strand_guides, "choice of guides"},
        {is_tfx && info.strand_radii, "radii of strands"},
        {info.scalp_positions, "scalp"},
        {info.scalp_density, "density on the scalp"},
        {info.scalp_uvs, "texture coordinates of the scalp"},
        {info.scalp_joints, "joints of the scalp"},
    };
    for (size_t i = 0; i < sizeof losses / sizeof *losses; ++i)
        if (losses[i].is_lost) report_lost(path, format, losses[i].what);
    report_lost_attributes(path, format, &info);
    if (is_tfx && info.strand_set == HAIR_STRAND_SET_FULL)
        hair_complain(TOOL, "all strands of %s become guides, because .tfx files hold guides", path);
    if (!is_tfx && info.strand_set == HAIR_STRAND_SET_GUIDES)
        hair_complain(TOOL, "guides become all strands of %s, because .hair files hold full hair", path);
}

static int write_asset(const hair_asset* asset, const struct hair_groom_options* options)
{
    const char* path = options->operand[1];
    hair_format format = options->format;
    if (!format && !find_format(path, &format)) return hair_groom_misuse();
    size_t size = 0;
    hair_result result = hair_asset_write(asset, format, NULL, 0, &size);
    if (result == HAIR_ERROR_ARGUMENT && format == HAIR_FORMAT_TFX4)
        hair_complain(TOOL, "%s was not written: give --vertices 4, 8, 16, 32 or 64", path);
    if (result) return hair_exit_for(result);

    void* bytes = malloc(size);
    if (!bytes) {
        hair_complain(TOOL, "out of memory for the %zu bytes of %s", size, path);
        return HAIR_EXIT_RUNTIME;
    }
    result = hair_asset_write(asset, format, bytes, size, &size);
    int code = result ? hair_exit_for(result) : write_bytes(path, bytes, size);
    free(bytes);
    if (!code) report_losses(path, format, asset);
    return code;
}

// Commands ----------------------------------------------------------------------------------------

static void print_repairs(const hair_import_stats* repairs)
{
    const struct {
        uint32_t count;
        const char* one;
        const char* many;
        const char* what;
    } lines[] = {
        {repairs->dropped_single, "strand", "strands", "of fewer than two vertices dropped"},
        {repairs->dropped_short, "strand", "strands", "shorter than 10 micrometres dropped"},
        {repairs->removed_nonfinite, "vertex", "vertices", "not finite or too far away removed"},
        {repairs->removed_repeated, "vertex", "vertices", "repeated removed"},
        {repairs->resampled, "strand", "strands", "of more than 256 vertices brought down to 256"},
    };
    bool any = false;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
        if (!lines[i].count) continue;
        printf("%-10s %u %s %s\n", any ? "" : "repairs:", lines[i].count,
               lines[i].count == 1 ? lines[i].one : lines[i].many, lines[i].what);
        any = true;
    }
    if (!any) printf("%-10s nothing repaired\n", "repairs:");
}

static void print_scalp(const hair_asset_info* info)
{
    if (!info->scalp_positions) {
        printf("%-10s none\n", "scalp:");
        return;
    }
    printf("%-10s %u vertices, %u triangles%s%s", "scalp:", info->scalp_vertex_count,
           info->scalp_triangle_count, info->scalp_density ? ", density" : "",
           info->scalp_uvs ? ", texture coordinates" : "");
    uint32_t sets = 0;
    while (sets < 4 && info->map_sets[sets]) ++sets;
    if (sets) printf(", %u map set%s", sets, sets == 1 ? "" : "s");
    if (info->scalp_joints)
        printf(", %u joints%s", info->scalp_joint_count, info->scalp_joint_names ? " with names" : "");
    printf("\n");
}

// Print each kind of attributes once, with how many maps it has.
static void print_attributes(const hair_asset_info* info)
{
    printf("%-10s", "attributes:");
    for (uint32_t i = 0; i < info->strand_attribute_count; ++i) {
        hair_strand_attribute_kind kind = info->strand_attributes[i].kind;
        uint32_t before = 0, maps = 0;
        for (uint32_t k = 0; k < info->strand_attribute_count; ++k) {
            if (info->strand_attributes[k].kind != kind) continue;
            before += k < i;
            maps += info->strand_attributes[k].map.source != HAIR_MAP_SOURCE_NONE;
        }
        if (before) continue;
        printf("%s %s", i ? "," : "", hair_strand_attribute_name(kind));
        if (info->strand_attributes[i].strand_values) printf(" of every strand");
        if (maps) printf(" by %u map%s", maps, maps == 1 ? "" : "s");
    }
    printf("%s\n", info->strand_attribute_count ? "" : " none");
}

static void print_guides(const hair_asset_info* info)
{
    uint32_t guides = 0;
    for (uint32_t i = 0; info->strand_guides && i < info->strand_count; ++i) guides += info->strand_guides[i];
    if (info->strand_guides) printf("%-10s %u of the strands\n", "guides:", guides);
}

static void print_asset(const hair_asset_info* info)
{
    const float *l = info->lower, *u = info->upper;
    printf("%-10s %s, %s\n", "format:", hair_format_name(info->format),
           info->strand_set == HAIR_STRAND_SET_FULL ? "all strands" : "guides");
    printf("%-10s %u, of %u in the file\n", "strands:", info->strand_count, info->file_strands);
    printf("%-10s %u, of %u in the file; fewest %u, most %u to a strand\n", "vertices:", info->vertex_count,
           info->file_vertices, info->min_vertices, info->max_vertices);
    printf("%-10s least %.6g, mean %.6g, greatest %.6g m\n", "length:", (double)info->length[0],
           (double)info->length[1], (double)info->length[2]);
    // Adding 0 turns the -0 of a rotated axis into 0.
    printf("%-10s x %.6g to %.6g, y %.6g to %.6g, z %.6g to %.6g m\n", "bounds:", l[0] + 0.0, u[0] + 0.0,
           l[1] + 0.0, u[1] + 0.0, l[2] + 0.0, u[2] + 0.0);
    printf("%-10s %s\n", "radii:", info->strand_radii ? "of every strand" : "none");
    printf("%-10s %s\n", "colours:", info->strand_colors ? "of every strand" : "none");
    printf("%-10s %s\n", "groups:", info->strand_groups ? "of every strand" : "none");
    print_guides(info);
    print_attributes(info);
    print_scalp(info);
    print_repairs(&info->import_stats);
}

static hair_result print_groom(const hair_asset* asset)
{
    hair_groom_desc desc = hair_groom_desc_default();
    hair_groom_info info = hair_groom_info_default();
    hair_groom* groom = NULL;
    desc.host = &host;
    hair_result result = hair_asset_to_groom_desc(asset, &desc);
    if (!result) result = hair_groom_create(&desc, &groom);
    if (!result) result = hair_groom_describe(groom, &info);
    hair_groom_destroy(groom);
    if (result) return result;
    printf("%-10s %u guides of %u vertices, %u followers, %u patches\n", "groom:", info.guide_count,
           info.guide_vertex_count, info.follower_count, info.patch_count);
    return HAIR_OK;
}

static int run_info(const struct hair_groom_options* options)
{
    hair_asset* asset = NULL;
    int code = read_asset(options->operand[0], options, &asset);
    if (code) return code;
    hair_asset_info info = hair_asset_info_default();
    hair_result result = hair_asset_describe(asset, &info);
    if (!result) {
        print_asset(&info);
        result = print_groom(asset);
    }
    hair_asset_destroy(asset);
    return hair_exit_for(result);
}

static int run_convert(const struct hair_groom_options* options)
{
    hair_asset* asset = NULL;
    int code = read_asset(options->operand[0], options, &asset);
    if (!code) code = write_asset(asset, options);
    hair_asset_destroy(asset);
    return code;
}

static int run_generate(const struct hair_groom_options* options)
{
    hair_asset* asset = NULL;
    hair_style_desc style = options->style;
    style.host = &host;
    hair_result result = hair_asset_generate(&style, &asset);
    int code = result ? hair_exit_for(result) : write_asset(asset, options);
    hair_asset_destroy(asset);
    return code;
}

static int run(int count, char** arguments)
{
    struct hair_groom_options options;
    int code = hair_groom_parse(count, arguments, &options);
    if (code >= 0) return code;
    switch (options.command) {
    case HAIR_GROOM_INFO: return run_info(&options);
    case HAIR_GROOM_CONVERT: return run_convert(&options);
    case HAIR_GROOM_GENERATE: break;
    }
    return run_generate(&options);
}

int main(int count, char** arguments)
{
    signal(SIGPIPE, SIG_IGN); // A write to a closed pipe must fail instead of ending the program.
    int code = run(count, arguments), printed = hair_flush(TOOL);
    return code ? code : printed;
}
