// SPDX-License-Identifier: Apache-2.0
#include "baker/unwrap/texel_scale.h"

#include <gtest/gtest.h>

#include "runtime/base/error.h"

namespace surimi {
namespace {

/// Room > Chair > Chair_leg, and Table beside Chair; all but Room have a mesh.
struct Furniture {
    Scene scene;

    Furniture() {
        scene.path = "room.glb";
        scene.materials.resize(2);
        scene.materials[0].name = "Wood";
        scene.materials[1].name = "Steel";
        add("Room", -1, -1);
        add("Chair", 0, 0);
        add("Chair_leg", 1, 1);
        add("Table", 0, 0);
    }
    void add(const std::string& name, int parent, int material) {
        Node node;
        node.name = name;
        node.parent = parent;
        node.is_in_scene = true;
        scene.nodes.push_back(node);
        if (material < 0) return;
        Surface surface;
        surface.name = name;
        surface.node = static_cast<int>(scene.nodes.size()) - 1;
        surface.material = material;
        scene.surfaces.push_back(surface);
    }
    std::vector<double> scales(const std::vector<TexelScale>& wishes) const { return texel_scales(scene, wishes); }
};

using Scales = std::vector<double>;  // of Chair, Chair_leg, Table

TEST(TexelScale, HoldsForDescendantsTimesTheMaterial) {
    Furniture room;
    EXPECT_EQ(room.scales({}), (Scales{1, 1, 1}));
    room.scene.nodes[1].texel_scale = 0.5;
    EXPECT_EQ(room.scales({}), (Scales{0.5, 0.5, 1}));
    room.scene.nodes[0].texel_scale = 4;
    EXPECT_EQ(room.scales({}), (Scales{2, 2, 4}));
    room.scene.materials[0].texel_scale = 3;
    EXPECT_EQ(room.scales({}), (Scales{6, 2, 12}));
    room.scene.nodes[1].texel_scale = room.scene.nodes[2].texel_scale = 1000;
    EXPECT_EQ(room.scales({}), (Scales{1000, 1000, 12})) << "kept within bounds";
}

TEST(TexelScale, ChildrenMayComeBeforeTheirParents) {
    Furniture room;
    std::swap(room.scene.nodes[0], room.scene.nodes[3]);  // Room is last now
    room.scene.nodes[0].parent = room.scene.nodes[1].parent = 3;
    room.scene.surfaces[2].node = 0;
    room.scene.nodes[3].texel_scale = 0.5;
    EXPECT_EQ(room.scales({}), (Scales{0.5, 0.5, 0.5}));
}

TEST(TexelScale, WishesAreGlobsAndCountOnce) {
    const Furniture room;
    EXPECT_EQ(room.scales({{"Chair*", "", 0.5}}), (Scales{0.5, 0.5, 1})) << "once, though parent and child match";
    EXPECT_EQ(room.scales({{"Chair_leg", "", 0.5}}), (Scales{1, 0.5, 1}));
    EXPECT_EQ(room.scales({{"Room", "", 2}, {"T?ble", "", 3}}), (Scales{2, 2, 6}));
    EXPECT_EQ(room.scales({{"", "Wood", 2}}), (Scales{2, 1, 2}));
    EXPECT_EQ(room.scales({{"Chair", "S*", 2}}), (Scales{1, 2, 1})) << "both have to match";
}

TEST(TexelScale, SurfacesOfAMeshHaveNamesToo) {
    Furniture room;
    room.scene.surfaces[0].name = "Chair/0";
    EXPECT_EQ(room.scales({{"Chair/*", "", 2}}), (Scales{2, 1, 1}));
}

TEST(TexelScale, AWishForNothingIsAnErrorThatNamesIt) {
    const auto message = [](const TexelScale& wish) -> std::string {
        try {
            Furniture().scales({wish});
        } catch (const Error& e) {
            EXPECT_EQ(e.kind(), ErrorKind::usage);
            return e.what();
        }
        ADD_FAILURE() << "no error";
        return "";
    };
    EXPECT_NE(message({"Tabel", "", 2}).find("node \"Tabel\""), std::string::npos);
    EXPECT_NE(message({"Tabel", "", 2}).find("\"Table\""), std::string::npos) << "the nearest";
    EXPECT_NE(message({"", "Gold*", 2}).find("material \"Gold*\""), std::string::npos);
    EXPECT_NE(message({"Table", "Steel", 2}).find("node \"Table\" with material \"Steel\""), std::string::npos);
}

}  // namespace
}  // namespace surimi
