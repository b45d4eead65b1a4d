// SPDX-License-Identifier: Apache-2.0
#include "baker/write/file.h"

#include <unistd.h>

#include <fstream>
#include <string>

#include "runtime/base/error.h"

namespace surimi {

PendingFiles::~PendingFiles() {
    std::error_code ignored;
    for (const auto& [temporary, final_path] : files_) std::filesystem::remove(temporary, ignored);
}

std::filesystem::path PendingFiles::add(const std::filesystem::path& path) {
    // Beside the final file, so that renaming does not cross file systems; with the process' number, so that two runs
    // do not share it. The extension stays last: image libraries look at it.
    std::filesystem::path temporary = path;
    temporary.replace_filename(path.stem().string() + "." + std::to_string(getpid()) + ".tmp" +
                               path.extension().string());
    files_.emplace_back(temporary, path);
    return temporary;
}

void PendingFiles::commit() {
    for (const auto& [temporary, final_path] : files_) {
        std::error_code error;
        std::filesystem::rename(temporary, final_path, error);
        if (error)
            throw Error(ErrorKind::cannot_write, final_path.string() + ": cannot be written (" + error.message() + ")");
    }
    files_.clear();
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder))
        throw Error(ErrorKind::cannot_write,
                    folder.string() + ": cannot be written: " + (error ? error.message() : "it is no folder") +
                        "; choose another folder with -o");
}

bool read_pieces(const std::filesystem::path& path, const std::function<void(std::span<const uint8_t>)>& visit) {
    constexpr size_t piece = 1 << 20;
    std::ifstream file(path, std::ios::binary);
    std::vector<uint8_t> bytes(piece);
    while (file) {
        file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(piece));
        visit(std::span(bytes).first(static_cast<size_t>(file.gcount())));
    }
    return file.eof();
}

void write_bytes(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file)
        throw Error(ErrorKind::cannot_write,
                    path.string() + ": cannot be written; check that the folder exists, its rights and the free space");
}

void write_file(const std::filesystem::path& path, std::span<const uint8_t> bytes) {
    PendingFiles pending;
    write_bytes(pending.add(path), bytes);
    pending.commit();
}

}  // namespace surimi
