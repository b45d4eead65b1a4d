// SPDX-License-Identifier: Apache-2.0
#include "baker/evidence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "baker/cli/evidence_summary.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// 10,000 measured texels and as many unlit ones.
MonitorEvidence of_texels(size_t above) {
    MonitorEvidence evidence;
    evidence.statistics.methods[static_cast<size_t>(TexelMethod::none)].texels = 10000;
    evidence.statistics.methods[static_cast<size_t>(TexelMethod::ray)].texels = 4000;
    evidence.statistics.methods[static_cast<size_t>(TexelMethod::scanline)].texels = 6000;
    evidence.statistics.above_error = above;
    return evidence;
}

Audit audit_of(size_t texels, size_t beyond) {
    Audit audit;
    audit.texels = texels;
    audit.beyond = beyond;
    return audit;
}

TEST(Evidence, UnlitTexelsAreNotMeasured) {
    EXPECT_EQ(measured_texels(of_texels(0).statistics), 10000u);
}

TEST(Evidence, APromiseIsKeptUpToOneTexelInAThousand) {
    EXPECT_TRUE(promise_of(of_texels(10), 0.004).is_kept());
    const Promise broken = promise_of(of_texels(11), 0.004);
    EXPECT_DOUBLE_EQ(broken.share_above, 0.0011);
    ASSERT_EQ(broken.breaches.size(), 1u);
    EXPECT_NE(broken.breaches[0].find("0.11 %"), std::string::npos) << broken.breaches[0];
}

TEST(Evidence, NothingMeasuredBreaksNoPromise) {
    const Promise promise = promise_of({}, 0.004);
    EXPECT_TRUE(promise.is_kept());
    EXPECT_EQ(promise.share_above, 0);
}

TEST(Evidence, TheAuditBreaksWhatTheEstimatesPromise) {
    MonitorEvidence evidence = of_texels(0);
    evidence.audits = {audit_of(1000, 1)};
    EXPECT_TRUE(promise_of(evidence, 0.004).is_kept());
    evidence.audits = {audit_of(1000, 2)};
    EXPECT_FALSE(promise_of(evidence, 0.004).is_kept());
    evidence.audits = {audit_of(1500, 0), audit_of(500, 2)};  // the pages together keep it
    EXPECT_TRUE(promise_of(evidence, 0.004).is_kept());
}

TEST(Evidence, AnRmseSurelyAboveHalfOfTheErrorBreaksIt) {
    MonitorEvidence evidence = of_texels(0);
    evidence.audits = {audit_of(500, 0)};
    evidence.audits[0].rmse = 0.003;
    evidence.audits[0].rmse_low = 0.0019;
    evidence.audits[0].rmse_high = 0.004;
    EXPECT_TRUE(promise_of(evidence, 0.004).is_kept()) << "the interval reaches below half";
    evidence.audits[0].rmse_low = 0.0021;
    EXPECT_FALSE(promise_of(evidence, 0.004).is_kept());
}

TEST(Evidence, OneAuditStaysWhatItIs) {
    const Audit page{500, 0.003, 0.002, 0.005, 0.0004, 0.02, 1, 0.009};
    const Audit joined = joined_audit({page, Audit{}});  // nothing was lit on the second page
    EXPECT_EQ(joined.texels, 500u);
    EXPECT_DOUBLE_EQ(joined.rmse, page.rmse);
    EXPECT_DOUBLE_EQ(joined.rmse_low, page.rmse_low);
    EXPECT_DOUBLE_EQ(joined.rmse_high, page.rmse_high);
    EXPECT_DOUBLE_EQ(joined.reference_error, page.reference_error);
    EXPECT_DOUBLE_EQ(joined.beyond_high, page.beyond_high);
    EXPECT_EQ(joined.largest, page.largest);
    EXPECT_EQ(joined.beyond, 1u);
}

TEST(Evidence, EqualPagesHalveTheVarianceOfTheirRmse) {
    const Audit page{500, 0.003, std::sqrt(5e-6), std::sqrt(13e-6), 0, 0, 0, 0};  // squares: 9e-6 with 4e-6 around
    const Audit joined = joined_audit({page, page});
    EXPECT_DOUBLE_EQ(joined.rmse, 0.003);
    EXPECT_NEAR(joined.rmse_low, std::sqrt(9e-6 - 4e-6 / std::sqrt(2.0)), 1e-15);
    EXPECT_NEAR(joined.rmse_high, std::sqrt(9e-6 + 4e-6 / std::sqrt(2.0)), 1e-15);
}

TEST(Evidence, NoAuditedTexelsGiveNoErrorAndNoBound) {
    const Audit joined = joined_audit({Audit{}, Audit{}});
    EXPECT_EQ(joined.rmse, 0);
    EXPECT_EQ(joined.rmse_high, 0);
    EXPECT_EQ(joined.beyond_high, 1) << "any share of the texels may be off";
}

/// Two pages of three texels, two covered on each.
Bake two_pages() {
    Bake bake;
    for (const float error : {0.1f, 0.3f}) {
        BakedPage& page = bake.pages.emplace_back();
        page.state[2] = Image<TexelState>(3, 1, TexelState::covered);
        page.state[2].pixels[1] = TexelState::filled;
        page.irradiance[2] = Image<IrradianceEstimate>(3, 1);
        page.irradiance[2].pixels[0].error = error;
        page.irradiance[2].pixels[1].error = 7;
    }
    return bake;
}

TEST(Evidence, EstimatesAreOfAllPagesCoveredTexels) {
    const EstimatedErrors errors = estimated_errors(two_pages(), 2);
    EXPECT_NEAR(errors.mean, 0.1, 1e-7);
    EXPECT_NEAR(errors.rms, std::sqrt(0.1 / 4), 1e-7);
    EXPECT_NEAR(errors.largest, 0.3, 1e-7);
    EXPECT_EQ(estimated_errors(Bake{}, 2).rms, 0);
}

TEST(Evidence, StrictNamesTheMonitorThatMissed) {
    Scene scene;
    scene.monitors.resize(2);
    scene.monitors[0].name = "Left";
    scene.monitors[1].name = "Right";
    scene.monitors[1].channel = 1;
    Bake bake;
    bake.evidence = {of_texels(0), of_texels(0)};
    EXPECT_NO_THROW(require_promises(scene, bake));
    bake.evidence[1] = of_texels(5000);
    try {
        require_promises(scene, bake);
        FAIL() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::target_missed);
        EXPECT_NE(std::string(error.what()).find("G Right: 50 %"), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find("Left"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace surimi
