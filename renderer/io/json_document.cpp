// SPDX-License-Identifier: MIT
#include "renderer/io/json_document.h"

#include <unordered_map>

#include <nlohmann/json.hpp>

namespace candela {
namespace {

std::string line_and_column(std::string_view text, size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t newline = before.rfind('\n');
    const size_t column = newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// Counts open brackets outside strings; enough to bound the depth of whatever a parser makes of the text.
void check_nesting(LoadContext& context, std::string_view text) {
    const int most = std::min(context.options().max_json_nesting, most_json_nesting);
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                in_string = false;
            }
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > most) {
                context.fail("", "JSON is nested deeper than the limit of " + std::to_string(most) + " levels at " +
                                     line_and_column(text, i) + "; --limit-nesting raises it");
            }
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

// How many objects all arrays at the same kind of place have together: "/meshes/*/primitives".
class ObjectCounter {
  public:
    explicit ObjectCounter(const LoadContext& context) : context_(context) {}

    void count(const Json& value) {
        const size_t length = place_.size();
        if (value.is_object()) {
            for (auto member = value.begin(); member != value.end(); ++member) {
                if (!member->is_structured()) continue;
                place_ += "/" + pointer_token(member.key());
                count(*member);
                place_.resize(length);
            }
        } else if (std::any_of(value.begin(), value.end(),
                               [](const Json& element) { return element.is_structured(); })) {
            const uint64_t total = totals_[place_] += value.size();
            context_.check_limit(total, context_.options().max_count, "elements", "--limit-count", place_);
            place_ += "/*";
            for (const Json& element : value)
                count(element);
            place_.resize(length);
        }
    }

  private:
    const LoadContext& context_;
    std::string place_;
    std::unordered_map<std::string, uint64_t> totals_;
};

}  // namespace

Json parse_json(LoadContext& context, std::string_view text) {
    // GLB pads its JSON with spaces, some writers with zeros.
    while (!text.empty() && text.back() == '\0')
        text.remove_suffix(1);
    if (text.empty()) context.fail("", "the file holds no JSON");
    context.check_limit(text.size(), context.options().max_json_bytes, "bytes of JSON", "--limit-json", "");
    // A parsed value takes up to some thirty times the bytes of its text.
    constexpr uint64_t bytes_per_character = 32;
    context.charge(text.size(), bytes_per_character, "");
    check_nesting(context, text);
    Json document;
    try {
        document = Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        context.fail("", "malformed JSON at " + line_and_column(text, error.byte == 0 ? 0 : error.byte - 1));
    } catch (const Json::exception&) {
        context.fail("", "malformed JSON: a number is out of range");
    }
    context.release(text.size() * bytes_per_character);
    if (!document.is_object()) context.fail("", "the JSON root is not an object");
    ObjectCounter(context).count(document);
    return document;
}

std::string pointer_token(std::string_view name) {
    std::string token;
    for (const char c : name) {
        if (c == '~') {
            token += "~0";
        } else if (c == '/') {
            token += "~1";
        } else {
            token += c;
        }
    }
    return token;
}

}  // namespace candela
