// SPDX-License-Identifier: MIT
// The path of a pixel's brightest sample as a table.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <numeric>

#include "app/viewer/fields.h"
#include "app/viewer/panels.h"

namespace candela {

namespace {

constexpr size_t columns = 10, surface_column = 1;
using Cells = std::array<std::string, columns>;

Cells cells_of(const LedgerRow& row) {
    return {row.number,    row.is_light ? "←  " + row.what : row.what,
            row.how,       row.pdf,
            row.other_pdf, row.share,
            row.color[0],  row.color[1],
            row.color[2],  row.note};
}

bool is_number(size_t column) {
    return column == 0 || (column >= 3 && column <= 8);
}

// Every column is as wide as its widest cell; figures end at its right, and names give way.
void draw_cells(std::vector<Cells> cells, const std::vector<LedgerRow>& rows, float most_width) {
    const auto text_width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
    std::array<float, columns> widths{};
    for (const Cells& line : cells) {
        for (size_t c = 0; c < columns; ++c)
            widths[c] = std::max(widths[c], text_width(line[c]));
    }
    const float gaps = 2 * columns * ImGui::GetStyle().CellPadding.x;
    const float excess = std::accumulate(widths.begin(), widths.end(), gaps) - most_width;
    if (excess > 0) {
        float& width = widths[surface_column];
        width = std::max(width - excess, 4 * ImGui::GetFontSize());
        for (Cells& line : cells)
            line[surface_column] = shortened(line[surface_column], width, text_width);
    }
    if (!ImGui::BeginTable("ledger", columns, ImGuiTableFlags_SizingFixedFit)) return;
    for (const float width : widths)
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, width);
    for (size_t i = 0; i < cells.size(); ++i) {
        const bool is_quiet = i == 0 || rows[i - 1].brings_nothing;
        if (is_quiet) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        for (size_t c = 0; c < columns; ++c) {
            ImGui::TableNextColumn();
            const float room = widths[c] - text_width(cells[i][c]);
            if (is_number(c)) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
            ImGui::TextUnformatted(cells[i][c].c_str());
        }
        if (is_quiet) ImGui::PopStyleColor();
    }
    ImGui::EndTable();
}

}  // namespace

void draw_ledger(const PixelLedger& ledger, size_t most_rows, float most_width) {
    const Ledger& path = ledger.path;
    ImGui::TextUnformatted(fmt::format("its brightest of {} samples: number {}, {:.3g}", ledger.samples,
                                       path.sample.index, luminance(path.radiance))
                               .c_str());
    ImGui::TextDisabled("R G B: what the path carries on, and what a light ← brings");
    std::vector<LedgerRow> rows = ledger.rows;
    // Where room is short, what adds nothing goes first.
    if (rows.size() > most_rows)
        rows.erase(std::remove_if(rows.begin(), rows.end(), [](const LedgerRow& row) { return row.brings_nothing; }),
                   rows.end());
    const size_t left_out = rows.size() - std::min(rows.size(), most_rows);
    rows.resize(rows.size() - left_out);
    std::vector<Cells> cells{{"", "surface", "lobe", "pdf/sr", "other", "share", "R", "G", "B", ""}};
    for (const LedgerRow& row : rows)
        cells.push_back(cells_of(row));
    draw_cells(cells, rows, most_width);
    if (left_out > 0) ImGui::TextDisabled("and %zu more", left_out);
}

}  // namespace candela
