// SPDX-License-Identifier: MIT
#include "app/viewer/compared_settings.h"

#include <fmt/format.h>

#include <charconv>

namespace candela {

IntegratorSettings ComparedSettings::in(IntegratorSettings settings) const {
    settings.estimator = estimator;
    settings.sampler = sampler;
    settings.max_depth = max_depth;
    return settings;
}

ComparedSettings opposite_of(const IntegratorSettings& settings) {
    return {settings.estimator == Estimator::bsdf ? Estimator::light : Estimator::bsdf, settings.sampler,
            settings.max_depth};
}

ComparedSettings compared_settings(const IntegratorSettings& settings, const std::vector<std::string>& words,
                                   std::string* unknown) {
    ComparedSettings out{settings.estimator, settings.sampler, settings.max_depth};
    for (const std::string& word : words) {
        constexpr std::string_view depth = "depth=";
        const char* end = word.data() + word.size();
        if (word == "mis") {
            out.estimator = Estimator::mis;
        } else if (word == "light") {
            out.estimator = Estimator::light;
        } else if (word == "bsdf") {
            out.estimator = Estimator::bsdf;
        } else if (word == "sobol") {
            out.sampler = SamplerKind::sobol;
        } else if (word == "independent") {
            out.sampler = SamplerKind::independent;
        } else if (!word.starts_with(depth) ||
                   std::from_chars(word.data() + depth.size(), end, out.max_depth).ptr != end ||
                   word.size() == depth.size()) {
            if (unknown->empty()) *unknown = word;
        }
    }
    return out;
}

std::string words_of(const IntegratorSettings& settings, const IntegratorSettings& other) {
    constexpr const char* estimators[] = {"both techniques", "light points", "directions"};
    constexpr const char* samplers[] = {"Sobol points", "independent points"};
    std::string out;
    const auto add = [&](const std::string& words) { out += (out.empty() ? "" : ", ") + words; };
    if (settings.estimator != other.estimator) add(estimators[static_cast<size_t>(settings.estimator)]);
    if (settings.sampler != other.sampler) add(samplers[static_cast<size_t>(settings.sampler)]);
    if (settings.max_depth != other.max_depth)
        add(settings.max_depth == 0 ? "any depth" : fmt::format("depth {}", settings.max_depth));
    return out.empty() ? estimators[static_cast<size_t>(settings.estimator)] : out;
}

}  // namespace candela
