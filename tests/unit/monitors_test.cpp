// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/monitors.h"

#include "runtime/base/error.h"
#include "runtime/scene/node_names.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace surimi {
namespace {

/// Adds a node with one surface: a rectangle around `center` whose front is the side of cross(u, v).
Surface& add_rectangle(Scene& scene, const std::string& name, const Vec3& center = Vec3(0),
                       const Vec3& u = Vec3(1, 0, 0), const Vec3& v = Vec3(0, 1, 0)) {
    Node node;
    node.name = name;
    node.mesh = static_cast<int>(scene.surfaces.size());
    node.is_in_scene = true;
    scene.nodes.push_back(node);
    Surface surface;
    surface.name = name;
    surface.node = static_cast<int>(scene.nodes.size()) - 1;
    surface.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
    surface.normals.assign(4, glm::normalize(glm::cross(u, v)));
    surface.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.surfaces.push_back(surface);
    return scene.surfaces.back();
}

/// Gives the surface a material of its own that shines.
Material& make_emissive(Scene& scene, Surface& surface, const Vec3& emissive) {
    surface.material = static_cast<int>(scene.materials.size());
    Material material;
    material.name = "glow";
    material.emissive = emissive;
    scene.materials.push_back(material);
    return scene.materials.back();
}

Node& add_empty(Scene& scene, const std::string& name) {
    Node node;
    node.name = name;
    node.is_in_scene = true;
    scene.nodes.push_back(node);
    return scene.nodes.back();
}

std::vector<std::string> found(Scene& scene, const MonitorRequest& request = {}) {
    find_monitors(scene, request);
    std::vector<std::string> names(3, "-");
    for (const Monitor& m : scene.monitors) names[static_cast<size_t>(m.channel)] = m.name;
    return names;
}

std::string refusal(Scene& scene, const MonitorRequest& request, ErrorKind kind) {
    try {
        find_monitors(scene, request);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return "";
}

size_t note_count(const Scene& scene, const std::string& part) {
    return static_cast<size_t>(std::count_if(scene.notes.begin(), scene.notes.end(),
                                             [&](const Note& n) { return n.what.find(part) != std::string::npos; }));
}

bool mentions(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

using Names = std::vector<std::string>;

TEST(MonitorNames, SuffixesChooseTheChannel) {
    Scene scene;
    for (const char* name : {"Wall", "Monitor_B", "screen.r", "TV-G.001", "tvset", "My Monitor_R"})
        add_rectangle(scene, name);
    EXPECT_EQ(found(scene), (Names{"screen.r", "TV-G.001", "Monitor_B"}));
    EXPECT_EQ(scene.surfaces[0].monitor, -1);
    EXPECT_EQ(scene.surfaces[1].monitor, 2);
    EXPECT_EQ(scene.surfaces[2].monitor, 0);
    EXPECT_TRUE(mentions(scene.monitors[0].reason, "node name screen.r"));
}

TEST(MonitorNames, WithoutSuffixInOrderOfName) {
    Scene scene;
    for (const char* name : {"Screen right", "Display", "screens_left"}) add_rectangle(scene, name);
    EXPECT_EQ(found(scene), (Names{"Display", "Screen right", "screens_left"}));
}

TEST(MonitorNames, AmbiguousSuffixesAreIgnored) {
    Scene scene;
    for (const char* name : {"TV_R", "Monitor_R"}) add_rectangle(scene, name);
    EXPECT_EQ(found(scene), (Names{"Monitor_R", "TV_R", "-"}));
}

TEST(MonitorNames, MaterialNamesCountWhereNoNodeHasOne) {
    Scene scene;
    make_emissive(scene, add_rectangle(scene, "Room"), Vec3(2, 4, 6)).name = "Screen_G";
    EXPECT_EQ(found(scene), (Names{"-", "Room", "-"}));
    EXPECT_TRUE(mentions(scene.monitors[0].reason, "material name Screen_G"));
    EXPECT_EQ(scene.monitors[0].radiance, Vec3(2, 4, 6));
}

TEST(MonitorNames, GroupsTakeTheMeshesBelowThem) {
    Scene scene;
    add_empty(scene, "Monitors");
    add_empty(scene, "TV");
    add_rectangle(scene, "Monitor_R", Vec3(0));
    add_rectangle(scene, "panel", Vec3(5, 0, 0));
    scene.nodes[2].parent = 0;  // the group of that name must not swallow it
    scene.nodes[3].parent = 1;
    EXPECT_EQ(found(scene), (Names{"Monitor_R", "TV", "-"}));
    EXPECT_EQ(scene.surfaces[1].monitor, 1);
}

TEST(MonitorNames, TheCaseOfAScreenIsNotPartOfIt) {
    Scene scene;
    make_emissive(scene, add_rectangle(scene, "TV"), Vec3(1));
    Surface back = scene.surfaces[0];
    back.material = -1;
    std::swap(back.triangles[0][0], back.triangles[0][1]);
    scene.surfaces.push_back(back);
    found(scene);
    EXPECT_EQ(scene.surfaces[0].monitor, 0);
    EXPECT_EQ(scene.surfaces[1].monitor, -1);
    EXPECT_EQ(note_count(scene, "do not shine"), 1u);
}

TEST(MonitorNames, EqualNamesBecomeUnique) {
    Scene scene;
    for (int i = 0; i < 3; ++i) add_rectangle(scene, "TV", Vec3(3 * i, 0, 0));
    EXPECT_EQ(found(scene), (Names{"TV", "TV_2", "TV_3"}));
}

TEST(MonitorExtras, NodesAndMaterialsName) {
    Scene scene;
    add_rectangle(scene, "a");
    scene.nodes[0].is_marked_monitor = true;
    scene.nodes[0].monitor_channel = 2;
    Material& material = make_emissive(scene, add_rectangle(scene, "b", Vec3(3, 0, 0)), Vec3(1));
    material.is_marked_monitor = true;
    material.is_two_sided_monitor = true;
    add_rectangle(scene, "Monitor_R", Vec3(6, 0, 0));  // an earlier rule has won
    EXPECT_EQ(found(scene), (Names{"b", "-", "a"}));
    EXPECT_TRUE(scene.monitors[0].two_sided);
    EXPECT_FALSE(scene.monitors[1].two_sided);
    EXPECT_EQ(scene.monitors[1].radiance, Vec3(1));
    EXPECT_EQ(note_count(scene, "radiance of 1"), 1u);
}

TEST(MonitorExtras, BlendersTrueIsNotChannelG) {
    Scene scene;
    for (const char* name : {"a", "b"}) {
        add_rectangle(scene, name);
        scene.nodes.back().is_marked_monitor = true;
        scene.nodes.back().monitor_channel = 1;
    }
    EXPECT_EQ(found(scene), (Names{"a", "b", "-"}));
    EXPECT_EQ(note_count(scene, "taken as true"), 1u);
}

TEST(MonitorExtras, EmptyNodeWithSizeIsARectangleFacingItsZ) {
    Scene scene;
    Node& node = add_empty(scene, "empty");
    node.monitor_size = Vec2(4, 2);
    node.to_world = Mat4(0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 1, 0, 1);  // +z of the node is +x of the world
    found(scene);
    const Polygon& panel = scene.monitors[0].panels.at(0);
    EXPECT_NEAR(area(panel), 8, 1e-12);
    EXPECT_NEAR(glm::length(front_normal(panel) - Vec3(1, 0, 0)), 0, 1e-12);
    EXPECT_NEAR(panel.corners[0].x, 5, 1e-12);
}

/// A scene with an EXT_lights_area rectangle of 2 x 1 that faces -z, and a quad of that size at distance
/// `gap`.
Scene light_and_quad(double gap) {
    Scene scene;
    Node& light = add_empty(scene, "Monitor_light");
    light.area_light_size = Vec2(2, 1);
    light.area_light_radiance = Vec3(500);
    add_rectangle(scene, "Monitor_B", Vec3(0, 0, gap), Vec3(-1, 0, 0), Vec3(0, 0.5, 0));
    return scene;
}

TEST(AreaLights, TheQuadThatShowsItIsTheMonitorsOwn) {
    Scene scene = light_and_quad(0.005);
    EXPECT_EQ(found(scene), (Names{"-", "-", "Monitor_B"}));
    EXPECT_EQ(scene.surfaces[0].monitor, 0);
    EXPECT_EQ(scene.monitors[0].radiance, Vec3(500));
    EXPECT_NEAR(glm::length(front_normal(scene.monitors[0].panels[0]) - Vec3(0, 0, -1)), 0, 1e-12);
    EXPECT_NEAR(area(scene.monitors[0]), 2, 1e-12);
}

TEST(AreaLights, AQuadFartherAwayIsNot) {
    Scene scene = light_and_quad(0.1);
    EXPECT_EQ(found(scene), (Names{"Monitor_light", "-", "-"}));
    EXPECT_EQ(scene.surfaces[0].monitor, -1);
}

TEST(AreaLights, OnlyTheLargestScaleCounts) {
    Scene scene = light_and_quad(0.1);
    scene.nodes[0].to_world = Mat4(3, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    found(scene);
    EXPECT_NEAR(area(scene.monitors[0]), 2 * 9, 1e-12);
}

TEST(AutomaticMonitors, RectanglesByFlux) {
    Scene scene;
    make_emissive(scene, add_rectangle(scene, "small"), Vec3(1));
    make_emissive(scene, add_rectangle(scene, "bright", Vec3(5, 0, 0)), Vec3(100));
    make_emissive(scene, add_rectangle(scene, "big", Vec3(0, 0, 9), Vec3(4, 0, 0)), Vec3(2));
    EXPECT_EQ(found(scene), (Names{"bright", "big", "small"}));
}

TEST(AutomaticMonitors, MoreThanThreeListsThemWithTheLineToPaste) {
    Scene scene;
    double nits = 0;
    for (const char* name : {"a", "b c", "d", "e"}) make_emissive(scene, add_rectangle(scene, name), Vec3(++nits));
    const std::string message = refusal(scene, {}, ErrorKind::nothing_to_bake);
    EXPECT_TRUE(mentions(message, "4 monitors"));
    EXPECT_TRUE(mentions(message, "--monitor e --monitor d --monitor 'b c'")) << message;
    EXPECT_TRUE(mentions(message, "a: flux 12.57 lm, area 4 m2")) << message;  // 1 nit, 4 square metres, pi
}

TEST(AutomaticMonitors, ShapesThatAreNoRectanglesAreNotedAndListed) {
    Scene scene;
    Surface& bent = add_rectangle(scene, "Lamp");
    bent.positions[2].z = 0.5;
    make_emissive(scene, bent, Vec3(1));
    Surface& slanted = add_rectangle(scene, "Sign");
    slanted.positions[2].x = 3;
    make_emissive(scene, slanted, Vec3(1));
    const std::string message = refusal(scene, {}, ErrorKind::nothing_to_bake);
    EXPECT_TRUE(mentions(message, "Lamp: 2 triangles, not planar")) << message;
    EXPECT_TRUE(mentions(message, "Sign: 2 triangles, planar, but no rectangle")) << message;
    EXPECT_EQ(note_count(scene, "no monitor: Lamp"), 1u);
}

TEST(AutomaticMonitors, NothingAtAllExplainsHowToNameOne) {
    Scene scene;
    add_rectangle(scene, "wall");
    const std::string message = refusal(scene, {}, ErrorKind::nothing_to_bake);
    for (const char* way : {"Monitor_R", "monitor = \"R\"", "--monitor", "[[monitor]]", "emissive"})
        EXPECT_TRUE(mentions(message, way)) << way;
}

TEST(SelectedMonitors, GlobsAndChannels) {
    Scene scene;
    for (const char* name : {"wall", "led 1", "led 2", "tv"}) add_rectangle(scene, name);
    EXPECT_EQ(found(scene, {{{"led ?", std::nullopt}, {"t*", 0}}, {}, {}}), (Names{"tv", "led 1", "led 2"}));
}

TEST(SelectedMonitors, NamesThatMatchNothingAreUsageErrors) {
    Scene scene;
    add_rectangle(scene, "Television");
    add_empty(scene, "empty");
    EXPECT_TRUE(mentions(refusal(scene, {{{"Televison", {}}}, {}, {}}, ErrorKind::usage), "nearest is \"Television\""));
    EXPECT_TRUE(mentions(refusal(scene, {{{"empty", {}}}, {}, {}}, ErrorKind::usage), "no surface"));
}

TEST(SelectedMonitors, TwoForOneChannelAreRefused) {
    Scene scene;
    for (const char* name : {"a", "b"}) add_rectangle(scene, name);
    EXPECT_TRUE(
        mentions(refusal(scene, {{{"a", 1}, {"b", 1}}, {}, {}}, ErrorKind::nothing_to_bake), "both claim channel G"));
}

TEST(SelectedMonitors, RectanglesOfTheConfiguration) {
    Scene scene;
    MonitorRectangles wall{
        "wall", 1, Vec3(3), {{Vec3(0), Vec3(1, 0, 0), Vec3(0, 2, 0)}, {Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0)}}};
    EXPECT_EQ(found(scene, {{}, {}, {wall}}), (Names{"-", "wall", "-"}));
    EXPECT_NEAR(area(scene.monitors[0]), 16, 1e-12);
    EXPECT_EQ(front_normal(scene.monitors[0].panels[0]), Vec3(0, 0, 1));
    EXPECT_EQ(scene.monitors[0].node, -1);
    wall.rectangles[0].half_v = Vec3(2, 0, 0);
    EXPECT_TRUE(mentions(refusal(scene, {{}, {}, {wall}}, ErrorKind::usage), "span an area"));
}

TEST(MonitorSelectors, AreParsed) {
    EXPECT_EQ(parse_monitor_selector("TV").node, "TV");
    EXPECT_FALSE(parse_monitor_selector("TV").channel);
    EXPECT_EQ(parse_monitor_selector("a=b=g").node, "a=b");
    EXPECT_EQ(parse_monitor_selector("a=b=g").channel, 1);
    for (const char* wrong : {"TV=X", "TV=", "=R", "", "TV=RG"})
        EXPECT_THROW(parse_monitor_selector(wrong), Error) << wrong;
}

TEST(MonitorSelectors, GlobsMatchLikeTheShells) {
    EXPECT_TRUE(matches_glob("*", "") && matches_glob("a*c", "abbc") && matches_glob("?", "x") &&
                matches_glob("a*b*c", "a-b-b-c"));
    EXPECT_FALSE(matches_glob("?", "") || matches_glob("a*c", "abbd") || matches_glob("a", "ab") ||
                 matches_glob("", "a"));
}

}  // namespace
}  // namespace surimi
