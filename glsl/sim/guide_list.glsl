// guide_list.glsl - the guides that the first program of two leaves to the second.

// Return where the length of a list is, after the work groups of an indirect dispatch.
uint length_of_list(uint list) { return uint(HAIR_HEALTH_COUNT) + uint(HAIR_HEALTH_LIST) * list + 3u; }

void clear_list(uint list)
{
    for (uint k = 0u; k < uint(HAIR_HEALTH_LIST); ++k) health[length_of_list(list) - k] = 0u;
}

// Add a guide to the list of this dispatch, and the work group that it needs. Direct dispatches ignore the groups.
void add_to_list(uint number)
{
    uint at     = length_of_list(params.list), n = atomicAdd(health[at], 1u);
    uint groups = n / GUIDES_IN_GROUP + 1u;
    health[uint(HAIR_HEALTH_LISTS) + n] = number;
    atomicMax(health[at - 3u], min(groups, HAIR_MOST_GROUPS));
    atomicMax(health[at - 2u], (groups + HAIR_MOST_GROUPS - 1u) / HAIR_MOST_GROUPS);
    health[at - 1u] = 1u;
}
