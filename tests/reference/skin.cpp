// skin.cpp - Linear blend skinning of a vertex.
#include "tests/reference/convert.h"

void hair_reference_skin(const float rest[3], const uint16_t joints[4], const float weights[4],
                         const float* matrices, double position[3])
{
    const Eigen::Vector3d at = Eigen::Map<const Eigen::Vector3f>(rest).cast<double>();
    Vector3d sum(0, 0, 0);
    double weight = 0;
    for (int i = 0; i < 4; ++i) {
        const Eigen::Matrix4d m =
            Eigen::Map<const Eigen::Matrix4f>(matrices + 16 * static_cast<size_t>(joints[i])).cast<double>();
        sum += static_cast<double>(weights[i]) * (m * at.homogeneous()).head<3>();
        weight += static_cast<double>(weights[i]);
    }
    store(sum / weight, position);
}
