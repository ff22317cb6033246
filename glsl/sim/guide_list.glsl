// guide_list.glsl - the list of guides that the first of two programs leaves to the second.

// Return the index of a list's length in solver_stats[]. The work groups of an indirect dispatch
// come before it.
uint length_of_list(uint list)
{
    return uint(HAIR_SOLVER_STATS_COUNT) + uint(HAIR_SOLVER_STATS_LIST) * list + 3u;
}

void clear_list(uint list)
{
    for (uint k = 0u; k < uint(HAIR_SOLVER_STATS_LIST); ++k) solver_stats[length_of_list(list) - k] = 0u;
}

// Add a guide to the list of this dispatch, and count the work groups that the list needs. Direct
// dispatches ignore the groups.
void add_to_list(uint number)
{
    uint at     = length_of_list(params.list), n = atomicAdd(solver_stats[at], 1u);
    uint groups = n / params.list_guides + 1u;
    solver_stats[uint(HAIR_SOLVER_STATS_LISTS) + n] = number;
    atomicMax(solver_stats[at - 3u], min(groups, HAIR_MAX_GROUPS));
    atomicMax(solver_stats[at - 2u], (groups + HAIR_MAX_GROUPS - 1u) / HAIR_MAX_GROUPS);
    solver_stats[at - 1u] = 1u;
}
