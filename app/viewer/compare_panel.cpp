// SPDX-License-Identifier: MIT
// Two settings beside each other, and the measures of a reference.
#include <fmt/format.h>
#include <imgui.h>

#include "app/viewer/panels.h"

namespace candela {

std::string metric_words(ReferenceMetric metric, const ImageDifference& difference) {
    if (metric == ReferenceMetric::signed_difference) return fmt::format("signed mean {:+.3g}", difference.signed_mean);
    if (metric == ReferenceMetric::relative_square) return fmt::format("relMSE {:.3g}", difference.rel_mse);
    return fmt::format("FLIP {:.3f}", difference.flip);
}

std::string comparison_words(const ViewerModel& model) {
    if (!model.comparison.shown) return "";
    const IntegratorSettings& settings = model.job.request.settings;
    const IntegratorSettings other = model.comparison.settings.in(settings);
    const double a = model.film.relative_error, b = model.comparison.film.relative_error;
    if (!(a > 0) || !(b > 0) || !std::isfinite(a) || !std::isfinite(b)) return "";
    const double ratio = std::max(a, b) / std::min(a, b);
    const std::string worse = words_of(a > b ? settings : other, a > b ? other : settings),
                      better = words_of(a > b ? other : settings, a > b ? settings : other);
    std::string words = fmt::format("{}: {:.3g} times the error of {}", worse, ratio, better);
    // Errors fall with the root of the time, which limits of samples may have made unequal.
    const double seconds = model.status.render_seconds, others = model.comparison.status.render_seconds;
    if (std::abs(seconds - others) > 0.2 * std::min(seconds, others)) return words;
    return words + fmt::format(", as if with {:.2g} of the time", 1 / (ratio * ratio));
}

void compare_section(ViewerModel& model, PanelEdits& edits) {
    if (!ImGui::CollapsingHeader("Compare")) return;
    bool shown = model.comparison.shown;
    edits.compare = ImGui::Checkbox("two settings, half the cores each", &shown);
    if (model.comparison.shown) {
        ComparedSettings& other = model.comparison.settings;
        constexpr const char* estimators[] = {"MIS", "light", "BSDF"};
        constexpr const char* samplers[] = {"Sobol", "independent"};
        int estimator = static_cast<int>(other.estimator), sampler = static_cast<int>(other.sampler),
            depth = static_cast<int>(other.max_depth);
        edits.compared |= ImGui::Combo("estimator##other", &estimator, estimators, 3);
        edits.compared |= ImGui::Combo("sampler##other", &sampler, samplers, 2);
        edits.compared |= ImGui::SliderInt("depth##other", &depth, 0, 16, depth == 0 ? "no limit" : "%d (biased)",
                                           ImGuiSliderFlags_AlwaysClamp);
        other = {static_cast<Estimator>(estimator), static_cast<SamplerKind>(sampler), static_cast<uint32_t>(depth)};
    }
    if (!model.reference) {
        edits.reference_dialog = ImGui::Button("Open a reference (Ctrl+Shift+O)");
        return;
    }
    ImGui::TextWrapped("reference: %s", file_name(model.reference->path).c_str());
    constexpr const char* metrics[] = {"none", "signed difference", "relative square", "FLIP"};
    int metric = model.map.shown && model.map.metric ? 1 + static_cast<int>(*model.map.metric) : 0;
    if (ImGui::Combo("measure", &metric, metrics, 4)) {
        model.map.shown = metric > 0;
        model.map.metric.reset();
        if (metric > 0) model.map.metric = static_cast<ReferenceMetric>(metric - 1);
        edits.metric = true;
    }
}

}  // namespace candela
