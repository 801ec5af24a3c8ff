// The page of trade_report.h: plots of error and FLIP against processor time, and the table.
#include "tools/frame_file.h"
#include "tools/html_parts.h"
#include "tools/validate/trade_dials.h"
#include "tools/validate/trade_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pluvia {
namespace {

constexpr int plot_width = 760, plot_height = 420, margin_left = 64, margin_bottom = 44, margin_top = 12,
              margin_right = 150;
constexpr const char* colors[] = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#17becf",
                                  "#8c564b", "#e377c2", "#7f7f7f", "#bcbd22", "#111111", "#0b6b3a"};

/// A logarithmic axis from the power of ten's part below the least value to that above the largest.
struct Axis {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    void add(double v) {
        if (v > 0) low = std::min(low, v), high = std::max(high, v);
    }
    void widen() {
        if (!(low <= high)) low = high = 1;
        low /= 1.25, high *= 1.25;
    }
    double place(double v) const { return std::log(std::max(v, low) / low) / std::log(high / low); }
    /// Round values within: 1, 2 and 5 times the powers of ten, or more digits where those are fewer than three.
    std::vector<double> ticks() const {
        std::vector<double> result;
        for (const auto& digits : {std::vector<double>{1, 2, 5}, std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 7, 8}}) {
            result.clear();
            for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10)
                for (const double digit : digits)
                    if (digit * power >= low && digit * power <= high) result.push_back(digit * power);
            if (result.size() >= 3) break;
        }
        return result;
    }
};

/// Results with the number of samples that settings of other dials have: beside those of more and fewer they would all
/// be in one place.
TradeReport of_one_count(const TradeReport& report) {
    TradeReport part = report;
    const int count = report.options.value("spp", 0);
    std::erase_if(part.results, [&](const TradeResult& r) { return r.samples != count; });
    return part;
}

std::string plot(const TradeReport& report, const std::string& title, double (TradeResult::*value)() const) {
    Axis time, error;
    for (const TradeResult& r : report.results) time.add(r.cpu_s), error.add((r.*value)());
    time.widen(), error.widen();
    const auto x = [&](double v) { return margin_left + time.place(v) * (plot_width - margin_left - margin_right); };
    const auto y = [&](double v) {
        return margin_top + (1 - error.place(v)) * (plot_height - margin_top - margin_bottom);
    };
    const double right = plot_width - margin_right, bottom = plot_height - margin_bottom;
    std::string svg = fmt::format("<h2>{}</h2><svg viewBox=\"0 0 {} {}\" width=\"{}\" font-size=\"12\">", title,
                                  plot_width, plot_height, plot_width);
    for (const double t : time.ticks())
        svg += fmt::format(
            "<path d=\"M{0:.1f} {1}V{2:.1f}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
            "text-anchor=\"middle\">{4:g}</text>",
            x(t), margin_top, bottom, bottom + 16, t);
    for (const double e : error.ticks())
        svg += fmt::format(
            "<path d=\"M{0} {1:.1f}H{2:.1f}\" stroke=\"#ddd\"/><text x=\"{3}\" y=\"{4:.1f}\" "
            "text-anchor=\"end\">{5:g}</text>",
            margin_left, y(e), right, margin_left - 6, y(e) + 4, e);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">processor seconds</text>",
                       (margin_left + right) / 2, plot_height - 8);

    std::vector<size_t> order;
    const std::vector<bool> front = pareto_front(report.results, value);
    for (size_t i = 0; i < front.size(); ++i)
        if (front[i]) order.push_back(i);
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return report.results[a].cpu_s < report.results[b].cpu_s; });
    std::string line;
    for (const size_t i : order)
        line += fmt::format("{:.1f},{:.1f} ", x(report.results[i].cpu_s), y((report.results[i].*value)()));
    svg += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#bbb\" stroke-width=\"7\" "
        "stroke-linejoin=\"round\" stroke-opacity=\".5\"/>",
        line);

    int row = 0;
    for (size_t d = 0; d < trade_dials().size(); ++d) {
        const std::string dial = trade_dials()[d].name;
        const char* color = colors[d % std::size(colors)];
        std::string points, marks;
        for (const TradeResult& r : report.results) {
            if (r.dial != dial) continue;
            const double px = x(r.cpu_s), py = y((r.*value)());
            points += fmt::format("{:.1f},{:.1f} ", px, py);
            marks += fmt::format(
                "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"4\" fill=\"{2}\" stroke=\"{3}\" "
                "stroke-width=\"1.5\"><title>{4} {5}: {6:.3g} s, {7:.4g}</title></circle><text "
                "x=\"{8:.1f}\" y=\"{9:.1f}\" fill=\"{3}\" font-size=\"10\">{5}</text>",
                px, py, r.biased ? "#fff" : color, color, html_escaped(dial), html_escaped(r.value), r.cpu_s,
                (r.*value)(), px + 6, py - 5);
        }
        if (points.empty()) continue;
        svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\"/>{}", points, color, marks);
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{}\" r=\"5\" fill=\"{}\"/><text x=\"{:.1f}\" y=\"{}\">{}</text>",
                           right + 14, 24 + 20 * row, color, right + 24, 28 + 20 * row, html_escaped(dial));
        ++row;
    }
    return svg + "</svg>";
}

}  // namespace

std::string trade_page(const TradeReport& report) {
    std::string html = "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>What accuracy costs: " +
                       html_escaped(report.scene) + "</title><style>" + html_page_style + "</style><h1>" +
                       html_escaped(report.scene) + ": what accuracy costs</h1>";
    html += fmt::format(
        "<p>Against a reference of {} samples, whose own error is {:.4f}. Error: square root of the trimmed relMSE, of "
        "the clean picture or of that of the highest intensity, whichever is larger. The broad grey line joins what "
        "nothing beats in time and in what is plotted. Hollow: biased, so that more samples lead elsewhere.</p>",
        report.reference_samples, report.reference_error);
    html += plot(report, "Error", &TradeResult::error);
    html += plot(report, "FLIP, as an eye sees it", &TradeResult::flip);
    if (const TradeReport part = of_one_count(report); part.results.size() > 1) {
        html += plot(part, fmt::format("Error of {} samples", part.results[0].samples), &TradeResult::error);
        html += plot(part, fmt::format("FLIP of {} samples", part.results[0].samples), &TradeResult::flip);
    }
    html += "<h2>Dials</h2><ul>";
    for (const TradeDial& dial : trade_dials())
        html += "<li><b>" + std::string(dial.name) + "</b>: " + html_escaped(dial.meaning) + "</li>";
    html += "</ul><h2>Numbers</h2><pre>" + html_escaped(trade_table(report)) + "</pre><h2>Settings</h2><pre>" +
            html_escaped(json_text(report.options, 2)) + "</pre></html>\n";
    return html;
}

}  // namespace pluvia
