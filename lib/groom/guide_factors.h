// guide_factors.h - factors by which the physics of guides differ.
#ifndef HAIR_GROOM_GUIDE_FACTORS_H
#define HAIR_GROOM_GUIDE_FACTORS_H

// Factors of one guide, or bounds of those of all guides.
struct hair_guide_factors {
    float stiffness, damping, shape_frequency, gravity_preload;
};

#endif
