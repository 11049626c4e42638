// SPDX-License-Identifier: MIT
// What a loader says to the person: warnings collected on the way, or the one error that ended it.
#pragma once

#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace candela {

struct Diagnostic {
    std::string where;    // JSON pointer ("/meshes/0/primitives/1") or empty
    std::string message;  // one line
};

// Not thread-safe. Repeated messages are folded by the collector: at most max_per_kind of one message text are kept and
// the rest are counted.
class Diagnostics {
  public:
    static constexpr size_t max_per_kind = 8;

    void warn(std::string where, std::string message) {
        if (++count_of_[message] > max_per_kind) {
            ++folded_;
            return;
        }
        warnings_.push_back({std::move(where), std::move(message)});
    }
    const std::vector<Diagnostic>& warnings() const { return warnings_; }
    // Warnings that were not kept.
    size_t folded() const { return folded_; }

  private:
    std::vector<Diagnostic> warnings_;
    std::unordered_map<std::string, size_t> count_of_;
    size_t folded_ = 0;
};

// what() is "PATH: WHERE: REASON" on one line.
class LoadError : public std::runtime_error {
  public:
    LoadError(std::string path, std::string where, std::string reason)
        : std::runtime_error(path + ": " + (where.empty() ? "" : where + ": ") + reason),
          path_(std::move(path)),
          where_(std::move(where)),
          reason_(std::move(reason)) {}
    const std::string& path() const { return path_; }
    const std::string& where() const { return where_; }
    const std::string& reason() const { return reason_; }

  private:
    std::string path_, where_, reason_;
};

// The file is well, but has not what the caller asked of it: a scene, a variant.
class ChoiceError : public LoadError {
  public:
    using LoadError::LoadError;
};

}  // namespace candela
