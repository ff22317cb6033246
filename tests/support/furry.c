// furry.c - fur on a scalp with attributes of strands.
#include "tests/support/furry.h"

void hair_test_furry_make(struct hair_test_host* host, hair_strand_attribute_kind kind,
                          struct hair_test_furry* furry)
{
    furry->strands = hair_test_fur(HAIR_TEST_FURRY_STRANDS);
    furry->scalp = hair_test_scalp_make(HAIR_TEST_FURRY_CELLS, 1);
    furry->desc = hair_test_groom_desc(host, &furry->strands);
    hair_test_set_scalp(&furry->desc, &furry->scalp);
    for (int i = 0; i < 2; ++i) {
        furry->attributes[i] = hair_strand_attribute_default();
        furry->attributes[i].kind = kind;
    }
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_STRANDS; ++i) furry->of_strands[i] = 1 + 0.01f * (float)i;
    for (uint32_t i = 0; i < HAIR_TEST_FURRY_VERTICES; ++i) {
        const float* p = furry->scalp.positions + 3 * (size_t)i;
        furry->of_vertices[i] = 1 + 2 * p[0];
        furry->uvs[2 * i] = p[0], furry->uvs[2 * i + 1] = p[2];
    }
    for (uint32_t i = 0; i < 2 * HAIR_TEST_FURRY_CELLS * HAIR_TEST_FURRY_CELLS; ++i)
        furry->of_triangles[i] = 0.5f * (float)i;
    furry->attributes[0].strand_values = furry->of_strands;
    furry->attributes[1].map.source = HAIR_MAP_SOURCE_VERTICES;
    furry->attributes[1].map.values = furry->of_vertices;
    furry->desc.scalp_uvs = furry->uvs;
    furry->desc.strand_attributes = furry->attributes;
    furry->desc.strand_attribute_count = 2;
}

void hair_test_furry_free(struct hair_test_furry* furry)
{
    hair_test_strands_free(&furry->strands);
    hair_test_scalp_free(&furry->scalp);
}
