// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/fix_options.h"

#include <gtest/gtest.h>

#include <fstream>

#include "baker/bake.h"
#include "baker/cli/config_file.h"
#include "baker/cli/options.h"
#include "runtime/base/error.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

TEST(Fixes, AreAllOnAndEachNameTurnsOffItsOwn) {
    BakeSettings settings;
    EXPECT_TRUE(without(settings).empty());
    ASSERT_EQ(fixes().size(), 5u);
    for (const Fix& fix : fixes()) {
        do_without({fix.name}, "test", settings);
        EXPECT_EQ(without(settings), std::vector<std::string>{fix.name});
        EXPECT_FALSE(fix.in(settings));
    }
    do_without({"seams", "fill"}, "test", settings);
    EXPECT_FALSE(settings.post.stitches_seams || settings.post.fills_in_space);
    EXPECT_TRUE(settings.finds_inside && settings.gather.lifts_smooth && settings.gather.clears_covers);
}

TEST(Fixes, UnknownNamesNameThoseThatThereAre) {
    BakeSettings settings;
    try {
        do_without({"acne"}, "--without", settings);
        FAIL() << "no such fix";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_STREQ(error.what(),
                     "--without: there is no fix \"acne\" to do without; there are covers, inside, terminator, fill, "
                     "seams");
    }
}

TEST(Fixes, AreWrittenAndReadBack) {
    Config config;
    do_without({"terminator", "seams"}, "test", config.bake);
    const auto path = std::filesystem::path(testing::TempDir()) / "fixes.surimi.toml";
    std::ofstream(path) << to_toml(config);
    Config read;
    read_config_file(path, read);
    EXPECT_EQ(without(read.bake), (std::vector<std::string>{"terminator", "seams"}));
    EXPECT_NE(settings_json(read).find("\"without\":[\"terminator\",\"seams\"]"), std::string::npos);
    EXPECT_EQ(settings_json({}).find("without"), std::string::npos);
}

TEST(Fixes, ABakeDoesWithoutThem) {
    Scene scene = test::kanikama_room();
    test::add_quad(scene, "Left", {-1, 1, 1}, {0, 1, 1}, {0, 1, 0}, {-1, 1, 0});
    test::add_quad(scene, "Right", {0, 1, 1}, {1, 1, 1}, {1, 1, 0}, {0, 1, 0});
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = 64;
    settings.gather.error = 0.02;
    const Bake with = bake(scene, settings, {});
    for (const Fix& fix : fixes()) fix.in(settings) = false;
    const Bake bare = bake(scene, settings, {});
    EXPECT_GT(with.exposure.inside, 0u) << "the floor under the boxes";
    EXPECT_EQ(bare.exposure.inside + bare.exposure.probes, 0u);
    EXPECT_GT(with.evidence[0].seams.pieces, 0u);
    EXPECT_EQ(bare.evidence[0].seams.pieces, 0u);
    EXPECT_LE(with.evidence[0].seams.after.largest, with.evidence[0].seams.before.largest);
}

}  // namespace
}  // namespace surimi
