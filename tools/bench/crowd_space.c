// crowd_space.c - The space that the strands of a crowd fill, and the side of the head they are on.
#include "tools/bench/crowd_space.h"

#include <math.h>
#include <stdlib.h>

#define CELL 0.01 // m

// Return a number of the cube that a point is in. Cubes have the same number if they are 20 km
// apart.
static uint64_t find_cell(const float* p)
{
    uint64_t cell = 0;
    for (int k = 0; k < 3; ++k) cell = cell << 21 | ((uint64_t)floor((double)p[k] / CELL) & 0x1fffff);
    return cell;
}

static int compare(const void* a, const void* b)
{
    uint64_t x = *(const uint64_t*)a, y = *(const uint64_t*)b;
    return (x > y) - (x < y);
}

double bench_crowd_measure_volume(const struct crowd* crowd, const float* strands)
{
    size_t count = (size_t)crowd->strands * crowd->vertices, cubes = 0;
    uint64_t* cells = malloc(count * sizeof *cells);
    if (!cells) return 0;
    for (size_t i = 0; i < count; ++i) cells[i] = find_cell(strands + 3 * i);
    qsort(cells, count, sizeof *cells, compare);
    for (size_t i = 0; i < count; ++i) cubes += i == 0 || cells[i] != cells[i - 1];
    free(cells);
    return (double)cubes * CELL * CELL * CELL;
}

// Return how far to the left of the head's middle plane a point is, m.
static double find_side(const struct crowd* crowd, const float* p)
{
    const float* m = crowd->transform;
    double side = 0;
    for (int k = 0; k < 3; ++k) side += (double)m[k] * ((double)p[k] - (double)m[12 + k]);
    return side;
}

uint32_t bench_crowd_count_crossed(const struct crowd* crowd, const float* strands, double depth)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < crowd->strands; ++i) {
        const float* strand = strands + 3 * (size_t)crowd->vertices * i;
        double root = find_side(crowd, strand), sign = root < 0 ? -1 : 1;
        bool is_beyond = false;
        for (uint32_t k = 1; k < crowd->vertices && !is_beyond; ++k)
            is_beyond = sign * find_side(crowd, strand + 3 * k) < -depth;
        count += is_beyond;
    }
    return count;
}
