// SPDX-License-Identifier: MIT
// Small plots as SVG: axes with ticks, lines, points with error bars, a legend.
#pragma once

#include <string>
#include <vector>

namespace candela {

struct PlotPoint {
    double x = 0, y = 0;
    double bar = 0;  // half the length of the error bar
};

enum class PlotStyle : unsigned char { line, points, line_with_points };

struct PlotSeries {
    std::string label;
    PlotStyle style = PlotStyle::line;
    std::vector<PlotPoint> points;
};

struct PlotAxis {
    std::string label;
    double lower = 0, upper = 1;
    bool logarithmic = false;

    // 0..1 along the axis.
    double position(double value) const;
    // Round values between the ends.
    std::vector<double> ticks() const;
};

struct SvgPlot {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;

    // A whole SVG document.
    std::string text() const;
};

// One document with the plots below each other.
std::string stack_plots(const std::vector<SvgPlot>& plots);

}  // namespace candela
