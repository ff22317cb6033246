// hair_grid_rest.c - what the groom at rest determines of the hair-hair grid: its place and size,
// what each vertex adds, the order in which vertices add, and what a node holds without pressure.
#include "lib/sim/hair_grid.h"

#include "lib/sim/sim.h"

// Minimum distance between nodes, m. Cells smaller than the spacing of guides would hold no
// neighbours.
#define MIN_CELL 0.01f
#define MAX_IN_BIN 32 // Maximum number of vertices sampled in a cell.

// Place the grid around all that hair of its rest length can reach.
static void place_grid(const struct hair_sim* sim, const struct hair_guide* guides,
                       const struct hair_rest* rest, struct hair_grid* hair_grid)
{
    float lower[3] = {INFINITY, INFINITY, INFINITY};
    float upper[3] = {-INFINITY, -INFINITY, -INFINITY}, widest = 0;
    for (uint32_t i = 0; i < sim->guides; ++i) {
        const float* root = &rest[guides[i].first].position.x;
        for (int k = 0; k < 3; ++k) {
            lower[k] = fminf(lower[k], root[k] - guides[i].arc_length);
            upper[k] = fmaxf(upper[k], root[k] + guides[i].arc_length);
            widest = fmaxf(widest, upper[k] - lower[k]);
        }
    }
    hair_grid->lower = hair_load3(lower);
    hair_grid->cell = fmaxf(MIN_CELL, widest / (HAIR_GRID_NODES - 1));
    HAIR_ASSERT(hair_grid->cell >= MIN_CELL);
    for (int k = 0; k < 3; ++k) {
        uint32_t nodes = (uint32_t)ceilf((upper[k] - lower[k]) / hair_grid->cell) + 1;
        hair_grid->nodes[k] = nodes < 2 ? 2 : nodes < HAIR_GRID_NODES ? nodes : HAIR_GRID_NODES;
    }
}

uint32_t hair_grid_count_nodes(const struct hair_grid* hair_grid)
{
    return hair_grid->nodes[0] * hair_grid->nodes[1] * hair_grid->nodes[2];
}

struct stencil {
    uint32_t node[3]; // The lowest of the eight nodes around.
    float part[3]; // Fraction of the way to the next node, per axis.
};

static struct stencil stencil_at(const struct hair_grid* hair_grid, const hair_vec4* position)
{
    const float at[3] = {position->x - hair_grid->lower.x, position->y - hair_grid->lower.y,
                         position->z - hair_grid->lower.z};
    struct stencil stencil;
    for (int k = 0; k < 3; ++k) {
        float g = fminf(fmaxf(at[k] / hair_grid->cell, 0), (float)(hair_grid->nodes[k] - 1));
        uint32_t n = (uint32_t)g;
        stencil.node[k] = n < hair_grid->nodes[k] - 2 ? n : hair_grid->nodes[k] - 2;
        stencil.part[k] = g - (float)stencil.node[k];
        HAIR_ASSERT(0 <= stencil.part[k] && stencil.part[k] <= 1);
    }
    return stencil;
}

static uint32_t node_at(const struct hair_grid* hair_grid, uint32_t x, uint32_t y, uint32_t z)
{
    HAIR_ASSERT(x < hair_grid->nodes[0] && y < hair_grid->nodes[1] && z < hair_grid->nodes[2]);
    return x + hair_grid->nodes[0] * (y + hair_grid->nodes[1] * z);
}

// Arrays for the computation of the grid at rest.
struct grid_layout {
    double* mass; // Mass of every vertex, half the length of its adjacent segments, m.
    double* volume; // Volume of every vertex, in cells.
    double* filled; // Volume at every node, in cells.
    uint32_t* bin; // Start of every cell in `vertex`.
    uint32_t* vertex; // Vertices sorted by cell.
};

static void compute_masses(const struct hair_sim* sim, const struct hair_guide* guides,
                           const struct hair_rest* rest, double* mass)
{
    for (uint32_t g = 0; g < sim->guides; ++g)
        for (uint32_t i = 0; i < guides[g].count; ++i) {
            uint32_t at = guides[g].first + i;
            double before = i > 0 ? (double)rest[at - 1].position.w : 0;
            double after = i + 1 < guides[g].count ? (double)rest[at].position.w : 0;
            mass[at] = (before + after) / 2;
        }
}

static void sort_by_cell(const struct hair_sim* sim, const struct hair_rest* rest,
                         const struct hair_grid* hair_grid, struct grid_layout* layout)
{
    for (int place = 0; place < 2; ++place) {
        for (uint32_t i = 0; i < sim->guide_vertices; ++i) {
            struct stencil s = stencil_at(hair_grid, &rest[i].position);
            uint32_t bin = node_at(hair_grid, s.node[0], s.node[1], s.node[2]);
            if (place)
                layout->vertex[layout->bin[bin + 1]++] = i;
            else
                ++layout->bin[bin + 2];
        }
        for (uint32_t n = 2; !place && n < hair_grid_count_nodes(hair_grid) + 2; ++n)
            layout->bin[n] += layout->bin[n - 1];
    }
}

// Return the mass around a vertex, with the weights that a node at the vertex would have. The
// minimum is the mass of a straight strand along an axis, the direction that puts the most mass
// into a node. A strand by itself thus fills no node, whatever its position and direction.
static double mass_around(const struct hair_sim* sim, const struct hair_rest* rest,
                          const struct grid_layout* layout, uint32_t i)
{
    const struct hair_grid* hair_grid = &sim->hair_grid;
    struct stencil s = stencil_at(hair_grid, &rest[i].position);
    double sum = 0, cell = (double)hair_grid->cell;
    for (uint32_t n = 0; n < 27; ++n) {
        uint32_t x = s.node[0] + n % 3 - 1, y = s.node[1] + n / 3 % 3 - 1, z = s.node[2] + n / 9 - 1;
        // A coordinate of -1 wraps to UINT32_MAX.
        if (x >= hair_grid->nodes[0] || y >= hair_grid->nodes[1] || z >= hair_grid->nodes[2]) continue;
        uint32_t bin = node_at(hair_grid, x, y, z), end = layout->bin[bin + 1];
        uint32_t stride = (end - layout->bin[bin] + MAX_IN_BIN - 1) / MAX_IN_BIN;
        for (uint32_t k = layout->bin[bin]; k < end; k += stride) {
            const hair_vec4 *a = &rest[i].position, *b = &rest[layout->vertex[k]].position;
            double wx = 1 - fabs((double)(a->x - b->x)) / cell, wy = 1 - fabs((double)(a->y - b->y)) / cell;
            double wz = 1 - fabs((double)(a->z - b->z)) / cell;
            if (wx > 0 && wy > 0 && wz > 0) sum += stride * layout->mass[layout->vertex[k]] * wx * wy * wz;
        }
    }
    HAIR_ASSERT(sum >= 0);
    return fmax(sum, fmax(cell, layout->mass[i]));
}

static void fill_layout(const struct hair_sim* sim, const struct hair_rest* rest, struct grid_layout* layout)
{
    const struct hair_grid* hair_grid = &sim->hair_grid;
    for (uint32_t i = 0; i < sim->guide_vertices; ++i) {
        struct stencil s = stencil_at(hair_grid, &rest[i].position);
        layout->volume[i] = layout->mass[i] / mass_around(sim, rest, layout, i);
        for (uint32_t c = 0; c < 8; ++c) {
            double weight = layout->volume[i];
            for (int k = 0; k < 3; ++k) weight *= (c >> k & 1) ? (double)s.part[k] : 1 - (double)s.part[k];
            layout->filled[node_at(hair_grid, s.node[0] + (c & 1), s.node[1] + (c >> 1 & 1),
                                   s.node[2] + (c >> 2))] += weight;
        }
    }
}

// Upload the contributions of vertices in the grid's units. NULL for `volume` means 0.
static hair_result upload_splats(struct hair_sim* sim, hair_gl_category category,
                                 const struct hair_guide* guides, const double* mass, const double* volume,
                                 GLuint* out)
{
    const hair_host* host = &sim->gl->host;
    uint32_t vertices = sim->guide_vertices;
    struct hair_grid_splat* splat = hair_alloc(host, vertices, sizeof *splat);
    double masses = 0, volumes = 0;
    if (!splat) return hair_fail_memory(host, "the hair grid");
    for (uint32_t i = 0; i < vertices; ++i) masses += mass[i], volumes += volume ? volume[i] : 0;
    HAIR_ASSERT(masses > 0);
    for (uint32_t i = 0; i < vertices; ++i) {
        splat[i].mass = (uint32_t)(mass[i] * (HAIR_GRID_UNITS / masses) + 0.5);
        splat[i].volume = volume ? (uint32_t)(volume[i] * (HAIR_GRID_UNITS / volumes) + 0.5) : 0;
    }
    for (uint32_t g = 0; g < sim->guides; ++g)
        for (uint32_t i = 0, first = guides[g].first; i < guides[g].count; ++i)
            splat[first + i].first = first, splat[first + i].end = first + guides[g].count;
    hair_result result =
        hair_gl_storage(sim->gl, category, "hair grid splat", vertices * sizeof *splat, splat, out);
    hair_free(host, splat);
    return result;
}

// Upload the vertices sorted by cell.
static hair_result upload_order(struct hair_sim* sim, hair_gl_category category,
                                const struct grid_layout* layout, GLuint* out)
{
    return hair_gl_storage(sim->gl, category, "hair grid order", sim->guide_vertices * sizeof(uint32_t),
                           layout->vertex, out);
}

// Upload the contributions of vertices and the volume limit of each node. A node exerts pressure
// above the volume of a full cell, or above its volume at rest if that is greater.
static hair_result upload_grid(struct hair_sim* sim, const struct hair_guide* guides,
                               const struct grid_layout* layout)
{
    const hair_host* host = &sim->gl->host;
    struct hair_grid* hair_grid = &sim->hair_grid;
    uint32_t nodes = hair_grid_count_nodes(hair_grid);
    float* rest_density = hair_alloc(host, nodes, sizeof *rest_density);
    double volume = 0;
    hair_result result = rest_density ? HAIR_OK : hair_fail_memory(host, "the hair grid");
    for (uint32_t i = 0; i < sim->guide_vertices; ++i) volume += layout->volume[i];
    HAIR_ASSERT(volume > 0);
    for (uint32_t n = 0; n < nodes && !result; ++n)
        rest_density[n] = (float)(fmax(layout->filled[n], 1) * (HAIR_GRID_UNITS / volume));
    if (!result)
        result = upload_splats(sim, HAIR_GL_CATEGORY_HAIR_GRID, guides, layout->mass, layout->volume,
                               &hair_grid->splat);
    if (!result)
        result = hair_gl_storage(sim->gl, HAIR_GL_CATEGORY_HAIR_GRID, "hair grid rest density",
                                 nodes * sizeof *rest_density, rest_density, &hair_grid->rest_density);
    if (!result) result = upload_order(sim, HAIR_GL_CATEGORY_HAIR_GRID, layout, &hair_grid->order);
    hair_free(host, rest_density);
    return result;
}

hair_result hair_grid_make_rest(struct hair_sim* sim, const struct hair_guide* guides,
                                const struct hair_rest* rest)
{
    const hair_host* host = &sim->gl->host;
    uint32_t vertices = sim->guide_vertices, nodes;
    place_grid(sim, guides, rest, &sim->hair_grid);
    nodes = hair_grid_count_nodes(&sim->hair_grid);
    struct grid_layout layout = {0};
    layout.mass = hair_alloc(host, vertices, sizeof *layout.mass);
    layout.volume = hair_alloc(host, vertices, sizeof *layout.volume);
    layout.filled = hair_alloc(host, nodes, sizeof *layout.filled);
    layout.bin = hair_alloc(host, nodes + 2, sizeof *layout.bin);
    layout.vertex = hair_alloc(host, vertices, sizeof *layout.vertex);
    int whole = layout.mass && layout.volume && layout.filled && layout.bin && layout.vertex;
    hair_result result = whole ? HAIR_OK : hair_fail_memory(host, "the hair grid");
    if (!result) {
        compute_masses(sim, guides, rest, layout.mass);
        sim->hair_grid.metres = 0;
        for (uint32_t i = 0; i < vertices; ++i) sim->hair_grid.metres += layout.mass[i];
        sort_by_cell(sim, rest, &sim->hair_grid, &layout);
        HAIR_ASSERT(layout.bin[nodes] == vertices);
        fill_layout(sim, rest, &layout);
        result = upload_grid(sim, guides, &layout);
    }
    hair_free(host, layout.mass);
    hair_free(host, layout.volume);
    hair_free(host, layout.filled);
    hair_free(host, layout.bin);
    hair_free(host, layout.vertex);
    return result;
}

hair_result hair_grid_weigh(struct hair_sim* sim, GLuint* splat, GLuint* order, double* metres)
{
    const hair_host* host = &sim->gl->host;
    const struct hair_rest* rest;
    const struct hair_guide* guides = hair_sim_guides(sim, &rest);
    struct hair_grid cells = {0};
    place_grid(sim, guides, rest, &cells);
    struct grid_layout layout = {.mass = hair_alloc(host, sim->guide_vertices, sizeof *layout.mass),
                                 .bin =
                                     hair_alloc(host, hair_grid_count_nodes(&cells) + 2, sizeof *layout.bin),
                                 .vertex = hair_alloc(host, sim->guide_vertices, sizeof *layout.vertex)};
    bool is_whole = layout.mass && layout.bin && layout.vertex;
    hair_result result = is_whole ? HAIR_OK : hair_fail_memory(host, "the lengths of guides");
    if (!result) {
        compute_masses(sim, guides, rest, layout.mass);
        *metres = 0;
        for (uint32_t i = 0; i < sim->guide_vertices; ++i) *metres += layout.mass[i] / HAIR_GRID_UNITS;
        sort_by_cell(sim, rest, &cells, &layout);
        result = upload_splats(sim, HAIR_GL_CATEGORY_WIND, guides, layout.mass, NULL, splat);
    }
    if (!result) result = upload_order(sim, HAIR_GL_CATEGORY_WIND, &layout, order);
    if (result) hair_gl_free_buffer(sim->gl, splat);
    hair_free(host, layout.mass);
    hair_free(host, layout.bin);
    hair_free(host, layout.vertex);
    return result;
}
