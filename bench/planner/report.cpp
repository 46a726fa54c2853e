// The table, the list and the picture of the plans.
#include "planner/planner.h"

extern "C" {
#include "common/build.h"
#include "common/sheet.h"
}

#include <cstdio>
#include <numeric>

namespace planner {

namespace {

double get_median(std::vector<double> of) {
    if (of.empty()) return NAN;
    std::sort(of.begin(), of.end());
    return of[of.size() / 2];
}

/// A value of each plan whose ends were not refused; of the solved ones alone, where wanted.
template <class Get> std::vector<double> collect(const outcomes &of, bool only_solved, Get get) {
    std::vector<double> values;
    for (const outcome &plan : of)
        if (plan.end > path_end::unsolved || (!only_solved && plan.end == path_end::unsolved))
            values.push_back(get(plan));
    return values;
}

std::size_t count_ends(const outcomes &of, path_end end) {
    return std::size_t(std::count_if(of.begin(), of.end(), [&](const outcome &plan) { return plan.end == end; }));
}

const char *get_name(path_end end) {
    switch (end) {
    case path_end::refused: return "an end refused";
    case path_end::unsolved: return "unsolved";
    case path_end::proven: return "free";
    case path_end::hit_at_sample: return "hit at a sample";
    case path_end::hit_between: return "hit between samples";
    case path_end::open: return "open";
    }
    return "";
}

/// The points of a line: the k-th soonest path that is proven free, over its time in milliseconds.
struct line {
    std::vector<double> x, y;
};

line make_line(const outcomes &of) {
    line points;
    for (const outcome &plan : of)
        if (plan.end == path_end::proven) points.x.push_back(1e3 * (plan.planned + plan.shortened));
    std::sort(points.x.begin(), points.x.end());
    for (std::size_t i = 0; i < points.x.size(); i++) points.y.push_back(100 * double(i + 1) / double(of.size()));
    return points;
}

} // namespace

bool report(const sheet &of, const std::vector<contestant> &who) {
    std::printf("\n| %s | plans | ends refused | solved | ms to plan, median | s to plan, all | ms to shorten, median "
                "| proven free | "
                "hits at a sample | hits between samples | open | deepest, mm |\n"
                "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
                of.robot.c_str());
    for (std::size_t i = 0; i < who.size(); i++) {
        const outcomes &r = of.all[i];
        if (r.empty()) continue;
        const auto planned = collect(r, false, [](const outcome &plan) { return plan.planned; });
        const auto shortened = collect(r, true, [](const outcome &plan) { return plan.shortened; });
        const auto depths = collect(r, false, [](const outcome &plan) { return plan.depth; });
        std::printf("| %s | %zu | %zu | %zu | %.2f | %.3f | %.2f | %zu | %zu | %zu | %zu | %.2f |\n",
                    who[i].name.c_str(), r.size(), count_ends(r, path_end::refused), shortened.size(),
                    1e3 * get_median(planned), std::accumulate(planned.begin(), planned.end(), 0.0),
                    1e3 * get_median(shortened), count_ends(r, path_end::proven),
                    count_ends(r, path_end::hit_at_sample), count_ends(r, path_end::hit_between),
                    count_ends(r, path_end::open),
                    1e3 * (depths.empty() ? 0 : *std::max_element(depths.begin(), depths.end())));
    }
    return count_ends(of.all[0], path_end::proven) + count_ends(of.all[0], path_end::unsolved) == of.all[0].size();
}

bool write_csv(const char *file, const std::vector<sheet> &robots, const std::vector<contestant> &who) {
    std::FILE *out = std::fopen(file, "w");
    if (!out) return false;
    std::fprintf(out, "robot,problem,seed,checker,end,planned_ms,shortened_ms,depth_mm\n");
    for (const sheet &robot : robots)
        for (std::size_t i = 0; i < who.size(); i++)
            for (const outcome &plan : robot.all[i])
                std::fprintf(out, "%s,%u,%u,\"%s\",%s,%.4f,%.4f,%.3f\n", robot.robot.c_str(), plan.problem, plan.seed,
                             who[i].name.c_str(), get_name(plan.end), 1e3 * plan.planned, 1e3 * plan.shortened,
                             1e3 * plan.depth);
    return std::fclose(out) == 0;
}

bool write_svg(const char *file, const std::vector<sheet> &robots, const std::vector<contestant> &who,
               const char *planner) {
    std::vector<std::vector<line>> lines(robots.size());
    std::vector<std::vector<ovoid_series>> series(robots.size());
    std::vector<std::string> titles(robots.size());
    std::vector<ovoid_chart> charts;
    for (std::size_t k = 0; k < robots.size(); k++) {
        titles[k] = robots[k].robot + ", " + std::to_string(robots[k].all[0].size()) + " plans by " + planner;
        for (const outcomes &of : robots[k].all) lines[k].push_back(make_line(of));
        for (std::size_t i = 0; i < who.size(); i++) {
            if (robots[k].all[i].empty()) continue;
            ovoid_series one = {};
            one.name = who[i].name.c_str();
            one.count = lines[k][i].x.size();
            one.x = lines[k][i].x.data();
            one.y = lines[k][i].y.data();
            series[k].push_back(one);
        }
        ovoid_chart chart = {};
        chart.title = titles[k].c_str();
        chart.x_label = "ms of processor time, to plan and shorten";
        chart.y_label = "% with a path that is free at all times";
        chart.series = series[k].data();
        chart.series_count = series[k].size();
        chart.x_log = 1;
        chart.y_max = 100;
        chart.width = 520;
        chart.height = 400;
        charts.push_back(chart);
    }
    return sheet_write(file, charts.data(), std::uint32_t(charts.size()), 2, get_build()) != 0;
}

} // namespace planner
