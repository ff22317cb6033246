// random.glsl - a 32-bit hash: the PCG output function of Jarzynski and Olano 2020, "Hash Functions
// for GPU Rendering". hair_hash() in lib/base/math.h is its twin.
#ifndef HAIR_RANDOM_GLSL
#define HAIR_RANDOM_GLSL

uint hash(uint x)
{
    uint state = x * 747796405u + 2891336453u;
    uint word  = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// Return a uniformly distributed number in [0, 1).
float random(uint seed) { return float(hash(seed) >> 8) * (1.0 / 16777216.0); }

#endif
