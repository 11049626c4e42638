// SPDX-License-Identifier: MIT
#include "app/viewer/configuration_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/exit_status.h"

namespace candela {

namespace {

std::filesystem::path broken_path(const std::filesystem::path& path) {
    return path.string() + ".broken";
}

}  // namespace

std::filesystem::path configuration_path(const char* name) {
    const auto folder = [](const char* variable) {
        const char* value = std::getenv(variable);
        // The specification has relative paths ignored.
        return value != nullptr && value[0] == '/' ? std::filesystem::path(value) : std::filesystem::path();
    };
    const std::filesystem::path configured = folder("XDG_CONFIG_HOME"), home = folder("HOME");
    if (!configured.empty()) return configured / "candela" / name;
    if (!home.empty()) return home / ".config" / "candela" / name;
    return {};
}

std::optional<std::string> read_configuration(const std::filesystem::path& path, size_t most_bytes) {
    std::error_code error;
    if (path.empty() || !std::filesystem::exists(path, error)) return std::nullopt;
    // A pipe or a device would never end.
    if (!std::filesystem::is_regular_file(path, error)) throw BrokenFile{"it is no file"};
    std::ifstream file(path, std::ios::binary);
    std::string text(most_bytes + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file.is_open() || file.bad()) throw BrokenFile{"it cannot be read"};
    text.resize(static_cast<size_t>(file.gcount()));
    if (text.size() > most_bytes) throw BrokenFile{"it is far too large"};
    return text;
}

void write_configuration(const std::filesystem::path& path, const std::string& text, const char* what) {
    // One window's file does not mix with another's, and a reader sees the old one or the new one.
    const std::filesystem::path beside = path.string() + fmt::format(".{}", getpid());
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    std::ofstream file(beside, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (file) std::filesystem::rename(beside, path, error);
    if (!file || error) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw CommandError(ExitStatus::unwritable_output, fmt::format("{}: {} cannot be written", path.string(), what));
    }
}

void keep_broken(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) std::filesystem::rename(path, broken_path(path), ignored);
}

std::string words_of(const std::filesystem::path& path, const BrokenFile& broken) {
    return fmt::format("{}: {}; what it remembers is left out; mend it before this window closes, or find it as {}",
                       path.string(), broken.why, broken_path(path).filename().string());
}

bool is_utf8(const std::string& text) {
    try {
        return !nlohmann::json(text).dump().empty();
    } catch (const nlohmann::json::exception&) {
        return false;
    }
}

}  // namespace candela
