// SPDX-License-Identifier: MIT
// What every step of a load needs: whom to tell, how much memory is left, whether to go on.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/io/load_gltf.h"

namespace candela {

class LoadContext {
  public:
    LoadContext(std::string path, Diagnostics& diagnostics, const LoadOptions& options)
        : path_(std::move(path)),
          diagnostics_(diagnostics),
          options_(options),
          own_bytes_(0),
          used_bytes_(own_bytes_) {}
    // For a part of the load that runs on a thread of its own: its warnings are kept apart, memory is booked together.
    LoadContext(LoadContext& whole, Diagnostics& diagnostics)
        : path_(whole.path_),
          diagnostics_(diagnostics),
          options_(whole.options_),
          own_bytes_(0),
          used_bytes_(whole.used_bytes_) {}

    const std::string& path() const { return path_; }
    const LoadOptions& options() const { return options_; }

    // where is a JSON pointer into the document as the file has it, or empty.
    [[noreturn]] void fail(std::string where, std::string reason) const;
    // What the caller chose is not in the file.
    [[noreturn]] void fail_choice(std::string where, std::string reason) const;
    void warn(std::string where, std::string message) { diagnostics_.warn(std::move(where), std::move(message)); }

    // Books memory before it is allocated; throws OverMemoryLimit where the limit would be passed.
    void charge(uint64_t bytes, const std::string& where);
    // count · bytes_each, which may overflow.
    void charge(uint64_t count, uint64_t bytes_each, const std::string& where);
    // False, and nothing is booked, where the limit would be passed. From any thread.
    bool try_charge(uint64_t bytes);
    void release(uint64_t bytes);
    uint64_t bytes_left() const { return options_.max_memory_bytes - used_bytes_.load(); }
    // Called once where charge would fail: what it releases may do. Of this context only.
    void set_relief(std::function<void()> relief) { relief_ = std::move(relief); }
    std::function<void()> take_relief() { return std::exchange(relief_, nullptr); }
    // What charge has booked through this context and release has not given back.
    uint64_t net_bytes() const { return net_bytes_; }
    // The most that this has been.
    uint64_t most_bytes() const { return most_bytes_; }

    // Throws LoadError where value is over a limit of the options. unit: "nodes"; option: "--limit-count".
    void check_limit(uint64_t value, uint64_t limit, const char* unit, const char* option,
                     const std::string& where) const;

    void progress(float fraction, const char* step) const;
    // Throws LoadError "cancelled" once the caller has asked for it.
    void check_cancel() const;

  private:
    std::string path_;
    Diagnostics& diagnostics_;
    const LoadOptions& options_;
    std::function<void()> relief_;
    std::atomic<uint64_t> net_bytes_ = 0, most_bytes_ = 0;
    std::atomic<uint64_t> own_bytes_;
    std::atomic<uint64_t>& used_bytes_;
};

// So that a step that has run out of memory beside others can be done again alone.
class OverMemoryLimit : public LoadError {
  public:
    using LoadError::LoadError;
};

// "/meshes", 3, "primitives", 1 → "/meshes/3/primitives/1".
inline std::string pointer_to(std::string_view base, uint64_t index) {
    return std::string(base) + "/" + std::to_string(index);
}
template <typename... Rest>
std::string pointer_to(std::string_view base, uint64_t index, std::string_view member, Rest... rest) {
    std::string head = pointer_to(base, index) + "/" + std::string(member);
    if constexpr (sizeof...(rest) == 0) {
        return head;
    } else {
        return pointer_to(std::string_view(head), rest...);
    }
}

}  // namespace candela
