// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/roles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/base/error.h"
#include "runtime/scene/monitors.h"
#include "tests/unit/baked_file.h"
#include "tests/unit/role_marks.h"
#include "tests/unit/square_glb.h"

namespace surimi::test {
namespace {

/// Room > Chair > Chair_leg, and Table beside Chair; all but Room have a surface.
struct Furniture {
    Scene scene;

    Furniture() {
        scene.path = "room.glb";
        scene.materials.resize(1);
        add("Room", -1, false);
        add("Chair", 0);
        add("Chair_leg", 1);
        add("Table", 0);
    }
    int add(const std::string& name, int parent, bool has_surface = true) {
        Node node;
        node.name = name;
        node.parent = parent;
        node.is_in_scene = true;
        scene.nodes.push_back(node);
        const int index = static_cast<int>(scene.nodes.size()) - 1;
        if (!has_surface) return index;
        Surface surface;
        surface.name = name;
        surface.node = index;
        surface.material = 0;
        surface.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        surface.normals.assign(3, Vec3(0, 0, 1));
        surface.triangles = {{0, 1, 2}};
        scene.surfaces.push_back(surface);
        return index;
    }
    Node& node(const std::string& name) {
        return *std::ranges::find_if(scene.nodes, [&](const Node& n) { return n.name == name; });
    }
    Surface& surface(const std::string& name) {
        return *std::ranges::find_if(scene.surfaces, [&](const Surface& s) { return s.name == name; });
    }
    /// For each surface, what it does: C casts, R receives, 2 two-sided, x excluded, h not drawn.
    std::vector<std::string> roles(const RoleSettings& settings = {}) {
        apply_roles(scene, settings);
        std::vector<std::string> all;
        for (const Surface& s : scene.surfaces)
            all.push_back(std::string(s.casts ? "C" : "") + (s.receives ? "R" : "") + (s.is_two_sided ? "2" : "") +
                          (s.is_excluded ? "x" : "") + (s.is_drawn ? "" : "h"));
        return all;
    }
};

using Roles = std::vector<std::string>;  // of Chair, Chair_leg, Table

const RoleMarks casts_not = casts(false);
const RoleMarks receives_not = receives(false);
const RoleMarks excluded = exclude(true);

TEST(Roles, WithoutAWordEverythingCastsAndReceives) {
    Furniture room;
    EXPECT_EQ(room.roles(), (Roles{"CR", "CR", "CR"}));
    EXPECT_TRUE(room.scene.notes.empty());
    EXPECT_TRUE(apply_roles(room.scene, {}).empty());
}

TEST(Roles, ExtrasHoldForDescendantsAndTheNearestWins) {
    Furniture room;
    room.node("Chair").roles = casts_not;
    EXPECT_EQ(room.roles(), (Roles{"R", "R", "CR"}));
    room.node("Chair_leg").roles = RoleMarks{true, false, {}, {}};
    EXPECT_EQ(room.roles(), (Roles{"R", "C", "CR"}));
    room.node("Room").roles = RoleMarks{{}, false, true, {}};
    EXPECT_EQ(room.roles(), (Roles{"2", "C2", "C2"})) << "each role by itself";
    room.node("Table").roles = RoleMarks{{}, true, false, {}};
    EXPECT_EQ(room.roles()[2], "CR");
}

TEST(Roles, ChildrenMayComeBeforeTheirParents) {
    Furniture room;
    std::swap(room.scene.nodes[0], room.scene.nodes[3]);  // Room is last now
    room.scene.nodes[0].parent = room.scene.nodes[1].parent = 3;
    room.scene.surfaces[2].node = 0;
    room.node("Room").roles = excluded;
    EXPECT_EQ(room.roles(), (Roles{"x", "x", "x"}));
}

TEST(Roles, ExcludingIsNeitherCastingNorReceiving) {
    Furniture room;
    room.node("Chair").roles = excluded;
    EXPECT_EQ(room.roles(), (Roles{"x", "x", "CR"}));
    EXPECT_TRUE(room.node("Chair_leg").is_excluded);
    EXPECT_FALSE(room.node("Room").is_excluded);
    room.node("Chair_leg").roles = exclude(false);
    EXPECT_EQ(room.roles(), (Roles{"x", "CR", "CR"}));
    room.node("Chair_leg").roles = casts(true);
    EXPECT_EQ(room.roles(), (Roles{"x", "C", "CR"})) << "nearer than the exclusion";
    room.node("Chair").roles = RoleMarks{false, false, {}, {}};
    room.node("Chair_leg").roles = exclude(false);
    EXPECT_EQ(room.roles(), (Roles{"", "", "CR"})) << "there is no exclusion to take back";
    room.node("Room").roles = RoleMarks{true, true, {}, {}};
    room.node("Chair").roles = excluded;
    room.node("Chair_leg").roles = {};
    EXPECT_EQ(room.roles(), (Roles{"x", "x", "CR"})) << "nearer than what Room says";
}

TEST(Roles, ObjectsWinOverExtrasAndThoseOverNames) {
    Furniture room;
    room.node("Chair").roles = casts_not;
    EXPECT_EQ(room.roles({.objects = {{"Room", casts(true)}}}), (Roles{"CR", "CR", "CR"}))
        << "from farther away than extras";
    EXPECT_EQ(room.roles({.objects = {{"Table", casts_not}}}), (Roles{"R", "R", "R"}));
    room.add("Chair_collider", 0);
    EXPECT_EQ(room.roles()[3], "xh");
    room.node("Room").roles = exclude(false);
    EXPECT_EQ(room.roles()[3], "CR") << "extras of an ancestor";
    room.node("Room").roles = {};
    EXPECT_EQ(room.roles({.objects = {{"*_collider", exclude(false)}}})[3], "CR");
    EXPECT_EQ(room.roles({.objects = {{"*_collider", receives(true)}}})[3], "R");
    EXPECT_EQ(room.roles({.objects = {{"Chair*", excluded}}})[3], "x") << "the user's, so it is drawn";
    room.node("Chair_collider").roles = casts_not;
    EXPECT_EQ(room.roles({.objects = {{"*_collider", exclude(false)}}})[3], "R") << "its own extras stay";
}

TEST(Roles, OfObjectsTheNearestWinsAndThenTheLater) {
    Furniture room;
    EXPECT_EQ(room.roles({.objects = {{"Chair", casts_not}, {"Room", casts(true)}}}), (Roles{"R", "R", "CR"}));
    EXPECT_EQ(room.roles({.objects = {{"*", casts_not}, {"T?ble", casts(true)}}}), (Roles{"R", "R", "CR"}));
    EXPECT_EQ(room.roles({.objects = {{"T?ble", casts(true)}, {"*", casts_not}}}), (Roles{"R", "R", "R"}));
    EXPECT_EQ(room.roles({.objects = {{"Table", casts_not}, {"Table", receives_not}}}), (Roles{"CR", "CR", ""}));
}

TEST(Roles, SurfacesOfAMeshHaveNamesToo) {
    Furniture room;
    room.scene.surfaces[0].name = "Chair/0";
    room.scene.surfaces[1].name = "Chair/1";
    room.scene.surfaces[1].node = room.scene.surfaces[0].node;
    EXPECT_EQ(room.roles({.objects = {{"Chair/1", receives_not}, {"Chair", receives(true)}}}),
              (Roles{"CR", "C", "CR"}));
    EXPECT_EQ(room.roles({.objects = {{"Chair/?", excluded}}}), (Roles{"x", "x", "CR"}));
}

TEST(Roles, AnObjectForNothingIsAnErrorThatNamesTheNearest) {
    Furniture room;
    EXPECT_NO_THROW(room.roles({.objects = {{"Room", casts_not}}})) << "a node without a mesh of its own";
    try {
        room.roles({.objects = {{"Tabel*", casts_not}}});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_TRUE(mentions(error.what(), "object \"Tabel*\"")) << error.what();
        EXPECT_TRUE(mentions(error.what(), "nearest is \"Table\"")) << error.what();
    }
}

TEST(Roles, CollisionMeshesAreKnownByTheirNames) {
    for (const char* name :
         {"Floor_collider", "floor_COLLISION", "Floor_collider.001", "UCX_Chair", "ucx_Chair_01", "UBX_Box",
          "USP_Ball.012", "UCP_Pill", "Wall-colonly", "Wall-convcolonly.002", "Wall_ConvColOnly", "Wall$colonly"})
        EXPECT_TRUE(is_collision_name(name)) << name;
    for (const char* name :
         {"Floor", "Collider", "collision", "Floor_collider_shape", "Floor_collider.1", "My_UCX_Chair", "UCXChair",
          "Wall-col", "-colonly", "colonly", "Floorcollider", "", ".001"})
        EXPECT_FALSE(is_collision_name(name)) << name;
    Furniture room;
    room.add("Chair_collision.001", 1);
    const int group = room.add("Shapes-colonly", 0, false);
    room.add("Shape", group);
    EXPECT_EQ(room.roles(), (Roles{"CR", "CR", "CR", "xh", "xh"}));
    ASSERT_EQ(room.scene.notes.size(), 1u);
    EXPECT_TRUE(mentions(room.scene.notes[0].what, "collision meshes")) << room.scene.notes[0].what;
    EXPECT_EQ(room.scene.notes[0].count, 2u);
    EXPECT_EQ(room.scene.notes[0].where, "Chair_collision.001");
}

TEST(Roles, GlassIsAWallOrAir) {
    for (const bool is_blended : {false, true}) {
        Furniture room;
        Material& glass = room.scene.materials.emplace_back();
        if (is_blended)
            glass.alpha_mode = AlphaMode::blend;
        else
            glass.transmission = 0.01;
        room.surface("Table").material = room.surface("Chair").material = 1;
        EXPECT_EQ(room.roles({Glass::block, {}}), (Roles{"CR", "CR", "CR"}));
        ASSERT_EQ(room.scene.notes.size(), 1u);
        EXPECT_TRUE(mentions(room.scene.notes[0].what, "--glass clear")) << room.scene.notes[0].what;
        EXPECT_EQ(room.scene.notes[0].count, 2u);
        EXPECT_EQ(room.scene.notes[0].where, "Chair");
        room.scene.notes.clear();
        EXPECT_EQ(room.roles({Glass::clear, {}}), (Roles{"R", "CR", "R"}));
        ASSERT_EQ(room.scene.notes.size(), 1u);
        EXPECT_TRUE(mentions(room.scene.notes[0].what, "--glass block")) << room.scene.notes[0].what;
        EXPECT_EQ(room.scene.notes[0].count, 2u);
        room.node("Table").roles = casts(true);
        EXPECT_EQ(room.roles({Glass::clear, {}}), (Roles{"R", "CR", "CR"})) << "the user knows better";
        room.node("Table").roles = casts_not;
        EXPECT_EQ(room.roles({Glass::block, {}}), (Roles{"CR", "CR", "R"}));
    }
}

TEST(Roles, FoliageIsTwoSided) {
    Furniture room;
    Material& leaves = room.scene.materials[0];
    leaves.alpha_mode = AlphaMode::mask;
    EXPECT_EQ(room.roles()[0], "CR");
    leaves.double_sided = true;
    EXPECT_EQ(room.roles()[0], "CR2");
    EXPECT_EQ(note_count(room.scene, "alpha-masked double-sided"), 3u);
    room.node("Chair").roles = two_sided(false);
    EXPECT_EQ(room.roles(), (Roles{"CR", "CR", "CR2"}));
    leaves.alpha_mode = AlphaMode::opaque;
    EXPECT_EQ(room.roles()[2], "CR");
    EXPECT_EQ(room.roles({.objects = {{"Table", two_sided(true)}}}), (Roles{"CR", "CR", "CR2"}));
}

TEST(Roles, WhatIsUnusualIsAnnouncedWithItsReason) {
    Furniture room;
    room.add("Hull_collider", 0);
    room.node("Chair").roles = casts_not;
    const auto unusual = apply_roles(room.scene, {.objects = {{"Table", RoleMarks{{}, false, true, {}}}}});
    ASSERT_EQ(unusual.size(), 4u);
    EXPECT_EQ(unusual[0].why, "casts no shadow (extras of Chair)");
    EXPECT_EQ(unusual[1].why, "casts no shadow (extras of Chair)");
    EXPECT_EQ(unusual[2].surface, 2u);
    EXPECT_EQ(unusual[2].why, "gets no texels ([[object]] \"Table\"), counts on both sides ([[object]] \"Table\")");
    EXPECT_EQ(unusual[3].why, "left out of the bake (collision mesh by the name of Hull_collider)");
    EXPECT_EQ(note_count(room.scene, "cast no shadow by extras.casts"), 2u);
    EXPECT_EQ(note_count(room.scene, "get no texels by [[object]]"), 1u);
    EXPECT_EQ(note_count(room.scene, "count on both sides by [[object]]"), 1u);
    EXPECT_EQ(note_count(room.scene, "collision meshes"), 1u);
    room.scene.notes.clear();
    room.node("Chair").roles = RoleMarks{{}, true, {}, true};
    apply_roles(room.scene, {.objects = {{"Table", excluded}}});
    EXPECT_EQ(note_count(room.scene, "cast no shadow by extras.exclude"), 2u);
    EXPECT_EQ(note_count(room.scene, "left out of the bake by [[object]]"), 1u);
}

TEST(RolesOfFiles, ExtrasAreTrueFalseOneOrZero) {
    QuadFile file;
    file.json["nodes"][0]["extras"] = {{"casts", false}, {"receives", 0}, {"two_sided", 1}, {"exclude", 0.0}};
    const Scene scene = read_gltf(file.write(test_folder() / "room.glb"));
    const RoleMarks& roles = scene.nodes[0].roles;
    EXPECT_EQ(roles.casts, false);
    EXPECT_EQ(roles.receives, false);
    EXPECT_EQ(roles.two_sided, true);
    EXPECT_EQ(roles.exclude, false);
    EXPECT_TRUE(scene.notes.empty());
}

TEST(RolesOfFiles, OtherExtrasAreIgnoredWithANote) {
    QuadFile file;
    file.json["nodes"][0]["extras"] = {
        {"casts", "no"}, {"receives", 2}, {"two_sided", Json::array()}, {"exclude", nullptr}};
    file.add_node({{"name", "Other"}, {"mesh", 0}, {"extras", "text"}});
    file.add_node({{"name", "Third"}, {"mesh", 0}, {"extras", {{"casts", Json::object()}}}});
    const Scene scene = read_gltf(file.write(test_folder() / "room.glb"));
    for (const Node& node : scene.nodes) {
        EXPECT_FALSE(node.roles.casts || node.roles.receives || node.roles.two_sided || node.roles.exclude);
    }
    EXPECT_EQ(note_count(scene, "extras.casts is none of true, false, 1, 0; ignored"), 2u);
    EXPECT_EQ(note_count(scene, "extras.receives is none of"), 1u);
    EXPECT_EQ(note_count(scene, "extras.two_sided is none of"), 1u);
    EXPECT_EQ(note_count(scene, "extras.exclude"), 0u) << "null is nothing";
}

TEST(RolesOfFiles, MirroredAndZeroScaleNodesHaveRoles) {
    QuadFile file;
    file.add_node({{"name", "Mirrored_collider"}, {"mesh", 0}, {"scale", {-1, 1, 1}}});
    file.add_node({{"name", "Flat"}, {"mesh", 0}, {"scale", {0, 0, 0}}});
    file.add_node({{"name", "Turned"}, {"mesh", 0}, {"scale", {-2, 1, 1}}, {"extras", {{"casts", false}}}});
    Scene scene = read_gltf(file.write(test_folder() / "room.glb"));
    ASSERT_EQ(scene.surfaces.size(), 3u) << "no triangle of Flat is left";
    EXPECT_NO_THROW(apply_roles(scene, {.objects = {{"Flat", excluded}}})) << "the node is there";
    EXPECT_TRUE(scene.surfaces[1].is_excluded);
    EXPECT_FALSE(scene.surfaces[2].casts);
    EXPECT_TRUE(scene.surfaces[2].receives);
    EXPECT_EQ(bounds(scene).low.x, -2) << "the excluded mirror image reaches to -1";
    EXPECT_EQ(bounds(scene).high.x, 1);
}

/// The monitors' names, after roles.
std::vector<std::string> monitors_of(Scene& scene, const MonitorRequest& request = {}) {
    apply_roles(scene, {});
    find_monitors(scene, request);
    std::vector<std::string> names;
    for (const Monitor& monitor : scene.monitors) names.push_back(monitor.name);
    return names;
}

MonitorRequest named(const std::string& node) {
    MonitorRequest request;
    request.command_line = {{node, {}}};
    return request;
}

TEST(RolesOfMonitors, ExcludedNodesAreNoneUnlessNamed) {
    QuadFile file;
    file.json["materials"] = {{{"emissiveFactor", {1, 1, 1}}, {"extras", {{"monitor", true}}}}};
    file.first_primitive()["material"] = 0;
    file.json["nodes"][0] = {{"name", "Screen"}, {"mesh", 0}};
    file.add_node({{"name", "Monitor_R"}, {"mesh", 0}, {"extras", {{"exclude", true}, {"monitor", true}}}});
    file.add_node({{"name", "Lamp"}, {"extras", {{"exclude", 1}, {"monitor_size", {1, 1}}}}});
    Scene scene = read_gltf(file.write(test_folder() / "room.glb"));
    EXPECT_EQ(monitors_of(scene), (std::vector<std::string>{"Screen"}));
    EXPECT_EQ(monitors_of(scene, named("Monitor_R")), (std::vector<std::string>{"Monitor_R"}));
    EXPECT_EQ(monitors_of(scene, named("Lamp")), (std::vector<std::string>{"Lamp"}));
    scene.materials[0].is_marked_monitor = false;
    EXPECT_EQ(monitors_of(scene), (std::vector<std::string>{"Screen"})) << "by its name";
    scene.nodes[0].name = "Panel";
    EXPECT_EQ(monitors_of(scene), (std::vector<std::string>{"Screen"})) << "by its shine, as the surface is called";
    scene.nodes[0].roles = excluded;
    EXPECT_THROW(monitors_of(scene), Error);
}

TEST(RolesOfMonitors, AMonitorThatNeitherCastsNorReceivesIsOne) {
    QuadFile file;
    file.json["nodes"][0] = {{"name", "Screen"}, {"mesh", 0}, {"extras", {{"casts", 0}, {"receives", 0}}}};
    Scene scene = read_gltf(file.write(test_folder() / "room.glb"));
    EXPECT_EQ(monitors_of(scene), (std::vector<std::string>{"Screen"}));
    EXPECT_FALSE(scene.surfaces[0].casts || scene.surfaces[0].receives);
}

TEST(RolesOfMonitors, AGroupDoesNotTakeItsCollisionMeshes) {
    QuadFile file;
    file.json["nodes"] = {{{"name", "TV"}, {"children", {1, 2}}},
                          {{"name", "Glass"}, {"mesh", 0}},
                          {{"name", "TV_collider"}, {"mesh", 0}, {"translation", {0, 0, 1}}}};
    Scene scene = read_gltf(file.write(test_folder() / "room.glb"));
    EXPECT_EQ(monitors_of(scene, named("TV")), (std::vector<std::string>{"TV"}));
    EXPECT_EQ(scene.surfaces[0].monitor, 0);
    EXPECT_EQ(scene.surfaces[1].monitor, -1);
    scene.nodes[0].roles = excluded;
    EXPECT_EQ(monitors_of(scene, named("TV")), (std::vector<std::string>{"TV"}));
    EXPECT_EQ(scene.surfaces[0].monitor, 0) << "all of an excluded group that is named";
}

}  // namespace
}  // namespace surimi::test
