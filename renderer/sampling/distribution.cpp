// SPDX-License-Identifier: MIT
#include "renderer/sampling/distribution.h"

namespace candela {

AliasTable::AliasTable(std::span<const float> weights) {
    const size_t n = weights.size();
    entries_.resize(n);
    if (n == 0) return;
    double total = 0;
    for (const float w : weights)
        total += static_cast<double>(w);

    // Scale weights to a mean of 1, and sort cells into those that lack and those that have too much (Vose 1991).
    std::vector<double> scaled(n);
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < n; ++i) {
        const double p = total > 0 ? static_cast<double>(weights[i]) / total : 1.0 / static_cast<double>(n);
        entries_[i].probability = static_cast<float>(p);
        entries_[i].alias = i;
        scaled[i] = p * static_cast<double>(n);
        (scaled[i] < 1.0 ? small : large).push_back(i);
    }
    // Fill each cell that lacks from one that has too much.
    while (!small.empty() && !large.empty()) {
        const uint32_t s = small.back();
        const uint32_t l = large.back();
        small.pop_back();
        entries_[s].threshold = static_cast<float>(scaled[s]);
        entries_[s].alias = l;
        scaled[l] -= 1.0 - scaled[s];
        if (scaled[l] < 1.0) {
            large.pop_back();
            small.push_back(l);
        }
    }
    // What rounding leaves over: full cells, but never a cell of weight 0.
    for (const uint32_t i : small) {
        if (entries_[i].probability > 0.0f) continue;
        entries_[i].threshold = 0.0f;
        entries_[i].alias = static_cast<uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
    }
}

AliasTable::Choice AliasTable::sample(float u) const noexcept {
    const float scaled = u * static_cast<float>(entries_.size());
    const auto cell = std::min(static_cast<uint32_t>(scaled), static_cast<uint32_t>(entries_.size() - 1));
    const float within = std::min(scaled - static_cast<float>(cell), one_minus_epsilon);
    const Entry& entry = entries_[cell];
    Choice choice;
    if (within < entry.threshold) {
        choice.index = cell;
        choice.u_remapped = within / entry.threshold;
    } else {
        choice.index = entry.alias;
        choice.u_remapped = (within - entry.threshold) / (1.0f - entry.threshold);
    }
    choice.u_remapped = std::min(choice.u_remapped, one_minus_epsilon);
    choice.probability = entries_[choice.index].probability;
    return choice;
}

namespace {

// Writes n + 1 values from 0 to 1; uniform where all weights are 0. Returns the sum of the weights.
double make_cdf(std::span<const double> weights, float* cdf) {
    const size_t n = weights.size();
    double total = 0;
    for (const double w : weights)
        total += w;
    double sum = 0;
    cdf[0] = 0.0f;
    for (size_t i = 0; i < n; ++i) {
        sum += total > 0 ? weights[i] / total : 1.0 / static_cast<double>(n);
        cdf[i + 1] = static_cast<float>(std::min(sum, 1.0));
    }
    cdf[n] = 1.0f;
    return total;
}

// The cell that holds u, and where in it.
struct CellPosition {
    int cell = 0;
    float offset = 0;
};

CellPosition find_cell(const float* cdf, int n, float u) {
    // The last entry that is <= u starts a cell of positive width.
    const auto cell = static_cast<int>(std::upper_bound(cdf, cdf + n + 1, u) - cdf) - 1;
    CellPosition out;
    out.cell = std::clamp(cell, 0, n - 1);
    const float width = cdf[out.cell + 1] - cdf[out.cell];
    out.offset = width > 0.0f ? std::min((u - cdf[out.cell]) / width, one_minus_epsilon) : 0.5f;
    return out;
}

}  // namespace

Distribution2D::Distribution2D(std::span<const float> weights, int width, int height) : width_(width), height_(height) {
    row_cdf_.resize(static_cast<size_t>(height) + 1);
    cell_cdf_.resize(static_cast<size_t>(height) * (static_cast<size_t>(width) + 1));
    std::vector<double> row(static_cast<size_t>(width));
    std::vector<double> row_totals(static_cast<size_t>(height));
    for (int y = 0; y < height; ++y) {
        const size_t first = static_cast<size_t>(y) * static_cast<size_t>(width);
        for (size_t x = 0; x < row.size(); ++x)
            row[x] = static_cast<double>(weights[first + x]);
        row_totals[static_cast<size_t>(y)] = make_cdf(row, &cell_cdf_[first + static_cast<size_t>(y)]);
    }
    make_cdf(row_totals, row_cdf_.data());
}

Vec2 Distribution2D::sample(const Vec2& u, float& pdf_out) const noexcept {
    const CellPosition row = find_cell(row_cdf_.data(), height_, u.y);
    const float* cells = &cell_cdf_[static_cast<size_t>(row.cell) * (static_cast<size_t>(width_) + 1)];
    const CellPosition cell = find_cell(cells, width_, u.x);
    pdf_out = (row_cdf_[static_cast<size_t>(row.cell) + 1] - row_cdf_[static_cast<size_t>(row.cell)]) *
              static_cast<float>(height_) * (cells[cell.cell + 1] - cells[cell.cell]) * static_cast<float>(width_);
    return {(static_cast<float>(cell.cell) + cell.offset) / static_cast<float>(width_),
            (static_cast<float>(row.cell) + row.offset) / static_cast<float>(height_)};
}

float Distribution2D::pdf(const Vec2& point) const noexcept {
    const int x = std::clamp(static_cast<int>(point.x * static_cast<float>(width_)), 0, width_ - 1);
    const int y = std::clamp(static_cast<int>(point.y * static_cast<float>(height_)), 0, height_ - 1);
    const float* cells = &cell_cdf_[static_cast<size_t>(y) * (static_cast<size_t>(width_) + 1)];
    return (row_cdf_[static_cast<size_t>(y) + 1] - row_cdf_[static_cast<size_t>(y)]) * static_cast<float>(height_) *
           (cells[x + 1] - cells[x]) * static_cast<float>(width_);
}

}  // namespace candela
