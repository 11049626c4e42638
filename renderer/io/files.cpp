// SPDX-License-Identifier: MIT
#include "renderer/io/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>

#include "renderer/math/parallel.h"

namespace candela {
namespace {

namespace fs = std::filesystem;

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

RawBytes decode_base64(std::string_view text) {
    while (!text.empty() && text.back() == '=')
        text.remove_suffix(1);
    if (text.size() % 4 == 1) throw FileError("the base64 text of the data: URI is cut off");
    RawBytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) throw FileError("the data: URI holds characters that are not base64");
        bits = (bits << 6) | static_cast<uint32_t>(digit);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(static_cast<std::byte>((bits >> held) & 0xffu));
        }
    }
    return bytes;
}

// "scheme:" as RFC 3986 spells it: a letter, then letters, digits, + - . up to the first colon.
bool has_scheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    if (std::isalpha(static_cast<unsigned char>(uri[0])) == 0) return false;
    return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
    });
}

class OpenFile {
  public:
    explicit OpenFile(const fs::path& file) : descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
        if (descriptor_ < 0) throw FileError("cannot be opened; check its permissions");
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() { close(descriptor_); }

    // All of `to`, from that place of the file on.
    void read(std::span<std::byte> to, uint64_t from) const {
        while (!to.empty()) {
            const ssize_t count = pread(descriptor_, to.data(), to.size(), static_cast<off_t>(from));
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) throw FileError("cannot be read to its end");
            to = to.subspan(static_cast<size_t>(count));
            from += static_cast<uint64_t>(count);
        }
    }

  private:
    int descriptor_;
};

// The name inside directory, canonical, or empty where there is no such regular file. Throws where it leads outside.
fs::path canonical_inside(const fs::path& directory, const std::string& name) {
    const fs::path relative(name);
    if (name.empty() || name.find('\0') != std::string::npos) throw FileError("is not a file name");
    if (relative.is_absolute() || name.front() == '\\') {
        throw FileError("is an absolute path; only files inside the asset's directory are read");
    }
    std::error_code error;
    const fs::path full = fs::weakly_canonical(directory / relative, error);
    if (error) return {};
    const auto [end, rest] = std::mismatch(directory.begin(), directory.end(), full.begin(), full.end());
    if (end != directory.end()) {
        throw FileError("leads outside the asset's directory; only files inside it are read");
    }
    return fs::is_regular_file(full, error) ? full : fs::path{};
}

}  // namespace

AssetFiles::AssetFiles(const fs::path& asset) {
    const fs::path parent = asset.parent_path();
    std::error_code error;
    directory_ = fs::canonical(parent.empty() ? fs::path(".") : parent, error);
    if (error) throw FileError("its directory cannot be opened");
}

fs::path AssetFiles::resolve(std::string_view uri) const {
    if (has_scheme(uri)) {
        throw FileError("\"" + std::string(uri.substr(0, 60)) + "\" is remote; only files beside the asset are read");
    }
    const std::string shown = "\"" + std::string(uri.substr(0, 200)) + "\" ";
    try {
        // Some writers forget to encode a per cent sign: the name as it stands is the second guess.
        for (const std::string& name : {percent_decode(uri), std::string(uri)}) {
            if (fs::path file = canonical_inside(directory_, name); !file.empty()) return file;
        }
    } catch (const FileError& error) {
        throw FileError(shown + error.what());
    } catch (const fs::filesystem_error&) {
        throw FileError(shown + "cannot be opened");
    }
    throw FileError(shown + "does not exist beside the asset");
}

fs::path AssetFiles::place_of(std::string_view uri) const noexcept {
    try {
        return resolve(uri);
    } catch (const FileError&) {
        // It may still come.
    }
    try {
        if (has_scheme(uri)) return {};
        const fs::path name(percent_decode(uri));
        return name.is_absolute() ? fs::path{} : (directory_ / name).lexically_normal();
    } catch (const std::exception&) {
        return {};
    }
}

uint64_t file_size_bytes(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (error || !fs::exists(status)) throw FileError("does not exist or cannot be opened");
    if (fs::is_directory(status)) throw FileError("is a directory");
    if (!fs::is_regular_file(status)) throw FileError("is not a regular file");
    const uint64_t size = fs::file_size(file, error);
    if (error) throw FileError("its size cannot be read");
    return size;
}

RawBytes read_file(const fs::path& file, uint64_t most_bytes, bool on_all_cores) {
    const uint64_t size = std::min(file_size_bytes(file), most_bytes);
    const OpenFile open_file(file);
    RawBytes bytes(size);
    // Most of the time goes into pages of memory that are touched for the first time.
    constexpr uint64_t piece_bytes = uint64_t{1} << 19;
    const uint64_t pieces = on_all_cores ? (size + piece_bytes - 1) / piece_bytes : 1;
    if (pieces <= 1) {
        open_file.read(bytes, 0);
    } else {
        parallel_for_each(pieces, 1, [&](size_t i) {
            const uint64_t begin = i * piece_bytes;
            open_file.read(std::span(bytes).subspan(begin, std::min(piece_bytes, size - begin)), begin);
        });
    }
    return bytes;
}

bool is_data_uri(std::string_view uri) {
    constexpr std::string_view scheme = "data:";
    return uri.size() >= scheme.size() && std::equal(scheme.begin(), scheme.end(), uri.begin(), [](char a, char b) {
               return a == std::tolower(static_cast<unsigned char>(b));
           });
}

uint64_t data_uri_bound_bytes(std::string_view uri) {
    return uri.size();
}

RawBytes decode_data_uri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) throw FileError("the data: URI has no comma and so no data");
    const std::string_view head = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    constexpr std::string_view marker = ";base64";
    if (head.size() >= marker.size() && head.substr(head.size() - marker.size()) == marker) {
        return decode_base64(body.find('%') == std::string_view::npos ? std::string(body) : percent_decode(body));
    }
    const std::string text = percent_decode(body);
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

std::string percent_decode(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
            out += static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

}  // namespace candela
