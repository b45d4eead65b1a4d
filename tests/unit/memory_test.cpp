// SPDX-License-Identifier: Apache-2.0
// What a bake is foretold to hold against what it holds, and the bound that it keeps.
#include <gtest/gtest.h>

#include "baker/memory.h"
#include "baker/post/fill.h"
#include "baker/post/gutter.h"
#include "baker/post/ratio.h"
#include "baker/post_memory.h"
#include "runtime/base/error.h"
#include "tests/support/counted_memory.h"
#include "tests/support/scenes.h"

namespace surimi {
namespace {

/// One ray for a texel: it is the sizes that count.
BakeSettings settings_of(int size, int pages) {
    BakeSettings settings;
    settings.unwrap.width = settings.unwrap.height = size;
    settings.unwrap.atlases = pages;
    settings.gather = {.method = Method::monte_carlo, .samples = 1};
    return settings;
}

double allocated(const PlannedMemory& memory) {
    return static_cast<double>(memory.map + memory.texels + memory.silhouettes + memory.passing);
}

TEST(Memory, ABakeOfARoomOnOneMapAndOnTwoTakesWhatIsForetold) {
    const Scene scene = test::kanikama_room();
    for (const int pages : {1, 2}) {
        const BakeSettings settings = settings_of(512, pages);
        const double foretold = allocated(planned_memory(scene, prepare(scene, settings, {}), settings));
        test::restart_count();
        bake(scene, settings, {});
        const auto counted = static_cast<double>(test::most_counted_bytes());
        EXPECT_NEAR(counted / foretold, 1, 0.15) << pages << " maps: " << counted << " of " << foretold;
    }
}

TEST(Memory, FillGuttersAndSeamsTakeWhatIsForetold) {
    const Scene scene = test::kanikama_room();
    for (const bool in_space : {true, false}) {
        BakeSettings settings = settings_of(512, 2);
        settings.post.fills_in_space = in_space;
        const Preparation preparation = prepare(scene, settings, {});
        std::vector<Channel> channels;
        for (const Texels& texels : preparation.texels)
            channels.push_back(visibility_channel(texels, gather(scene, preparation.atlas, texels, *preparation.rays,
                                                                 preparation.silhouettes, 0, settings.gather, {})
                                                              .estimates));
        test::restart_count();
        fill(scene, preparation.atlas, preparation.texels, channels, settings.post);
        for (size_t p = 0; p < channels.size(); ++p) grow_gutters(preparation.texels[p], channels[p], all_rings);
        stitch(preparation.atlas, preparation.seams, channels);
        const auto counted = static_cast<double>(test::most_counted_bytes());
        const auto foretold = static_cast<double>(post_bytes(scene, preparation, 0, settings.post));
        EXPECT_NEAR(counted / foretold, 1, 0.25) << counted << " of " << foretold;
    }
}

TEST(Memory, AnAuditIsForetoldWhereItIsAskedForAlone) {
    const Scene scene = test::kanikama_room();
    BakeSettings settings = settings_of(128, 1);
    const Preparation preparation = prepare(scene, settings, {});
    EXPECT_EQ(planned_memory(scene, preparation, settings).audit, 0u);
    settings.audit = 1;
    EXPECT_EQ(planned_memory(scene, preparation, settings).audit, audit_bytes(preparation.texels[0]));
}

TEST(Memory, ABakeKeepsItsBoundOrSaysBeforeItStartsThatItCannot) {
    const Scene scene = test::kanikama_room();
    BakeSettings settings = settings_of(384, 1);
    settings.gather.supersample = 2;
    settings.gather.band_rows = 384;
    const Preparation preparation = prepare(scene, settings, {});
    const PlannedMemory whole = planned_memory(scene, preparation, settings);
    BakeSettings in_bands = settings;
    in_bands.gather.band_rows = 8;
    const PlannedMemory least = planned_memory(scene, preparation, in_bands);
    ASSERT_LT(least.passing, whole.passing / 2);
    const size_t bound = least.passing + (whole.passing - least.passing) / 2;  // of what passes
    settings.memory = whole.peak - whole.passing + bound;
    test::restart_count();
    try {
        bake(scene, settings, {});
        EXPECT_LE(test::most_counted_bytes(), whole.map + whole.texels + whole.silhouettes + bound * 11 / 10);
    } catch (const Error& error) {  // tests before this one took more
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_GT(planned_memory(scene, preparation, in_bands).peak, settings.memory);
        EXPECT_LT(test::most_counted_bytes(), 2 * whole.texels + whole.map) << "it began to gather";
    }
}

}  // namespace
}  // namespace surimi
