// mixed_back.glsl - the substitution that follows the elimination of mixed_solve.glsl, from the
// middle to the ends.
//
// Row j has the neighbour n across vertex i. X is the inverse of the block of its turn, and F is
// the inverse of the block of its force:
//
//   theta_j -= X (B theta_n + Y W f_n),   f_j -= Y^T X (B theta_n + Y W f_n) - F W f_n

#ifdef ROWS_IN_REGISTERS

// Substitute rows by the matrix of each row. All threads make the matrices of their own rows at
// once. Only products with the matrices remain to be done in turn.
void substitute_rows(bool exact, bool up, uint rows, uint max_value, uint last)
{
    uint      vertex = up ? lane + 1u : lane, next = up ? lane + 1u : lane - 1u;
    symmetric c = hinge_at(vertex);
    vec3      moment = ROW(hinge_moment, vertex);
    MOBILITY  w = MOBILITY_AT(vertex);
    symmetric of_force = symmetric(force_diagonal, force_beside);
    mat3      y = mat3(between_x, between_y, between_z);
    mat3      of_turn = full(symmetric(turn_diagonal, turn_beside));
    mat3      turn_by_turn = of_turn * hinge_between(c, moment, exact, up);
    mat3      turn_by_force = BY_MOBILITY(of_turn * y, w);
    mat3      y_across = transpose(y), force_by_turn = y_across * turn_by_turn;
    mat3      force_by_force = y_across * turn_by_force - BY_MOBILITY(full(of_force), w);
    for (uint n = max_value; n-- > 0u;) {
        vec3 theta = ROW(right_turn, next), f = ROW(right_force, next);
        vec3 turns = turn_by_turn * theta + turn_by_force * f;
        vec3 forces = force_by_turn * theta + force_by_force * f;
        bool is_its_turn = n < rows && lane == (up ? n : last - n);
        right_turn -= is_its_turn ? turns : vec3(0.0);
        right_force -= is_its_turn ? forces : vec3(0.0);
    }
}

#else

void substitute_row(uint j, uint n, uint i, bool exact, bool up)
{
    mat3      y = mat3(ROW(between_x, j), ROW(between_y, j), ROW(between_z, j));
    symmetric of_turn = symmetric(ROW(turn_diagonal, j), ROW(turn_beside, j));
    symmetric of_force = symmetric(ROW(force_diagonal, j), ROW(force_beside, j));
    vec3 b = hinge_between(hinge_at(i), ROW(hinge_moment, i), exact, up) * ROW(right_turn, n);
    vec3 w = times(MOBILITY_AT(i), ROW(right_force, n)), turns = times(of_turn, b + y * w);
    PUT_ROW(right_turn, j, ROW(right_turn, j) - turns);
    PUT_ROW(right_force, j, ROW(right_force, j) - turns * y + times(of_force, w));
}

void substitute_rows(bool exact, bool up, uint rows, uint max_value, uint last)
{
    if (ELIMINATES) {
        for (uint n = rows; n-- > 0u;) {
            uint j = up ? n : last - n;
            substitute_row(j, up ? j + 1u : j - 1u, up ? j + 1u : j, exact, up);
        }
    }
}

#endif
