// SPDX-License-Identifier: MIT
// Changes a glTF file as a document: values are replaced, moved, doubled and left out, the bytes of the binary chunk
// changed. Bytes changed at random would hardly ever be JSON again.
#include <nlohmann/json.hpp>

#include <cstring>
#include <random>

#include "renderer/io/glb_container.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace candela;
using Json = nlohmann::json;

class Mutation {
  public:
    explicit Mutation(unsigned seed) : random_(seed) {}

    size_t below(size_t n) { return n == 0 ? 0 : random_() % n; }

    void change(Json& document) {
        Json* parent = nullptr;
        Json* value = pick(document, &parent);
        switch (below(7)) {
            case 0:
                *value = nasty_value();
                return;
            case 1: {  // Another value of the document; copied first, for it may lie inside of the one it replaces.
                const Json copy = *pick(document, nullptr);
                *value = copy;
                return;
            }
            case 2:
                if (parent != nullptr) erase(*parent);
                return;
            case 3:
                if (value->is_array() && !value->empty()) {
                    const Json copy = (*value)[below(value->size())];
                    value->push_back(copy);
                } else if (value->is_object()) {
                    insert_member(document, *value);
                }
                return;
            default:
                nudge(document, *value);
        }
    }

  private:
    // Walks down at random. parent: the container of what is returned.
    Json* pick(Json& document, Json** parent) {
        Json* at = &document;
        while (at->is_structured() && !at->empty() && (at == &document || below(6) != 0)) {
            if (parent != nullptr) *parent = at;
            at = &*std::next(at->begin(), static_cast<std::ptrdiff_t>(below(at->size())));
        }
        return at;
    }

    Json nasty_value() {
        const Json values[] = {nullptr,
                               true,
                               "",
                               -1,
                               0,
                               1,
                               2,
                               3,
                               255,
                               65535,
                               65536,
                               4294967295,
                               2147483647,
                               0.5,
                               1e-30,
                               1e30,
                               1e308,
                               -1e308,
                               5126,
                               9223372036854775807,
                               "x",
                               Json::array(),
                               Json::object(),
                               1e-310};
        return values[below(std::size(values))];
    }

    void nudge(Json& document, Json& value) {
        if (value.is_number_integer()) {
            const int64_t old = value.get<int64_t>();
            // Small numbers are mostly indices, others mostly counts and offsets.
            const int64_t step = static_cast<int64_t>(below(9)) - 4;
            value = below(4) == 0 ? static_cast<int64_t>(below(8)) : (old > 1'000'000'000 ? old / 2 : old + step);
        } else if (value.is_number_float()) {
            const double factors[] = {-1, 0, 0.5, 2, 1e3, 1e10, 1e30, 1e-10};
            value = value.get<double>() * factors[below(std::size(factors))];
        } else if (value.is_string()) {
            // A word of the same document: types, modes and extension names change places.
            const Json& other = *pick(document, nullptr);
            if (other.is_string()) value = other.get<std::string>();
        } else {
            Json* inner = pick(value, nullptr);
            *inner = nasty_value();
        }
    }

    void erase(Json& parent) {
        const auto at = std::next(parent.begin(), static_cast<std::ptrdiff_t>(below(parent.size())));
        parent.erase(at);
    }

    void insert_member(Json& document, Json& object) {
        Json* donor = nullptr;
        pick(document, &donor);
        if (donor == nullptr || !donor->is_object() || donor->empty()) return;
        const auto member = std::next(donor->begin(), static_cast<std::ptrdiff_t>(below(donor->size())));
        const Json copy = member.value();
        object[member.key()] = copy;
    }

    std::minstd_rand random_;
};

bool is_nested_deeply(std::string_view text) {
    int depth = 0;
    for (const char c : text) {
        depth += (c == '[' || c == '{') ? 1 : (c == ']' || c == '}') ? -1 : 0;
        if (depth > 100) return true;
    }
    return false;
}

void append_u32(std::string& out, size_t value) {
    for (int i = 0; i < 4; ++i)
        out.push_back(static_cast<char>(value >> (8 * i)));
}

std::string make_glb(std::string json, std::span<const uint8_t> bin) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    append_u32(out, 2);
    append_u32(out, 12 + 8 + json.size() + 8 + bin.size());
    append_u32(out, json.size());
    out += "JSON" + json;
    append_u32(out, bin.size());
    out += std::string("BIN\0", 4);
    out.append(reinterpret_cast<const char*>(bin.data()), bin.size());
    return out;
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
    Mutation mutation(seed);
    if (mutation.below(20) == 0) return LLVMFuzzerMutate(data, size, max_size);
    const std::span<const std::byte> bytes = fuzz::bytes_of(data, size);
    GlbChunks chunks;
    try {
        chunks = looks_like_glb(bytes) ? parse_glb(bytes) : GlbChunks{fuzz::text_of(data, size), std::nullopt};
    } catch (const std::runtime_error&) {
        return LLVMFuzzerMutate(data, size, max_size);
    }
    if (is_nested_deeply(chunks.json)) return LLVMFuzzerMutate(data, size, max_size);
    Json document = Json::parse(chunks.json, nullptr, false);
    if (!document.is_object()) return LLVMFuzzerMutate(data, size, max_size);

    std::vector<uint8_t> bin;
    if (chunks.bin) {
        const auto* first = reinterpret_cast<const uint8_t*>(chunks.bin->data());
        bin.assign(first, first + chunks.bin->size());
    }
    if (!bin.empty() && mutation.below(3) == 0) {
        bin.resize(LLVMFuzzerMutate(bin.data(), bin.size(), bin.size()));
    } else {
        mutation.change(document);
    }
    const std::string json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    const std::string out = chunks.bin ? make_glb(json, bin) : json;
    if (out.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
    std::memcpy(data, out.data(), out.size());
    return out.size();
}
