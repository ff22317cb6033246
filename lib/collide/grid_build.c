// grid_build.c - colliders sorted into a grid of lists, each in the order of colliders.
#include "lib/collide/grid.h"

#include <stdlib.h>
#include <string.h>

#define MAX_CELLS 32 // Maximum number of cells along an axis.
// Maximum number of pairs of a collider and a cell, unless there are more colliders.
#define MAX_PAIRS (1u << 21)

static hair_shape shape_of(const struct hair_contact* contact)
{
    return (hair_shape)contact->body.size.w;
}

// Lay the grid around all colliders except half-spaces, which are everywhere, as far as hair
// reaches.
static void build_grid(struct hair_collider_grid* grid, const struct hair_collider_grid_desc* desc,
                       float scale)
{
    float lower[3], upper[3], longest = 0;
    for (int k = 0; k < 3; ++k) {
        lower[k] = INFINITY, upper[k] = -INFINITY;
        for (uint32_t i = 0; i < grid->contacts; ++i) {
            if (shape_of(&grid->contact[i]) == HAIR_SHAPE_PLANE) continue;
            lower[k] = fminf(lower[k], grid->bounds[i].lower[k]);
            upper[k] = fmaxf(upper[k], grid->bounds[i].upper[k]);
        }
        lower[k] = fmaxf(lower[k], -desc->reach);
        upper[k] = fminf(upper[k], desc->reach);
        if (!(lower[k] < upper[k])) lower[k] = 0, upper[k] = 0;
        longest = fmaxf(longest, upper[k] - lower[k]);
    }
    grid->size = scale * fmaxf(longest / MAX_CELLS, desc->slack);
    HAIR_ASSERT(grid->size > 0);
    grid->lower = hair_load3(lower);
    for (int k = 0; k < 3; ++k)
        grid->cells[k] =
            (uint32_t)fminf(fmaxf(ceilf((upper[k] - lower[k]) / grid->size - 1e-3f), 1), MAX_CELLS);
}

struct range {
    uint32_t first[3], last[3];
};

static struct range range_of(const struct hair_collider_grid* grid, const struct hair_cell_bounds* bounds)
{
    const float lower[3] = {grid->lower.x, grid->lower.y, grid->lower.z};
    struct range range;
    for (int k = 0; k < 3; ++k) {
        float max = (float)(grid->cells[k] - 1);
        range.first[k] = (uint32_t)fminf(fmaxf((bounds->lower[k] - lower[k]) / grid->size, 0), max);
        range.last[k] = (uint32_t)fminf(fmaxf((bounds->upper[k] - lower[k]) / grid->size, 0), max);
        HAIR_ASSERT(range.first[k] <= range.last[k] && range.last[k] < grid->cells[k]);
    }
    return range;
}

static uint64_t count_pairs(const struct hair_collider_grid* grid)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < grid->contacts; ++i) {
        struct range r = range_of(grid, &grid->bounds[i]);
        count += (uint64_t)(r.last[0] - r.first[0] + 1) * (r.last[1] - r.first[1] + 1) *
                 (r.last[2] - r.first[2] + 1);
    }
    return count;
}

static float from_axis(hair_vec3 at, const hair_vec4 ends[2])
{
    hair_vec3 a = {ends[0].x, ends[0].y, ends[0].z}, b = {ends[1].x, ends[1].y, ends[1].z};
    hair_vec3 axis = hair_sub(b, a), arm = hair_sub(at, a);
    float t = hair_dot(arm, axis) / fmaxf(hair_dot(axis, axis), 1e-20f);
    return hair_length(hair_sub(arm, hair_scale(axis, fminf(fmaxf(t, 0), 1))));
}

static hair_vec3 middle_of(const struct hair_collider_grid* grid, uint32_t x, uint32_t y, uint32_t z)
{
    return hair_add(grid->lower,
                    hair_scale(hair_v3((float)x + 0.5f, (float)y + 0.5f, (float)z + 0.5f), grid->size));
}

static float moved_by(const hair_vec4* from, const hair_vec4* to)
{
    return hair_length(hair_v3(to->x - from->x, to->y - from->y, to->z - from->z));
}

// Return the maximum distance of a contact's axis from the centres of cells that list it. Cells at
// the corners of the box around a round collider are farther away.
static float collider_reach(const struct hair_collider_grid* grid, const struct hair_collider_grid_desc* desc,
                            uint32_t i)
{
    const struct hair_capsule* around = &grid->contact[i].around;
    float moved =
        fmaxf(moved_by(&around->start[0], &around->end[0]), moved_by(&around->start[1], &around->end[1]));
    return fmaxf(around->start[0].w, around->end[0].w) + desc->margin + desc->slack +
           (1 - desc->fraction_start) * moved + 0.87f * grid->size;
}

// Pairs -------------------------------------------------------------------------------------------

struct pairs {
    uint32_t *cell, *contact; // each contact with all of its cells, one after the other
    uint32_t count;
};

// Criterion of the cells of a contact: a segment, and the maximum distance of their centres from
// it.
struct span {
    hair_vec3 from, axis;
    float over, reach; // `over` is 1 / the squared length of the axis.
};

static struct span span_of(const struct hair_collider_grid* grid, const struct hair_collider_grid_desc* desc,
                           uint32_t i)
{
    const hair_vec4* end = grid->contact[i].around.end;
    hair_vec3 from = {end[0].x, end[0].y, end[0].z}, to = {end[1].x, end[1].y, end[1].z};
    hair_vec3 axis = hair_sub(to, from);
    return (struct span){from, axis, 1 / fmaxf(hair_dot(axis, axis), 1e-20f), collider_reach(grid, desc, i)};
}

static int is_within(const struct span* span, hair_vec3 at)
{
    hair_vec3 arm = hair_sub(at, span->from);
    // Comparisons, because fminf and fmaxf are calls.
    float t = hair_dot(arm, span->axis) * span->over;
    hair_vec3 off = hair_sub(arm, hair_scale(span->axis, t < 0 ? 0 : t > 1 ? 1 : t));
    return hair_dot(off, off) <= span->reach * span->reach;
}

// Narrow a row of cells to those with centres within the reach of a sphere. Return 0 if there are
// none.
static int clip_row_to_sphere(const struct hair_collider_grid* grid, const struct span* span, hair_vec3 start,
                              uint32_t first, uint32_t* from, uint32_t* to)
{
    hair_vec3 arm = hair_sub(start, span->from);
    float square = span->reach * span->reach - arm.y * arm.y - arm.z * arm.z;
    if (square < 0) return 0;
    float half = sqrtf(square), low = (-arm.x - half) / grid->size, high = (-arm.x + half) / grid->size;
    if (high < 0) return 0;
    *from = low > 0 ? first + (uint32_t)ceilf(low - 1e-3f) : first;
    uint32_t up = first + (uint32_t)(high + 1e-3f);
    *to = up < *to ? up : *to;
    return *from <= *to;
}

// Find all pairs. Count the contacts of each cell in `number[cell + 1]`.
static void find_pairs(const struct hair_collider_grid* grid, const struct hair_collider_grid_desc* desc,
                       uint32_t* number, struct pairs* out)
{
    for (uint32_t i = 0; i < grid->contacts; ++i) {
        int all = shape_of(&grid->contact[i]) == HAIR_SHAPE_PLANE, is_ball;
        struct span span = span_of(grid, desc, i);
        struct range r = range_of(grid, &grid->bounds[i]);
        is_ball = !all && hair_dot(span.axis, span.axis) == 0;
        for (uint32_t z = r.first[2]; z <= r.last[2]; ++z)
            for (uint32_t y = r.first[1]; y <= r.last[1]; ++y) {
                uint32_t from = r.first[0], to = r.last[0];
                if (is_ball &&
                    !clip_row_to_sphere(grid, &span, middle_of(grid, from, y, z), from, &from, &to))
                    continue;
                for (uint32_t x = from; x <= to; ++x) {
                    if (!all && !is_ball && !is_within(&span, middle_of(grid, x, y, z))) continue;
                    uint32_t cell = x + grid->cells[0] * (y + grid->cells[1] * z);
                    ++number[cell + 1];
                    out->cell[out->count] = cell;
                    out->contact[out->count++] = i;
                }
            }
    }
}

struct candidate {
    float distance;
    uint32_t contact;
};

static int by_distance(const void* a, const void* b)
{
    const struct candidate *p = a, *q = b;
    if (p->distance != q->distance) return p->distance < q->distance ? -1 : 1;
    return p->contact < q->contact ? -1 : p->contact > q->contact;
}

// Move the `kept` nearest candidates to the front, in any order (Hoare 1961).
static void select_nearest(struct candidate* candidate, uint32_t count, uint32_t kept)
{
    HAIR_ASSERT(kept < count);
    uint32_t first = 0, last = count;
    while (last - first > 1 && first < kept) {
        struct candidate middle = candidate[first + (last - 1 - first) / 2];
        uint32_t i = first, k = last - 1;
        for (;; ++i, --k) {
            while (by_distance(&candidate[i], &middle) < 0) ++i;
            while (by_distance(&middle, &candidate[k]) < 0) --k;
            if (i >= k) break;
            struct candidate other = candidate[i];
            candidate[i] = candidate[k];
            candidate[k] = other;
        }
        // Candidates up to k are no farther than those behind k.
        if (k + 1 >= kept)
            last = k + 1;
        else
            first = k + 1;
    }
}

// Remove candidates farther than `farthest`, preserving order. Return the new count.
static uint32_t keep_within(struct candidate* candidate, uint32_t count, struct candidate farthest)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; ++i)
        if (by_distance(&candidate[i], &farthest) <= 0) candidate[kept++] = candidate[i];
    return kept;
}

// Choose the nearest contacts of a list that is too long, preserving order. Return their number.
// `sorted` has room for `count` candidates.
static uint32_t select_nearest_contacts(const struct hair_collider_grid* grid, uint32_t max_rounds,
                                        uint32_t cell, const uint32_t* contact, uint32_t count,
                                        struct candidate* candidate, struct candidate* sorted)
{
    uint32_t x = cell % grid->cells[0], yz = cell / grid->cells[0], rounds = 0, kept = 0;
    HAIR_ASSERT(yz < grid->cells[1] * grid->cells[2]);
    hair_vec3 middle = middle_of(grid, x, yz % grid->cells[1], yz / grid->cells[1]);
    for (uint32_t i = 0; i < count; ++i) {
        const hair_vec4* ends = grid->contact[contact[i]].around.end;
        candidate[i] = (struct candidate){from_axis(middle, ends) - ends[0].w, contact[i]};
    }
    if (count > HAIR_CELL_COLLIDERS) {
        memcpy(sorted, candidate, count * sizeof *sorted);
        select_nearest(sorted, count, HAIR_CELL_COLLIDERS);
        struct candidate farthest = sorted[0];
        for (uint32_t i = 1; i < HAIR_CELL_COLLIDERS; ++i)
            if (by_distance(&sorted[i], &farthest) > 0) farthest = sorted[i];
        count = keep_within(candidate, count, farthest);
        HAIR_ASSERT(count == HAIR_CELL_COLLIDERS);
    }
    for (uint32_t i = 0; i < count; ++i) rounds += hair_entry_rounds(grid->member[candidate[i].contact]);
    if (rounds <= max_rounds) return count;
    memcpy(sorted, candidate, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, by_distance);
    for (rounds = 0; kept < count; ++kept) {
        rounds += hair_entry_rounds(grid->member[sorted[kept].contact]);
        if (rounds > max_rounds) break;
    }
    return kept ? keep_within(candidate, count, sorted[kept - 1]) : 0;
}

static void end_list(struct hair_collider_grid* grid, uint32_t cell, uint32_t first)
{
    HAIR_ASSERT(first <= grid->entries && grid->entries <= grid->entry_room);
    uint32_t rounds = 0, count = grid->entries - first;
    for (uint32_t i = first; i < grid->entries; ++i) rounds += hair_entry_rounds(grid->entry[i]);
    if (rounds > grid->rounds) grid->rounds = rounds;
    if (count > grid->longest) grid->longest = count;
    grid->entry[cell + 1] = grid->entries;
}

// Write the lists. `end` is the end of each cell's contacts in `sorted`.
static void write_lists(struct hair_collider_grid* grid, const struct hair_collider_grid_desc* desc,
                        const uint32_t* end, const uint32_t* sorted, struct candidate* candidate,
                        uint32_t longest)
{
    uint32_t all = grid->cells[0] * grid->cells[1] * grid->cells[2];
    grid->entries = all + 1;
    grid->entry[0] = grid->entries;
    grid->rounds = grid->longest = grid->left_out = 0;
    for (uint32_t cell = 0; cell < all; ++cell) {
        uint32_t begin = cell ? end[cell - 1] : 0, count = end[cell] - begin, first = grid->entries,
                 rounds = 0;
        for (uint32_t i = 0; i < count; ++i) rounds += hair_entry_rounds(grid->member[sorted[begin + i]]);
        if (count > HAIR_CELL_COLLIDERS || rounds > desc->max_rounds) {
            uint32_t kept = select_nearest_contacts(grid, desc->max_rounds, cell, sorted + begin, count,
                                                    candidate, candidate + longest);
            HAIR_ASSERT(kept <= HAIR_CELL_COLLIDERS && kept <= count);
            for (uint32_t i = 0; i < kept; ++i)
                grid->entry[grid->entries++] = grid->member[candidate[i].contact];
            grid->left_out = count - kept > grid->left_out ? count - kept : grid->left_out;
        } else {
            for (uint32_t i = 0; i < count; ++i)
                grid->entry[grid->entries++] = grid->member[sorted[begin + i]];
        }
        end_list(grid, cell, first);
    }
}

static hair_result build_lists(const hair_host* host, struct hair_collider_grid* grid,
                               const struct hair_collider_grid_desc* desc, uint32_t max)
{
    uint32_t all = grid->cells[0] * grid->cells[1] * grid->cells[2], longest = 0;
    uint32_t* numbers = hair_alloc(host, (size_t)all + 1 + 3 * (size_t)max, sizeof *numbers);
    if (!numbers) return hair_fail_memory(host, "what guides collide with");
    uint32_t *end = numbers, *sorted = end + all + 1;
    struct pairs pairs = {sorted + max, sorted + 2 * (size_t)max, 0};
    find_pairs(grid, desc, end, &pairs);
    HAIR_ASSERT(pairs.count <= max);
    for (uint32_t i = 0; i < all; ++i) {
        longest = end[i + 1] > longest ? end[i + 1] : longest;
        end[i + 1] += end[i];
    }
    // Scatter the contacts. The start of each cell becomes its end, contact by contact.
    for (uint32_t i = 0; i < pairs.count; ++i) sorted[end[pairs.cell[i]]++] = pairs.contact[i];
    HAIR_ASSERT(end[all - 1] == pairs.count && longest <= pairs.count);

    struct candidate* candidate = hair_alloc(host, 2 * (size_t)longest, sizeof *candidate);
    uint32_t room = all + 1 + pairs.count;
    if (room > grid->entry_room) {
        hair_free(host, grid->entry);
        grid->entry = hair_alloc(host, room + room / 2, sizeof *grid->entry);
        grid->entry_room = grid->entry ? room + room / 2 : 0;
    }
    int whole = candidate && grid->entry;
    if (whole) write_lists(grid, desc, end, sorted, candidate, longest);
    hair_free(host, candidate);
    hair_free(host, numbers);
    return whole ? HAIR_OK : hair_fail_memory(host, "what guides collide with");
}

// The whole ---------------------------------------------------------------------------------------

static int is_still(const struct hair_contact* contact)
{
    const struct hair_capsule* around = &contact->around;
    const struct hair_contact_body* body = &contact->body;
    return !memcmp(around->start, around->end, sizeof around->start) &&
           !memcmp(&body->rotation[0], &body->rotation[1], sizeof body->rotation[0]);
}

// Return whether the lists are still valid. The start of the step does not matter if nothing moves.
static int is_as_before(const struct hair_collider_grid* grid, const struct hair_collider_grid_desc* desc)
{
    struct hair_collider_grid_desc made_for = grid->made_for;
    if (!grid->entries || grid->contacts != grid->last_contacts) return 0;
    if (grid->contacts && memcmp(grid->contact, grid->last, grid->contacts * sizeof *grid->last)) return 0;
    int same = made_for.fraction_start == desc->fraction_start;
    made_for.fraction_start = desc->fraction_start;
    for (uint32_t i = 0; i < grid->contacts && !same; ++i)
        if (!is_still(&grid->contact[i])) return 0;
    return !memcmp(&made_for, desc, sizeof made_for);
}

static hair_result keep_grid(const hair_host* host, struct hair_collider_grid* grid,
                             const struct hair_collider_grid_desc* desc)
{
    if (grid->contacts > grid->last_room) {
        hair_free(host, grid->last);
        grid->last = hair_alloc(host, grid->room, sizeof *grid->last);
        grid->last_room = grid->last ? grid->room : 0;
        if (!grid->last) return hair_fail_memory(host, "what guides collide with");
    }
    HAIR_ASSERT(grid->contacts <= grid->last_room);
    if (grid->contacts) memcpy(grid->last, grid->contact, grid->contacts * sizeof *grid->last);
    grid->last_contacts = grid->contacts;
    grid->made_for = *desc;
    return HAIR_OK;
}

hair_result hair_collider_grid_build(const hair_host* host, struct hair_collider_grid* grid,
                                     const struct hair_collider_grid_desc* desc, int* changed)
{
    *changed = !is_as_before(grid, desc);
    if (!*changed) return HAIR_OK;
    grid->entries = 0;
    uint64_t pairs, max = grid->contacts > MAX_PAIRS ? grid->contacts : MAX_PAIRS;
    float scale = 1;
    do {
        build_grid(grid, desc, scale);
        pairs = count_pairs(grid);
        scale *= 2;
    } while (pairs > max);
    hair_result result = build_lists(host, grid, desc, (uint32_t)pairs);
    if (!result) result = keep_grid(host, grid, desc);
    if (result) grid->entries = 0;
    return result;
}
