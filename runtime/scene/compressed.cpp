// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/compressed.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace surimi {
namespace {

constexpr std::array meshopt_names{"EXT_meshopt_compression", "KHR_meshopt_compression"};

// The densest streams there are: 16 equal bytes take 2 bits, so a byte becomes at most 64; an index takes at
// least a third of a byte. More than this is not what the encoder wrote, and must not be allocated.
constexpr size_t largest_expansion = 64;
// Vertex blocks carry up to 8 kB that the ratio does not cover (the last, partly filled block).
constexpr size_t expansion_slack = 65536;

/// What the extension says of one buffer view, checked against the buffer that it names.
struct Stream {
    const uint8_t* bytes = nullptr;
    size_t size = 0;
    size_t count = 0;
    size_t stride = 0;
    std::string mode;
    std::string filter;
};

class MeshoptDecoder {
  public:
    MeshoptDecoder(tinygltf::Model& model, const std::filesystem::path& path) : model_(model), path_(path) {}

    void decode_all() {
        for (size_t v = 0; v < model_.bufferViews.size(); ++v)
            for (const char* name : meshopt_names) {
                const auto found = model_.bufferViews[v].extensions.find(name);
                if (found == model_.bufferViews[v].extensions.end()) continue;
                place_ = place_name("buffer view", v, model_.bufferViews[v].name) + ", " + name;
                decode_view(model_.bufferViews[v], read_stream(found->second));
                model_.bufferViews[v].extensions.erase(name);
            }
        if (is_any_decoded_) model_.buffers.push_back(std::move(decoded_));
    }

  private:
    [[noreturn]] void refuse(const std::string& what) const { fail(path_, place_, what); }

    size_t whole(const tinygltf::Value& object, const char* key, bool is_required) const {
        if (!object.Has(key) && !is_required) return 0;
        const tinygltf::Value& value = object.Get(key);
        const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1;
        if (!(number >= 0 && number <= 2147483647.0 && number == static_cast<double>(static_cast<size_t>(number))))
            refuse("\"" + std::string(key) + "\" must be a whole number below 2^31");
        return static_cast<size_t>(number);
    }

    Stream read_stream(const tinygltf::Value& extension) const {
        if (!extension.IsObject()) refuse("must be an object");
        const size_t buffer = whole(extension, "buffer", true);
        const size_t offset = whole(extension, "byteOffset", false);
        Stream stream;
        stream.size = whole(extension, "byteLength", true);
        stream.count = whole(extension, "count", true);
        stream.stride = whole(extension, "byteStride", true);
        const tinygltf::Value& mode = extension.Get("mode");
        const tinygltf::Value& filter = extension.Get("filter");
        stream.mode = mode.IsString() ? mode.Get<std::string>() : "";
        stream.filter = filter.IsString() ? filter.Get<std::string>() : "NONE";
        if (buffer >= model_.buffers.size()) refuse("buffer " + std::to_string(buffer) + " does not exist");
        const std::vector<uint8_t>& data = model_.buffers[buffer].data;
        if (offset > data.size() || stream.size > data.size() - offset)
            refuse("its bytes are outside buffer " + std::to_string(buffer));
        stream.bytes = data.data() + offset;
        check_shape(stream);
        return stream;
    }

    /// The decoders assert what is checked here.
    void check_shape(const Stream& stream) const {
        const bool is_attributes = stream.mode == "ATTRIBUTES";
        if (!is_attributes && stream.mode != "TRIANGLES" && stream.mode != "INDICES")
            refuse("mode \"" + stream.mode + "\" is unknown");
        if (is_attributes && (stream.stride < 4 || stream.stride > 256 || stream.stride % 4 != 0))
            refuse("byteStride must be a multiple of 4 up to 256");
        if (!is_attributes && stream.stride != 2 && stream.stride != 4) refuse("byteStride of indices must be 2 or 4");
        if (stream.mode == "TRIANGLES" && stream.count % 3 != 0) refuse("the index count is no multiple of 3");
        if (stream.filter == "OCTAHEDRAL" && stream.stride != 4 && stream.stride != 8)
            refuse("the octahedral filter needs a stride of 4 or 8");
        if (stream.filter == "QUATERNION" && stream.stride != 8) refuse("the quaternion filter needs a stride of 8");
        if (stream.filter != "NONE" && !is_attributes) refuse("indices cannot have a filter");
        if (stream.count * stream.stride > stream.size * largest_expansion + expansion_slack)
            refuse(std::to_string(stream.size) + " bytes cannot hold " + std::to_string(stream.count) + " elements");
    }

    void decode_view(tinygltf::BufferView& view, const Stream& stream) {
        const size_t size = stream.count * stream.stride;
        if (size < view.byteLength)
            refuse("it decodes to " + std::to_string(size) + " bytes, the view has " + std::to_string(view.byteLength));
        // The filters want whole elements in aligned memory, hence a buffer of its own for each stream.
        std::vector<uint64_t> words(size / sizeof(uint64_t) + 1);
        uint8_t* out = reinterpret_cast<uint8_t*>(words.data());
        int status = 0;
        if (stream.mode == "ATTRIBUTES")
            status = meshopt_decodeVertexBuffer(out, stream.count, stream.stride, stream.bytes, stream.size);
        if (stream.mode == "TRIANGLES")
            status = meshopt_decodeIndexBuffer(out, stream.count, stream.stride, stream.bytes, stream.size);
        if (stream.mode == "INDICES")
            status = meshopt_decodeIndexSequence(out, stream.count, stream.stride, stream.bytes, stream.size);
        if (status != 0) refuse("the compressed data is damaged (meshoptimizer: " + std::to_string(status) + ")");
        apply_filter(stream, out);
        // Views start at multiples of four, as glTF wants for every component type.
        decoded_.data.resize((decoded_.data.size() + 3) / 4 * 4);
        view.buffer = static_cast<int>(model_.buffers.size());
        view.byteOffset = decoded_.data.size();
        view.byteLength = size;
        if (stream.mode == "ATTRIBUTES") view.byteStride = stream.stride;
        decoded_.data.insert(decoded_.data.end(), out, out + size);
        is_any_decoded_ = true;
    }

    void apply_filter(const Stream& stream, uint8_t* out) const {
        if (stream.filter == "OCTAHEDRAL") {
            meshopt_decodeFilterOct(out, stream.count, stream.stride);
        } else if (stream.filter == "QUATERNION") {
            meshopt_decodeFilterQuat(out, stream.count, stream.stride);
        } else if (stream.filter == "EXPONENTIAL") {
            meshopt_decodeFilterExp(out, stream.count, stream.stride);
        } else if (stream.filter != "NONE") {
            refuse("filter \"" + stream.filter +
                   "\" is unknown; convert the file: npx @gltf-transform/cli copy in.glb out.glb");
        }
    }

    tinygltf::Model& model_;
    const std::filesystem::path& path_;
    std::string place_;
    tinygltf::Buffer decoded_;
    bool is_any_decoded_ = false;
};

}  // namespace

void decode_meshopt(tinygltf::Model& model, const std::filesystem::path& path) {
    MeshoptDecoder(model, path).decode_all();
    for (const char* name : meshopt_names) {
        for (tinygltf::Buffer& buffer : model.buffers) buffer.extensions.erase(name);
        std::erase(model.extensionsUsed, name);
        std::erase(model.extensionsRequired, name);
    }
}

}  // namespace surimi
