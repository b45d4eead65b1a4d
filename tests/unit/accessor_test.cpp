// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/accessor.h"

#include "runtime/base/error.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace surimi {
namespace {

/// A model with one buffer; views and accessors are added one by one.
struct SmallModel {
    tinygltf::Model model;

    SmallModel() { model.buffers.resize(1); }

    template <class Component>
    int add_view(const std::vector<Component>& values, size_t stride = 0) {
        std::vector<uint8_t>& data = model.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = data.size();
        view.byteLength = values.size() * sizeof(Component);
        view.byteStride = stride;
        data.resize(data.size() + view.byteLength);
        if (!values.empty()) std::memcpy(&data[view.byteOffset], values.data(), view.byteLength);
        model.bufferViews.push_back(view);
        return static_cast<int>(model.bufferViews.size()) - 1;
    }

    tinygltf::Accessor& add_accessor(int view, int component_type, int type, size_t count) {
        tinygltf::Accessor accessor;
        accessor.bufferView = view;
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = count;
        model.accessors.push_back(accessor);
        return model.accessors.back();
    }

    std::string refusal() const {
        try {
            check_layout(model, "small.glb");
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::scene);
            return error.what();
        }
        return "";
    }
};

using Values = std::vector<double>;

TEST(ReadAccessor, ReadsEveryComponentType) {
    SmallModel small;
    small.add_accessor(small.add_view<int8_t>({-128, 127}), TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_TYPE_SCALAR, 2);
    small.add_accessor(small.add_view<uint8_t>({0, 255}), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_SCALAR,
                       2);
    small.add_accessor(small.add_view<int16_t>({-32768, 32767}), TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_TYPE_SCALAR,
                       2);
    small.add_accessor(small.add_view<uint16_t>({0, 65535}), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                       TINYGLTF_TYPE_SCALAR, 2);
    small.add_accessor(small.add_view<uint32_t>({0, 4294967295u}), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                       TINYGLTF_TYPE_SCALAR, 2);
    small.add_accessor(small.add_view<float>({-0.5f, 1e30f}), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 2);
    EXPECT_EQ(small.refusal(), "");
    EXPECT_EQ(read_accessor(small.model, 0), (Values{-128, 127}));
    EXPECT_EQ(read_accessor(small.model, 1), (Values{0, 255}));
    EXPECT_EQ(read_accessor(small.model, 2), (Values{-32768, 32767}));
    EXPECT_EQ(read_accessor(small.model, 3), (Values{0, 65535}));
    EXPECT_EQ(read_accessor(small.model, 4), (Values{0, 4294967295.0}));
    EXPECT_EQ(read_accessor(small.model, 5), (Values{-0.5, static_cast<double>(1e30f)}));
    EXPECT_EQ(read_whole_accessor(small.model, 4), (std::vector<uint32_t>{0, 4294967295u}));
}

TEST(ReadAccessor, NormalisedIntegersReachBothEnds) {
    SmallModel small;
    small
        .add_accessor(small.add_view<int8_t>({-128, -127, 0, 127}), TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_TYPE_SCALAR,
                      4)
        .normalized = true;
    small
        .add_accessor(small.add_view<uint16_t>({0, 65535}), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                      TINYGLTF_TYPE_SCALAR, 2)
        .normalized = true;
    small.add_accessor(small.add_view<float>({3.5f}), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 1)
        .normalized = true;
    EXPECT_EQ(read_accessor(small.model, 0), (Values{-1, -1, 0, 1}));
    EXPECT_EQ(read_accessor(small.model, 1), (Values{0, 1}));
    EXPECT_EQ(read_accessor(small.model, 2), (Values{3.5}));
}

TEST(ReadAccessor, FollowsStrideAndOffsets) {
    SmallModel small;
    const int view = small.add_view<float>({0, 1, 2, 3, 4, 5, 6, 7}, 16);
    small.add_accessor(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, 2).byteOffset = 8;
    EXPECT_EQ(small.refusal(), "");
    EXPECT_EQ(read_accessor(small.model, 0), (Values{2, 3, 6, 7}));
}

TEST(ReadAccessor, WithoutViewIsZeros) {
    SmallModel small;
    small.add_accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 2);
    EXPECT_EQ(small.refusal(), "");
    EXPECT_EQ(read_accessor(small.model, 0), Values(6, 0.0));
}

TEST(ReadAccessor, SmallMatricesHavePaddedColumns) {
    SmallModel small;
    const int view = small.add_view<uint8_t>({1, 2, 99, 99, 3, 4, 99, 99});
    small.add_accessor(view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_MAT2, 1);
    EXPECT_EQ(small.refusal(), "");
    EXPECT_EQ(element_size(small.model.accessors[0]), 8u);
    EXPECT_EQ(read_accessor(small.model, 0), (Values{1, 2, 3, 4}));
}

struct SparseModel : SmallModel {
    explicit SparseModel(const std::vector<uint16_t>& indices) {
        const int index_view = add_view(indices);
        const int value_view = add_view<float>(std::vector<float>(indices.size(), 7.f));
        tinygltf::Accessor& accessor = add_accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 4);
        accessor.sparse.isSparse = true;
        accessor.sparse.count = static_cast<int>(indices.size());
        accessor.sparse.indices.bufferView = index_view;
        accessor.sparse.indices.byteOffset = 0;
        accessor.sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        accessor.sparse.values.bufferView = value_view;
        accessor.sparse.values.byteOffset = 0;
    }
};

TEST(ReadAccessor, SparseReplacesSomeElements) {
    const SparseModel sparse({0, 2});
    EXPECT_EQ(sparse.refusal(), "");
    EXPECT_EQ(read_accessor(sparse.model, 0), (Values{7, 0, 7, 0}));
}

TEST(CheckLayout, RefusesSparseIndexOutOfRange) {
    EXPECT_NE(SparseModel({0, 4}).refusal().find("sparse index 4"), std::string::npos);
    SparseModel too_many({0, 1, 2, 3, 0});
    EXPECT_NE(too_many.refusal().find("more elements"), std::string::npos);
    SparseModel past_the_view({0, 2});
    past_the_view.model.accessors[0].sparse.indices.byteOffset = 2;
    EXPECT_NE(past_the_view.refusal().find("do not fit"), std::string::npos);
}

TEST(CheckLayout, RefusesWhatReachesPastItsView) {
    SmallModel small;
    const int view = small.add_view<float>({0, 1, 2, 3});
    small.add_accessor(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, 2);
    EXPECT_EQ(small.refusal(), "");
    small.model.accessors[0].count = 3;
    EXPECT_NE(small.refusal().find("accessor 0"), std::string::npos);
    small.model.accessors[0].count = 2;
    small.model.accessors[0].byteOffset = 1;
    EXPECT_NE(small.refusal().find("do not fit"), std::string::npos);
    small.model.accessors[0].byteOffset = 0;
    small.model.bufferViews[0].byteStride = 4;
    EXPECT_NE(small.refusal().find("longer than the stride"), std::string::npos);
    small.model.bufferViews[0].byteStride = 0;
    small.model.bufferViews[0].byteOffset = 4;
    EXPECT_NE(small.refusal().find("buffer view 0"), std::string::npos);
}

TEST(CheckLayout, HugeNumbersDoNotWrapAround) {
    constexpr size_t huge = std::numeric_limits<size_t>::max();
    SmallModel small;
    const int view = small.add_view<float>({0, 1, 2, 3});
    for (const size_t count : {huge, huge / 8 + 2, huge / 16 + 1, size_t{1} << 61}) {
        small.model.accessors.clear();
        small.add_accessor(view, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, count);
        EXPECT_NE(small.refusal(), "") << count;
    }
    small.model.accessors[0].count = 1;
    small.model.accessors[0].byteOffset = huge - 3;
    EXPECT_NE(small.refusal(), "");
    small.model.accessors[0].byteOffset = 0;
    small.model.bufferViews[0].byteOffset = huge - 3;
    EXPECT_NE(small.refusal(), "");
}

TEST(CheckLayout, FewBytesDoNotAskForGigabytes) {
    SmallModel small;
    small.add_accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, 4'000'000'000u);
    EXPECT_NE(small.refusal().find("no buffer view"), std::string::npos);
}

}  // namespace
}  // namespace surimi
