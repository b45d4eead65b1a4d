// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "runtime/base/error.h"

namespace surimi {
namespace {

constexpr int largest_side = 16384;  // the largest texture that common GPUs take
constexpr int rows_at_a_time = 64;   // whole blocks of the EXR's compression, which takes 16, for some threads

/// Name of OpenImageIO's reader: by the first bytes, since extensions and MIME types lie, else by the extension.
std::string reader_for(std::span<const uint8_t> bytes, const std::string& name) {
    const auto starts_with = [&](std::initializer_list<uint8_t> magic) {
        return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (starts_with({0xff, 0xd8, 0xff})) return "jpeg";
    if (starts_with({0x89, 'P', 'N', 'G'})) return "png";
    return name;
}

/// Opens an image that lies in memory. In two steps: the one-step call of OpenImageIO 2.4 fails for JPEG.
std::unique_ptr<OIIO::ImageInput> open_memory(OIIO::Filesystem::IOMemReader& memory, const std::string& reader) {
    auto input = OIIO::ImageInput::create(reader);
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input || !input->set_ioproxy(&memory) || !input->open(reader, spec, config)) return nullptr;
    return input;
}

/// Calls visit(begin, end) for all rows.
template <class Visit>
void for_rows(int height, const Visit& visit) {
    for (int begin = 0; begin < height; begin += rows_at_a_time) visit(begin, std::min(begin + rows_at_a_time, height));
}

std::unique_ptr<OIIO::ImageInput> open_file(const std::filesystem::path& path) {
    auto input = OIIO::ImageInput::open(path.string());
    if (!input)
        throw Error(ErrorKind::scene, path.string() + ": cannot be read as an image (" + OIIO::geterror() + ")");
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > largest_side || spec.height > largest_side || spec.depth > 1)
        throw Error(ErrorKind::scene, path.string() + ": image size is not supported; at most 16384 x 16384");
    return input;
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const OIIO::ImageInput& input) {
    throw Error(ErrorKind::scene, path.string() + ": image is damaged (" + input.geterror() + ")");
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorKind::cannot_write,
                path.string() + ": cannot be written (" + why + "); check the folder's rights and free space");
}

}  // namespace

Image<glm::u8vec4> decode_image(std::span<const uint8_t> bytes, const std::string& name) {
    OIIO::Filesystem::IOMemReader memory(const_cast<uint8_t*>(bytes.data()), bytes.size());
    const auto input = open_memory(memory, reader_for(bytes, name));
    if (!input) throw Error(ErrorKind::scene, name + ": is no image that can be decoded (" + OIIO::geterror() + ")");
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > largest_side || spec.height > largest_side ||
        spec.nchannels < 1 || spec.depth > 1)
        throw Error(ErrorKind::scene, name + ": image of " + std::to_string(spec.width) + " x " +
                                          std::to_string(spec.height) + " is not supported; at most 16384 x 16384");
    const auto channels = static_cast<size_t>(spec.nchannels);
    Image<glm::u8vec4> image(spec.width, spec.height);
    std::vector<uint8_t> raw(image.pixels.size() * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, raw.data()))
        throw Error(ErrorKind::scene, name + ": image is damaged (" + input->geterror() + ")");
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const uint8_t* p = &raw[i * channels];
        const bool is_grey = channels < 3;
        const uint8_t alpha = channels == 2 ? p[1] : channels >= 4 ? p[3] : uint8_t{255};
        image.pixels[i] = {p[0], is_grey ? p[0] : p[1], is_grey ? p[0] : p[2], alpha};
    }
    return image;
}

Channels read_channels(const std::filesystem::path& path) {
    const auto input = open_file(path);
    const OIIO::ImageSpec& spec = input->spec();
    Channels channels{spec.width, spec.height, spec.channelnames, {}};
    if (!spec.format.is_floating_point())
        channels.code_step = 1 / (std::pow(2.0, 8.0 * static_cast<double>(spec.format.size())) - 1);
    else if (input->format_name() == std::string("hdr"))
        channels.relative_step = 0x1p-7;  // 8 bits of mantissa in common with the brightest channel: at worst this
    else
        channels.relative_step = spec.format == OIIO::TypeDesc::HALF ? 0x1p-10 : 0x1p-23;
    channels.values.resize(static_cast<size_t>(spec.image_pixels()) * static_cast<size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, channels.values.data()))
        fail_to_read(path, *input);
    return channels;
}

void read_rows(const std::filesystem::path& path, const std::function<void(const ChannelLayout&)>& begin,
               const TakeRows& take) {
    const auto input = open_file(path);
    const OIIO::ImageSpec& spec = input->spec();
    begin({spec.width, spec.height, spec.channelnames});
    const size_t of_row = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.nchannels);
    std::vector<float> values;
    for_rows(spec.height, [&](int first, int end) {
        values.resize(static_cast<size_t>(end - first) * of_row);
        if (!input->read_scanlines(0, 0, spec.y + first, spec.y + end, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT,
                                   values.data()))
            fail_to_read(path, *input);
        take(first, end, values);
    });
}

void write_exr(const std::filesystem::path& path, const Channels& channels, ExrDepth depth) {
    const size_t of_row = static_cast<size_t>(channels.width) * channels.names.size();
    write_exr(path, {channels.width, channels.height, channels.names}, depth,
              [&](int begin, int, std::span<float> values) {
                  const auto first = channels.values.begin() + static_cast<std::ptrdiff_t>(of_row) * begin;
                  std::copy_n(first, values.size(), values.begin());
              });
}

void write_exr(const std::filesystem::path& path, const ChannelLayout& layout, ExrDepth depth,
               const GiveRows<float>& give) {
    OIIO::ImageSpec spec(layout.width, layout.height, static_cast<int>(layout.names.size()),
                         depth == ExrDepth::half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    spec.channelnames = layout.names;
    spec.alpha_channel = -1;
    spec.z_channel = -1;
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("DateTime", "1970:01:01 00:00:00");  // else the library writes the time of day
    // The temporary name need not end in .exr, so the format is asked for by name.
    const auto output = OIIO::ImageOutput::create("openexr");
    if (!output || !output->open(path.string(), spec))
        fail_to_write(path, output ? output->geterror() : OIIO::geterror());
    std::vector<float> values;
    for_rows(layout.height, [&](int begin, int end) {
        values.resize(static_cast<size_t>(end - begin) * static_cast<size_t>(layout.width) * layout.names.size());
        give(begin, end, values);
        if (!output->write_scanlines(begin, end, 0, OIIO::TypeDesc::FLOAT, values.data()))
            fail_to_write(path, output->geterror());
    });
    if (!output->close()) fail_to_write(path, output->geterror());
}

std::vector<uint8_t> encode_png(const Image<glm::u8vec3>& image) {
    return encode_png(image.width, image.height, [&](int begin, int, std::span<glm::u8vec3> pixels) {
        const auto first = image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(0, begin));
        std::copy_n(first, pixels.size(), pixels.begin());
    });
}

std::vector<uint8_t> encode_png(int width, int height, const GiveRows<glm::u8vec3>& give) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("png");
    if (!output || !output->set_ioproxy(&memory))
        throw Error(ErrorKind::internal, "no PNG encoder: " + OIIO::geterror());
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    bool is_good = output->open("map.png", spec);
    std::vector<glm::u8vec3> pixels;
    for_rows(height, [&](int begin, int end) {
        pixels.resize(static_cast<size_t>(end - begin) * static_cast<size_t>(width));
        give(begin, end, pixels);
        is_good = is_good && output->write_scanlines(begin, end, 0, OIIO::TypeDesc::UINT8, pixels.data());
    });
    if (!is_good || !output->close()) throw Error(ErrorKind::internal, "PNG encoder: " + output->geterror());
    return bytes;
}

std::string image_library() {
    const int version = OIIO::openimageio_version();  // 10000 major + 100 minor + patch
    return "OpenImageIO " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
}

}  // namespace surimi
