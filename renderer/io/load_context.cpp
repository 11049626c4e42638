// SPDX-License-Identifier: MIT
#include "renderer/io/load_context.h"

#include <limits>

namespace candela {

void LoadContext::fail(std::string where, std::string reason) const {
    throw LoadError(path_, std::move(where), std::move(reason));
}

void LoadContext::fail_choice(std::string where, std::string reason) const {
    throw ChoiceError(path_, std::move(where), std::move(reason));
}

bool LoadContext::try_charge(uint64_t bytes) {
    uint64_t used = used_bytes_.load();
    do {
        if (bytes > options_.max_memory_bytes - used) return false;
    } while (!used_bytes_.compare_exchange_weak(used, used + bytes));
    return true;
}

void LoadContext::charge(uint64_t bytes, const std::string& where) {
    while (!try_charge(bytes)) {
        if (relief_) {
            std::exchange(relief_, nullptr)();
            continue;
        }
        throw OverMemoryLimit(path_, where,
                              "needs " + std::to_string(bytes) + " bytes, more than the memory limit of " +
                                  std::to_string(options_.max_memory_bytes) +
                                  " bytes allows; --limit-memory raises it");
    }
    const uint64_t net = net_bytes_ += bytes;
    uint64_t most = most_bytes_.load();
    while (net > most && !most_bytes_.compare_exchange_weak(most, net)) {
    }
}

void LoadContext::release(uint64_t bytes) {
    for (std::atomic<uint64_t>* sum : {&net_bytes_, &used_bytes_}) {
        uint64_t before = sum->load();
        while (!sum->compare_exchange_weak(before, before - std::min(before, bytes))) {
        }
    }
}

void LoadContext::charge(uint64_t count, uint64_t bytes_each, const std::string& where) {
    if (bytes_each != 0 && count > std::numeric_limits<uint64_t>::max() / bytes_each) {
        fail(where, "asks for more memory than can be counted");
    }
    charge(count * bytes_each, where);
}

void LoadContext::check_limit(uint64_t value, uint64_t limit, const char* unit, const char* option,
                              const std::string& where) const {
    if (value <= limit) return;
    fail(where, "has " + std::to_string(value) + " " + unit + ", more than the limit of " + std::to_string(limit) +
                    "; " + option + " raises it");
}

void LoadContext::progress(float fraction, const char* step) const {
    if (options_.progress) options_.progress(fraction, step);
}

void LoadContext::check_cancel() const {
    if (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) fail("", "cancelled");
}

}  // namespace candela
