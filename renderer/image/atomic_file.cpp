// SPDX-License-Identifier: MIT
#include "renderer/image/atomic_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace candela {

namespace {

[[noreturn]] void fail(const char* step, int error) {
    throw ImageError(std::string("cannot ") + step + ": " + std::strerror(error));
}

// A temporary file that is gone unless it was committed.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::filesystem::path& beside)
        : path_(beside.string() + ".XXXXXX"), descriptor_(mkstemp(path_.data())) {
        if (descriptor_ < 0) fail("create a file there", errno);
        // mkstemp makes private files; a picture is as open as the user's umask has it.
        const mode_t mask = umask(0);
        umask(mask);
        if (fchmod(descriptor_, 0666 & ~mask) != 0) errno = 0;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) close(descriptor_);
        if (!committed_) unlink(path_.c_str());
    }

    void write_all(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail("write", errno);
            bytes = bytes.subspan(static_cast<size_t>(written));
        }
        // Some file systems cannot flush; that is no reason to lose the picture.
        if (fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) fail("write to the disk", errno);
        const int descriptor = descriptor_;
        descriptor_ = -1;
        if (close(descriptor) != 0) fail("write", errno);
    }

    void commit(const std::filesystem::path& target) {
        if (std::rename(path_.c_str(), target.c_str()) != 0) fail("rename the finished file", errno);
        committed_ = true;
    }

  private:
    std::string path_;
    int descriptor_;
    bool committed_ = false;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    TemporaryFile file(path);
    file.write_all(bytes);
    file.commit(path);
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
    write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::vector<std::byte> read_file(const std::filesystem::path& path, const DecodeLimits& limits) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) throw ImageError("is a folder, not a file");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw ImageError("is not a regular file");
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) throw ImageError(std::string("cannot open: ") + std::strerror(errno));
    const uint64_t size = std::filesystem::file_size(path, error);
    if (error) throw ImageError("cannot tell its size");
    if (size > limits.max_memory_bytes) {
        throw ImageError("has " + std::to_string(size) + " bytes, more than the memory limit of " +
                         std::to_string(limits.max_memory_bytes) + " bytes allows; --limit-memory raises it");
    }
    std::vector<std::byte> bytes(size);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<uint64_t>(file.gcount()) != size) throw ImageError("cannot read it whole");
    return bytes;
}

}  // namespace candela
