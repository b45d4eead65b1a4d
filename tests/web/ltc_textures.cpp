// SPDX-License-Identifier: Apache-2.0
// Writes our fit of the lobes as the two textures that three.js looks up: 64 x 64 texels of four floats, one after the
// other. With them three.js and `preview --model three` differ in nothing but rounding.
#include <cstdio>
#include <vector>

#include "runtime/ltc/table.h"
#include "runtime/shade/published.h"

int main(int argc, char** argv) {
    using namespace surimi;
    if (argc != 2) {
        std::fputs("usage: ltc_textures FILE\n", stderr);
        return 2;
    }
    std::vector<float> matrices, albedos;
    for (int row = 0; row < ltc_size; ++row)
        for (int column = 0; column < ltc_size; ++column) {
            const float last = ltc_size - 1, v = static_cast<float>(row) / last;
            const auto lobe = published::lobe_at(static_cast<float>(column) / last, 1 - v * v);
            const glm::mat3& m = lobe.inverse;
            matrices.insert(matrices.end(), {m[0].x, m[0].z, m[2].x, m[2].z});
            albedos.insert(albedos.end(), {lobe.albedo, lobe.fresnel, 0, 0});
        }
    std::FILE* file = std::fopen(argv[1], "wb");
    if (file == nullptr) return 6;
    bool is_written = true;
    for (const auto* texture : {&matrices, &albedos})
        is_written =
            is_written && std::fwrite(texture->data(), sizeof(float), texture->size(), file) == texture->size();
    return std::fclose(file) == 0 && is_written ? 0 : 6;
}
