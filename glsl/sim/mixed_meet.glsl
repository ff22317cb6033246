// mixed_meet.glsl - the sum of the terms that both ends of an elimination carry to the middle.
carried nothing_carried()
{
    return carried(multiple_of_one(0.0), multiple_of_one(0.0), mat3(0.0), vec3(0.0), vec3(0.0));
}

#ifdef HAIR_THREAD_PER_GUIDE

void add_other_end(bool up, inout carried s) {}

#else

#ifdef ROWS_IN_REGISTERS
vec3 add_other(uint other, vec3 v) { return v + subgroupShuffle(v, other); }
#else
shared vec3 halves[2];
vec3 add_other(uint other, vec3 v)
{
    synchronise();
    if (lane < 2u) halves[lane] = v;
    synchronise();
    return halves[0] + halves[1];
}
#endif

void add_other_end(bool up, inout carried s)
{
    // Any thread of the other half will do, because all of them have the same values.
    uint other = up ? 31u : 0u;
    s.turn    = symmetric(add_other(other, s.turn.diagonal), add_other(other, s.turn.beside));
    s.force   = symmetric(add_other(other, s.force.diagonal), add_other(other, s.force.beside));
    s.between =
        mat3(add_other(other, s.between[0]), add_other(other, s.between[1]), add_other(other, s.between[2]));
    s.right_turn  = add_other(other, s.right_turn);
    s.right_force = add_other(other, s.right_force);
}

#endif
