// SPDX-License-Identifier: MIT
#include "app/validation/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace candela {

namespace {

constexpr double width = 760, height = 440;
constexpr double left = 78, right = 24, top = 48, bottom = 62;
// The exact curve is grey; what is measured comes in colours that differ in lightness too (Okabe and Ito 2008).
constexpr const char* exact_color = "#555555";
constexpr const char* colors[] = {"#d55e00", "#0072b2", "#009e73", "#cc79a7"};

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

double at_x(const SvgPlot& plot, double value) {
    return left + (width - left - right) * plot.x.position(value);
}

double at_y(const SvgPlot& plot, double value) {
    return height - bottom - (height - top - bottom) * plot.y.position(value);
}

std::string tick_label(double value, bool logarithmic) {
    if (!logarithmic || (value > 0.0009 && value < 9999))
        return fmt::format("{:g}", std::abs(value) < 1e-12 ? 0 : value);
    return fmt::format("1e{:g}", std::log10(value));
}

std::string axes(const SvgPlot& plot) {
    std::string out;
    for (const double tick : plot.x.ticks()) {
        const double x = at_x(plot, tick);
        out += fmt::format(R"(<line x1="{0:.1f}" x2="{0:.1f}" y1="{1:.1f}" y2="{2:.1f}" stroke="#e3e3e3"/>)", x, top,
                           height - bottom);
        out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", x, height - bottom + 20,
                           tick_label(tick, plot.x.logarithmic));
    }
    for (const double tick : plot.y.ticks()) {
        const double y = at_y(plot, tick);
        out += fmt::format(R"(<line x1="{1:.1f}" x2="{2:.1f}" y1="{0:.1f}" y2="{0:.1f}" stroke="#e3e3e3"/>)", y, left,
                           width - right);
        out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)", left - 8, y + 4.5,
                           tick_label(tick, plot.y.logarithmic));
    }
    out += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#888888"/>)", left, top,
                       width - left - right, height - top - bottom);
    out += fmt::format(R"(<text x="{:.1f}" y="{}" text-anchor="middle">{}</text>)", 0.5 * (left + width - right),
                       height - 18, escaped(plot.x.label));
    out += fmt::format(R"svg(<text transform="translate(20 {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
                       0.5 * (top + height - bottom), escaped(plot.y.label));
    out += fmt::format(R"(<text x="{}" y="28" font-size="16" font-weight="bold">{}</text>)", left, escaped(plot.title));
    return out + "\n";
}

std::string draw_line(const SvgPlot& plot, const PlotSeries& series, const char* color) {
    std::string path;
    for (const PlotPoint& p : series.points)
        path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : " L", at_x(plot, p.x), at_y(plot, p.y));
    return fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.8"/>)", path, color) + "\n";
}

// Series that meet in the same points stand a little apart.
std::string draw_points(const SvgPlot& plot, const PlotSeries& series, const char* color, double shift) {
    std::string out;
    for (const PlotPoint& p : series.points) {
        const double x = at_x(plot, p.x) + shift;
        if (p.bar > 0) {
            out += fmt::format(R"(<line x1="{0:.1f}" x2="{0:.1f}" y1="{1:.2f}" y2="{2:.2f}" stroke="{3}"/>)", x,
                               at_y(plot, p.y - p.bar), at_y(plot, p.y + p.bar), color);
        }
        out += fmt::format(R"(<circle cx="{:.1f}" cy="{:.2f}" r="3.4" fill="{}"/>)", x, at_y(plot, p.y), color);
    }
    return out + "\n";
}

std::string draw(const SvgPlot& plot) {
    std::string out = axes(plot);
    size_t measured = 0;
    size_t longest = 0;
    for (const PlotSeries& series : plot.series)
        longest = std::max(longest, series.label.size());
    const double legend_x = width - right - 40 - 7.6 * static_cast<double>(longest);
    double legend_y = top + 22;
    for (const PlotSeries& series : plot.series) {
        const bool is_exact = series.style == PlotStyle::line;
        const char* color = is_exact ? exact_color : colors[measured % std::size(colors)];
        const bool aside = series.style == PlotStyle::points;
        const double shift = aside ? 7.0 * (static_cast<double>(measured) - 1.0) : 0.0;
        if (series.style != PlotStyle::points) out += draw_line(plot, series, color);
        if (series.style != PlotStyle::line)
            out += draw_points(plot, series, color, plot.series.size() > 2 ? shift : 0.0);
        if (!is_exact) ++measured;

        out +=
            is_exact
                ? fmt::format(
                      R"(<line x1="{0:.1f}" x2="{1:.1f}" y1="{2:.1f}" y2="{2:.1f}" stroke="{3}" stroke-width="1.8"/>)",
                      legend_x - 8, legend_x + 8, legend_y - 4, color)
                : fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="3.4" fill="{}"/>)", legend_x, legend_y - 4, color);
        out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", legend_x + 16, legend_y, escaped(series.label));
        legend_y += 20;
    }
    return out;
}

}  // namespace

double PlotAxis::position(double value) const {
    if (!logarithmic) return (value - lower) / (upper - lower);
    return std::log(std::max(value, 1e-300) / lower) / std::log(upper / lower);
}

std::vector<double> PlotAxis::ticks() const {
    std::vector<double> out;
    if (logarithmic) {
        for (double tick = std::pow(10.0, std::ceil(std::log10(lower) - 1e-9)); tick <= upper * 1.0001; tick *= 10)
            out.push_back(tick);
        return out;
    }
    // The step is 1, 2 or 5 times a power of ten, for about six of them.
    const double rough = (upper - lower) / 6, decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = rough / decade < 1.5   ? decade
                        : rough / decade < 3.5 ? 2 * decade
                        : rough / decade < 7.5 ? 5 * decade
                                               : 10 * decade;
    for (int k = static_cast<int>(std::ceil(lower / step - 1e-9)); k * step <= upper + 1e-9 * step; ++k)
        out.push_back(k * step);
    return out;
}

std::string stack_plots(const std::vector<SvgPlot>& plots) {
    const double total = height * static_cast<double>(plots.size());
    std::string out = fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="DejaVu Sans, Arial, sans-serif" font-size="13" fill="#222222">)"
        "\n"
        R"(<rect width="{0}" height="{1}" fill="#ffffff"/>)"
        "\n",
        width, total);
    for (size_t i = 0; i < plots.size(); ++i)
        out +=
            fmt::format("<g transform=\"translate(0 {})\">\n{}</g>\n", height * static_cast<double>(i), draw(plots[i]));
    return out + "</svg>\n";
}

std::string SvgPlot::text() const {
    return stack_plots({*this});
}

}  // namespace candela
