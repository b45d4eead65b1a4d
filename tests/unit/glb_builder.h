// SPDX-License-Identifier: Apache-2.0
// Builds .glb files for tests, and takes files apart, by other code than the program's.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surimi::test {

using Json = nlohmann::json;

inline void append_u32(std::vector<uint8_t>& bytes, size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(value >> shift));
}

/// A folder of its own for the running test, empty at first.
inline std::filesystem::path test_folder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const auto folder = std::filesystem::temp_directory_path() /
                        (std::string("surimi_") + info->test_suite_name() + "_" + info->name());
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

class GlbBuilder {
  public:
    Json json{{"asset", {{"version", "2.0"}}}, {"accessors", Json::array()}, {"bufferViews", Json::array()}};

    int add_view(std::span<const uint8_t> bytes) {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        return static_cast<int>(json["bufferViews"].size()) - 1;
    }

    /// Tightly packed values as an accessor of `type`.
    template <class Component>
    int add(const std::vector<Component>& values, int component_type, const std::string& type) {
        const size_t components = type == "SCALAR" ? 1 : static_cast<size_t>(type[3] - '0');
        std::vector<uint8_t> bytes(values.size() * sizeof(Component));
        std::memcpy(bytes.data(), values.data(), bytes.size());
        json["accessors"].push_back({{"bufferView", add_view(bytes)},
                                     {"componentType", component_type},
                                     {"count", values.size() / components},
                                     {"type", type}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    int add_floats(const std::vector<float>& values, const std::string& type) { return add(values, 5126, type); }
    int add_indices(const std::vector<uint16_t>& values) { return add(values, 5123, "SCALAR"); }

    std::filesystem::path write(const std::filesystem::path& path) {
        json["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
        std::string text = json.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        binary_.resize((binary_.size() + 3) / 4 * 4);
        std::vector<uint8_t> file;
        for (const size_t word :
             {size_t{0x46546C67}, size_t{2}, 28 + text.size() + binary_.size(), text.size(), size_t{0x4E4F534A}})
            append_u32(file, word);
        file.insert(file.end(), text.begin(), text.end());
        append_u32(file, binary_.size());
        append_u32(file, 0x004E4942);
        file.insert(file.end(), binary_.begin(), binary_.end());
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
        return path;
    }

  private:
    std::vector<uint8_t> binary_;
};

/// A .glb, parsed.
class GlbFile {
  public:
    explicit GlbFile(std::span<const uint8_t> file) {
        const auto word = [&](size_t offset) {
            uint32_t value = 0;
            std::memcpy(&value, &file[offset], sizeof value);
            return size_t{value};
        };
        if (word(8) != file.size()) throw std::runtime_error("length in the header is wrong");
        const size_t json_size = word(12);
        json = Json::parse(file.begin() + 20, file.begin() + 20 + static_cast<std::ptrdiff_t>(json_size));
        const auto binary = file.subspan(20 + json_size + 8, word(20 + json_size));
        binary_.assign(binary.begin(), binary.end());
    }

    Json json;

    std::vector<uint8_t> view(size_t index) const {
        const Json& view = json["bufferViews"][index];
        const auto begin = binary_.begin() + view.value("byteOffset", 0);
        return {begin, begin + view["byteLength"].get<int>()};
    }

    /// The bytes of every element. Only for accessors that are plain.
    std::vector<std::vector<uint8_t>> elements(const Json& index) const {
        const Json& accessor = json["accessors"][index.get<size_t>()];
        if (accessor.contains("sparse")) throw std::runtime_error("sparse");
        const size_t type = accessor["componentType"].get<size_t>();
        const size_t size = type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
        const std::string shape = accessor["type"];
        const size_t element = size * (shape == "SCALAR" ? 1 : static_cast<size_t>(shape[3] - '0'));
        std::vector<std::vector<uint8_t>> result(accessor["count"].get<size_t>(), std::vector<uint8_t>(element));
        if (!accessor.contains("bufferView")) return result;
        const Json& view_json = json["bufferViews"][accessor["bufferView"].get<size_t>()];
        const auto bytes = view(accessor["bufferView"].get<size_t>());
        const size_t stride = view_json.value("byteStride", element);
        const size_t begin = accessor.value("byteOffset", size_t{0});
        for (size_t i = 0; i < result.size(); ++i)
            std::memcpy(result[i].data(), &bytes.at(begin + i * stride), element);
        return result;
    }

    /// The components of every element.
    template <class Component>
    std::vector<Component> values(const Json& index) const {
        std::vector<Component> result;
        for (const auto& element : elements(index))
            for (size_t offset = 0; offset < element.size(); offset += sizeof(Component)) {
                Component value;
                std::memcpy(&value, &element[offset], sizeof value);
                result.push_back(value);
            }
        return result;
    }

    /// Vertex numbers of the corners of a triangle list.
    std::vector<size_t> corners(const Json& primitive) const {
        std::vector<size_t> result;
        for (const auto& element : elements(primitive.at("indices"))) {
            size_t value = 0;
            std::memcpy(&value, element.data(), element.size());
            result.push_back(value);
        }
        return result;
    }

    const Json& primitive(size_t node, size_t p = 0) const {
        return json["meshes"][json["nodes"][node]["mesh"].get<size_t>()]["primitives"][p];
    }

  private:
    std::vector<uint8_t> binary_;
};

}  // namespace surimi::test
