// SPDX-License-Identifier: Apache-2.0
#include "baker/report/gzip.h"

#include <string>

#include <zlib.h>

#include "runtime/base/error.h"

namespace surimi {

std::vector<uint8_t> gzip(std::span<const uint8_t> bytes) {
    constexpr int as_gzip = 15 + 16;  // the largest window, in the container of gzip
    constexpr int memory_level = 9;
    z_stream stream{};
    if (bytes.size() > UINT32_MAX ||
        deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, as_gzip, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
        throw Error(ErrorKind::internal, "cannot compress " + std::to_string(bytes.size()) + " bytes");
    std::vector<uint8_t> packed(deflateBound(&stream, static_cast<uLong>(bytes.size())));
    stream.next_in = const_cast<Bytef*>(bytes.data());  // zlib only reads it
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = packed.data();
    stream.avail_out = static_cast<uInt>(packed.size());
    const int result = deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    if (result != Z_STREAM_END) throw Error(ErrorKind::internal, "zlib could not finish");
    return packed;
}

}  // namespace surimi
