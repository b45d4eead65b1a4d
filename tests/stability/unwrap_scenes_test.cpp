// SPDX-License-Identifier: Apache-2.0
// Real scenes, unwrapped and judged exactly.
#include "baker/unwrap/unwrap.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"
#include "tests/support/atlas_judge.h"

namespace surimi {
namespace {

std::vector<std::filesystem::path> scene_files(const char* folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::filesystem::path extension = entry.path().extension();
        if (extension == ".glb" || extension == ".gltf") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(UnwrapScenes, AreMappedOneToOneWithGutters) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "too slow with sanitizers; UnwrapMeshes stands for it";
#endif
    const char* folder = std::getenv("SURIMI_SCENES");
    if (!folder || !*folder) GTEST_SKIP() << "SURIMI_SCENES does not name a folder of scenes";
    size_t judged = 0;
    for (const std::filesystem::path& file : scene_files(folder)) {
        SCOPED_TRACE(file.filename());
        Scene scene;
        try {
            scene = read_gltf(file);
        } catch (const Error&) {
            continue;  // broken on purpose
        }
        if (triangle_count(scene) == 0) continue;
        UnwrapSettings settings;
        settings.width = settings.height = 1024;
        const Atlas atlas = unwrap(scene, settings, {});
        EXPECT_EQ(atlas.width, 1024);
        EXPECT_EQ(atlas.height, 1024);
        for (const std::string& fault : test::faults_of(scene, atlas)) ADD_FAILURE() << fault;
        ++judged;
    }
    EXPECT_GT(judged, 0u);
}

}  // namespace
}  // namespace surimi
