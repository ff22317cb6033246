// damping.glsl - the rate at which the velocities of a guide decay, and its effect in a substep.

#ifdef HAIR_GROUP_DAMPING
// Values of params.damping, params.keep and params.kick for the guide.
float guide_damping, guide_keep, guide_kick;

void load_damping()
{
    guide_damping = damping_of(guide_number);
    float h = params.gravity.w, x = guide_damping * h;
    guide_keep = exp(-x);
    // The series is used where x is small, because rounding spoils the difference.
    guide_kick = h * h * (x < 0.01 ? 1.0 - x / 2.0 * (1.0 - x / 3.0) : (1.0 - guide_keep) / x);
}
#else
#define guide_damping params.damping
#define guide_keep params.keep
#define guide_kick params.kick

void load_damping() {}
#endif
