// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/gather_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "baker/cli/config_file.h"
#include "baker/cli/options.h"
#include "glb_builder.h"
#include "runtime/base/error.h"

namespace surimi::test {
namespace {

GatherWishes with_error(double error) {
    GatherWishes wishes;
    wishes.error = error;
    return wishes;
}
GatherWishes with_quality(const char* quality) {
    GatherWishes wishes;
    wishes.quality = quality;
    return wishes;
}
GatherWishes with_method(const char* method) {
    GatherWishes wishes;
    wishes.method = method;
    return wishes;
}
GatherWishes with_samples(int samples) {
    GatherWishes wishes;
    wishes.samples = samples;
    return wishes;
}
GatherWishes exactly() {
    GatherWishes wishes;
    wishes.is_exact = true;
    return wishes;
}
GatherWishes within(double seconds) {
    GatherWishes wishes;
    wishes.seconds = seconds;
    return wishes;
}

/// What comes of these sources, the lowest first.
Config config_of(const std::vector<GatherWishes>& sources) {
    Config config;
    for (const GatherWishes& wishes : sources) apply(wishes, "test", config);
    check_samples(config.bake.gather);
    return config;
}

/// The message of the usage error that these sources give.
std::string complaint(const std::vector<GatherWishes>& sources) {
    try {
        config_of(sources);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

/// The configuration as it is after printing and reading.
Config read_back(const Config& config) {
    const auto path = test_folder() / "printed.toml";
    std::ofstream(path) << to_toml(config);
    Config back;
    read_config_file(path, back);
    return back;
}

TEST(GatherOptions, DefaultIsAStepOfAnEightBitMap) {
    const Config config = config_of({});
    EXPECT_EQ(config.bake.gather.error, 0.004);
    EXPECT_FALSE(config.bake.gather.is_exact);
    EXPECT_EQ(config.bake.gather.method, Method::automatic);
    EXPECT_EQ(config.bake.gather.samples, 0);
    EXPECT_EQ(config.bake.audit, 0u);
    EXPECT_FALSE(config.is_strict);
}

TEST(GatherOptions, QualitiesStandForErrors) {
    EXPECT_EQ(config_of({with_quality("draft")}).bake.gather.error, 0.02);
    EXPECT_EQ(config_of({with_quality("medium")}).bake.gather.error, 0.004);
    EXPECT_EQ(config_of({with_quality("high")}).bake.gather.error, 0.001);
    EXPECT_FALSE(config_of({with_quality("high")}).bake.gather.is_exact);
    EXPECT_TRUE(config_of({with_quality("reference")}).bake.gather.is_exact);
}

TEST(GatherOptions, HigherSourcesWinOverWhatTheyExclude) {
    EXPECT_EQ(config_of({with_quality("reference"), with_error(0.01)}).bake.gather.error, 0.01);
    EXPECT_FALSE(config_of({exactly(), with_quality("draft")}).bake.gather.is_exact);
    EXPECT_EQ(config_of({within(30), with_error(0.01)}).seconds, 0);
    EXPECT_EQ(config_of({within(30), exactly()}).seconds, 0);
    const Config timed = config_of({with_quality("reference"), within(30)});
    EXPECT_EQ(timed.seconds, 30);
    EXPECT_FALSE(timed.bake.gather.is_exact);
    EXPECT_FALSE(config_of({exactly(), with_method("mc")}).bake.gather.is_exact);
    EXPECT_EQ(config_of({with_method("mc"), exactly()}).bake.gather.method, Method::automatic);
    GatherWishes rays = with_method("mc");
    rays.samples = 64;
    EXPECT_EQ(config_of({rays, with_method("split")}).bake.gather.samples, 0);
    EXPECT_EQ(config_of({rays, exactly()}).bake.gather.samples, 0);
}

TEST(GatherOptions, SourcesCompleteEachOther) {
    const Config config = config_of({with_samples(64), with_method("mc")});
    EXPECT_EQ(config.bake.gather.samples, 64);
    EXPECT_EQ(config.bake.gather.method, Method::monte_carlo);
    const Config exact = config_of({with_error(0.02), exactly()});
    EXPECT_EQ(exact.bake.gather.error, 0.02) << "what is left to estimate with --exact";
    EXPECT_TRUE(exact.bake.gather.is_exact);
}

TEST(GatherOptions, OneSourceMustNotContradictItself) {
    GatherWishes wishes = with_quality("high");
    wishes.error = 0.1;
    EXPECT_NE(complaint({wishes}).find("quality and error exclude each other"), std::string::npos);
    EXPECT_NE(complaint({wishes}).find("error 0.001"), std::string::npos) << "what the name stands for";
    wishes = with_quality("reference");
    wishes.method = "mc";
    EXPECT_NE(complaint({wishes}).find("only splitting is exact"), std::string::npos);
    wishes = exactly();
    wishes.method = "scanline";
    EXPECT_NE(complaint({wishes}).find("exact and method scanline"), std::string::npos);
    wishes = within(3);
    wishes.error = 0.1;
    EXPECT_NE(complaint({wishes}).find("time and error"), std::string::npos);
    wishes = within(3);
    wishes.is_exact = true;
    EXPECT_NE(complaint({wishes}).find("time and exact"), std::string::npos);
    EXPECT_NE(complaint({with_samples(64)}).find("--method mc"), std::string::npos);
}

TEST(GatherOptions, RangesEndWhereTheySay) {
    for (const double error : {0.0, -0.1, 1.0001, static_cast<double>(NAN), static_cast<double>(INFINITY)})
        EXPECT_NE(complaint({with_error(error)}).find("test: error must be"), std::string::npos) << error;
    EXPECT_EQ(config_of({with_error(1)}).bake.gather.error, 1);
    for (const double seconds : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
        EXPECT_NE(complaint({within(seconds)}).find("time must be"), std::string::npos) << seconds;
    EXPECT_NE(complaint({with_samples(-1)}).find("samples must be"), std::string::npos);
    EXPECT_NE(complaint({with_samples((1 << 20) + 1)}).find("samples must be"), std::string::npos);
    GatherWishes wishes;
    wishes.audit = -1;
    EXPECT_NE(complaint({wishes}).find("audit must be"), std::string::npos);
    for (const int side : {0, 5}) {
        GatherWishes subtexels;
        subtexels.supersample = side;
        EXPECT_NE(complaint({subtexels}).find("supersample must be from 1 to 4"), std::string::npos);
    }
    GatherWishes bound;
    bound.memory = -1;
    EXPECT_NE(complaint({bound}).find("memory must be"), std::string::npos);
}

TEST(GatherOptions, UnknownNamesGetTheNearest) {
    EXPECT_NE(complaint({with_method("scanlines")}).find("did you mean \"scanline\""), std::string::npos);
    EXPECT_NE(complaint({with_quality("refrence")}).find("did you mean \"reference\""), std::string::npos);
}

TEST(GatherOptions, WhatIsPrintedReadsBack) {
    GatherWishes all = with_method("mc");
    all.error = 0.0123;
    all.samples = 48;
    all.audit = 17;
    all.is_strict = true;
    all.seed = 99;
    all.supersample = 3;
    all.fit = "bilinear";
    all.memory = 1500;
    for (const auto& wishes : {all, with_quality("draft"), with_quality("reference"), exactly(), within(12.5),
                               with_method("scanline"), with_error(1), with_error(1e-5)}) {
        const Config config = config_of({wishes});
        const Config back = read_back(config);
        EXPECT_EQ(to_toml(back), to_toml(config));
        EXPECT_EQ(settings_json(back), settings_json(config));
        EXPECT_EQ(back.bake.gather.error, config.bake.gather.error);
        EXPECT_EQ(back.bake.gather.is_exact, config.bake.gather.is_exact);
        EXPECT_EQ(back.bake.gather.method, config.bake.gather.method);
        EXPECT_EQ(back.bake.gather.samples, config.bake.gather.samples);
        EXPECT_EQ(back.bake.gather.seed, config.bake.gather.seed);
        EXPECT_EQ(back.bake.gather.supersample, config.bake.gather.supersample);
        EXPECT_EQ(back.bake.post.fit, config.bake.post.fit);
        EXPECT_EQ(back.bake.memory, config.bake.memory);
        EXPECT_EQ(back.bake.audit, config.bake.audit);
        EXPECT_EQ(back.is_strict, config.is_strict);
        EXPECT_EQ(back.seconds, config.seconds);
    }
}

TEST(GatherOptions, FitIsNoneUnlessAskedForAndNamesAreChecked) {
    EXPECT_EQ(config_of({}).bake.post.fit, Fit::none);
    GatherWishes bilinear, none, wrong;
    bilinear.fit = "bilinear";
    none.fit = "none";
    wrong.fit = "bilinaer";
    EXPECT_EQ(config_of({bilinear}).bake.post.fit, Fit::bilinear);
    EXPECT_EQ(config_of({bilinear, none}).bake.post.fit, Fit::none) << "the higher source wins";
    EXPECT_EQ(config_of({bilinear, with_error(0.01)}).bake.post.fit, Fit::bilinear);
    EXPECT_EQ(nlohmann::json::parse(settings_json(config_of({bilinear})))["fit"], "bilinear");
    EXPECT_NE(
        complaint({wrong}).find("fit must be one of none, bilinear, not \"bilinaer\"; did you mean \"bilinear\"?"),
        std::string::npos);
}

TEST(GatherOptions, FitComesFromTheEnvironment) {
    setenv("SURIMI_FIT", "bilinear", 1);
    const GatherWishes wishes = environment_wishes();
    unsetenv("SURIMI_FIT");
    EXPECT_EQ(wishes.fit, "bilinear");
    EXPECT_EQ(environment_wishes().fit, std::nullopt);
}

TEST(GatherOptions, ManifestHasWhatDecidesTheValues) {
    GatherWishes wishes = with_method("mc");
    wishes.error = 0.01;
    wishes.samples = 48;
    wishes.audit = 17;
    wishes.supersample = 2;
    wishes.memory = 1500;
    const auto json = nlohmann::json::parse(settings_json(config_of({wishes})));
    EXPECT_EQ(json["error"], 0.01);
    EXPECT_EQ(json["exact"], false);
    EXPECT_EQ(json["method"], "mc");
    EXPECT_EQ(json["samples"], 48);
    EXPECT_EQ(json["audit"], 17);
    EXPECT_EQ(json["supersample"], 2);
    EXPECT_EQ(json["fit"], "none");
    EXPECT_FALSE(json.contains("memory")) << "values do not depend on it";
    EXPECT_FALSE(json.contains("time"));
    EXPECT_EQ(nlohmann::json::parse(settings_json(config_of({within(3)})))["time"], 3);
}

}  // namespace
}  // namespace surimi::test
