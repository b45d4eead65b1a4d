// SPDX-License-Identifier: Apache-2.0
// The smallest glb that shows something, for tests of the reader to bend; and how they look at the result.
#pragma once

#include "runtime/base/error.h"
#include "runtime/scene/gltf.h"
#include "tests/unit/glb_builder.h"

namespace surimi::test {

inline constexpr double float_rounding = 1e-6;  // positions of about 1 m, stored as float

/// A unit square in the plane z = 0 whose front looks along +z: corners 0 to 3, counter-clockwise.
struct Square : GlbBuilder {
    Json& primitive;

    Square() : primitive(make_primitive()) {
        json["nodes"] = {{{"mesh", 0}}};
        json["scenes"] = {{{"nodes", {0}}}};
        json["scene"] = 0;
    }
    Json& make_primitive() {
        const int positions = add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
        json["meshes"] = {
            {{"primitives",
              {{{"attributes", {{"POSITION", positions}}}, {"indices", add_indices({0, 1, 2, 0, 2, 3})}}}}}};
        return json["meshes"][0]["primitives"][0];
    }
    Scene read() { return read_gltf(write(test_folder() / "square.glb")); }
};

/// What read_gltf says when it refuses the file; empty when it does not.
inline std::string refusal(const std::filesystem::path& path) {
    try {
        read_gltf(path);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        return error.what();
    }
    return "";
}

/// How often the notes whose text contains `part` were counted.
inline size_t note_count(const Scene& scene, const std::string& part) {
    size_t count = 0;
    for (const Note& note : scene.notes)
        if (note.what.find(part) != std::string::npos) count += note.count;
    return count;
}

inline void expect_near(const Vec3& actual, const Vec3& expected, double tolerance = float_rounding) {
    EXPECT_LE(glm::length(actual - expected), tolerance) << actual.x << " " << actual.y << " " << actual.z;
}

inline bool mentions(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace surimi::test
