// SPDX-License-Identifier: Apache-2.0
// Image files: decode, read, write. The only room that sees OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/image.h"
#include "runtime/base/math.h"

namespace surimi {

/// Decodes a PNG, JPEG or other encoded image from memory to 8-bit RGBA, un-premultiplied, as stored (no colour
/// conversion). `name` (with an extension that tells the format, such as "x.png") is used in the error.
/// Throws Error(scene) when the bytes are no image or are larger than 16384 x 16384.
Image<glm::u8vec4> decode_image(std::span<const uint8_t> bytes, const std::string& name);

/// Named float channels of one size: what an EXR holds. `values` is interleaved, top row first.
struct Channels {
    int width = 0;
    int height = 0;
    std::vector<std::string> names;
    std::vector<float> values;  ///< width * height * names.size()
    double code_step = 0;       ///< between neighbouring codes of [0, 1] in the file; 0: it holds floats
    double relative_step = 0;   ///< between neighbouring values as a share of them; of half, float and RGBE
};

/// The same without their values.
struct ChannelLayout {
    int width = 0;
    int height = 0;
    std::vector<std::string> names;
};

enum class ExrDepth { half, full };

/// Is called with rows [begin, end) from the top on, some at a time, to write their values into `values`: interleaved.
template <class Value>
using GiveRows = std::function<void(int begin, int end, std::span<Value> values)>;
/// The same with values that were read.
using TakeRows = std::function<void(int begin, int end, std::span<const float> values)>;

/// Reads all channels of an image file, linear, as float. Throws Error(scene).
Channels read_channels(const std::filesystem::path& path);

/// Reads all channels of an image of scanlines, linear, as float, some rows at a time: `begin` is called with its
/// layout, then `take`. Throws Error(scene).
void read_rows(const std::filesystem::path& path, const std::function<void(const ChannelLayout&)>& begin,
               const TakeRows& take);

/// Writes an EXR (ZIP). The bytes depend on the arguments alone. Throws Error(cannot_write).
void write_exr(const std::filesystem::path& path, const Channels& channels, ExrDepth depth);
/// The same bytes, without all values at hand at a time.
void write_exr(const std::filesystem::path& path, const ChannelLayout& layout, ExrDepth depth,
               const GiveRows<float>& give);

/// Encodes 8-bit RGB as a PNG; the bytes depend on the pixels alone.
std::vector<uint8_t> encode_png(const Image<glm::u8vec3>& image);
/// The same bytes, without all pixels at hand at a time.
std::vector<uint8_t> encode_png(int width, int height, const GiveRows<glm::u8vec3>& give);

/// Name and version of the library that reads and writes images.
std::string image_library();

}  // namespace surimi
