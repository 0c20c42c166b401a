// SPDX-License-Identifier: MIT
#include "apps/select_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>
#include <stdexcept>
#include <utility>
#include <vantage/evaluation/recorded_views.hpp>
#include <vantage/version.hpp>

#include <vantage/map/impl/whole_file.hpp>
#include "apps/commands.hpp"
#include "apps/run_files.hpp"
#include "apps/run_printer.hpp"

namespace vantage::apps {
namespace {

using SelectionJson = nlohmann::ordered_json;

constexpr std::uint64_t kRandomOrders = 100;

// An order of the views and how it compares.
struct Contender {
  ViewOrderCurve curve;
  double above_random_volume = 0.0;  // share of the random orders with a smaller area
  double above_random_surface = 0.0;
  double above_random_void = 0.0;  // share of the random orders with a larger area: more void is left
  double choose_ms = 0.0;          // per view; 0 if nothing was chosen
};

struct Comparison {
  std::vector<std::string> frames;
  std::vector<SkippedFrame> skipped;
  std::vector<Contender> contenders;
  ViewOrderCurve greedy_volume;
  ViewOrderCurve greedy_surface;
  ViewOrderCurve greedy_void;
  ViewOrderCurve random_void;  // the median by void cells left
  double cell_dm3 = 0.0;
  std::size_t void_cells = 0;  // before the first view
};

// Shows the progress of choosing: one bar over all choosers, or a line for each that is done.
class ChoosingPrinter {
 public:
  ChoosingPrinter(ProgressStream& told, std::size_t choices) : told_(told), choices_(choices) {}

  // Called before a view is chosen.
  void choosing(const std::string& name, std::size_t view, std::size_t views) {
    if (!told_.is_terminal()) {
      return;
    }
    const double share = static_cast<double>(chosen_++) / static_cast<double>(choices_);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start_;
    told_.stream() << '\r' << drawn_bar(share) << name << ", view " << view << " of " << views;
    if (share > 0.0) {
      told_.stream() << "  about " << rounded_time(took.count() * (1.0 - share) / share) << " left";
    }
    told_.stream() << "\x1b[K" << std::flush;
  }
  void done(const Contender& contender) {
    if (!told_.is_terminal()) {
      told_.stream() << "chosen by " << contender.curve.name << std::endl;
    }
  }
  // Called when all are done.
  void finish() {
    if (told_.is_terminal()) {
      told_.stream() << "\r\x1b[K";
    }
  }

 private:
  ProgressStream& told_;
  std::size_t choices_;
  std::size_t chosen_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The median curve by `area`; sorts the curves.
template <class Area>
const ViewOrderCurve& median_of(std::vector<ViewOrderCurve>& curves, const Area& area) {
  std::sort(curves.begin(), curves.end(), [&](const auto& a, const auto& b) { return area(a) < area(b); });
  return curves[curves.size() / 2];
}

double share_below(const std::vector<double>& areas, double area) {
  const auto below = std::count_if(areas.begin(), areas.end(), [&](double other) { return other < area; });
  return static_cast<double>(below) / static_cast<double>(areas.size());
}

RecordedViews views_of(const ReplayRequest& request, const Recording& recording, Comparison& comparison) {
  comparison.skipped = recording.skipped();
  std::vector<Scan> scans;
  for (std::size_t i = 0; i < recording.frames().size() && scans.size() < request.run.max_views; i += request.every) {
    const std::string& name = recording.frames()[i].name;
    try {
      scans.push_back(recording.read(i).scan.scan);
      comparison.frames.push_back(name);
    } catch (const std::runtime_error& error) {
      comparison.skipped.push_back({name, error.what()});
    }
  }
  if (scans.size() < 2) {
    throw std::runtime_error(request.dataset + ": there are " + std::to_string(scans.size()) +
                             " frames to choose among, must be two");
  }
  RecordedViews views(std::move(scans), map_options_of(request), object_of(request));
  if (!views.show_any()) {
    throw std::runtime_error((!request.object_box.empty()   ? "--object-box " + request.object_box
                              : !request.run.region.empty() ? "--region " + request.run.region
                                                            : "--dataset " + request.dataset) +
                             " holds nothing that a frame shows");
  }
  return views;
}

Contender chosen(const RecordedViews& views, const std::string& name, const ChooseView& choose,
                 ChoosingPrinter& printer) {
  const auto start = std::chrono::steady_clock::now();
  Contender contender;
  const auto told = [&](const OccupancyMap& map, std::size_t last, std::span<const std::size_t> left) {
    printer.choosing(name, views.size() - left.size() + 1, views.size());
    return choose(map, last, left);
  };
  contender.curve = views.curve(name, chosen_order(views, 0, told));
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  contender.choose_ms = took.count() / static_cast<double>(views.size() - 1);
  printer.done(contender);
  return contender;
}

void add_choosers(const ReplayRequest& request, const Recording& recording, const RecordedViews& views,
                  ProgressStream& told, std::vector<Contender>& contenders) {
  const RangeSensor sensor = recording.sensor();
  const auto threads = static_cast<std::size_t>(request.run.threads);
  const std::vector<std::pair<std::string, ChooseView>> choosers{
      {"expected cells", most_expected_cells(views, sensor)},
      {"unknown cells", most_unknown_cells(views, sensor, threads)}};
  ChoosingPrinter printer(told, choosers.size() * (views.size() - 1));
  for (const auto& [name, choose] : choosers) {
    contenders.push_back(chosen(views, name, choose, printer));
  }
  printer.finish();
}

Comparison compare(const ReplayRequest& request, const Recording& recording, ProgressStream& told) {
  Comparison comparison;
  const RecordedViews views = views_of(request, recording, comparison);
  std::vector<double> random_volume;
  std::vector<double> random_surface;
  std::vector<double> random_void;  // negative, because less void is better
  std::vector<ViewOrderCurve> random;
  for (std::uint64_t i = 0; i < kRandomOrders; ++i) {
    random.push_back(views.curve("random, the median", views.random_order(0, request.run.seed + i)));
    random_volume.push_back(random.back().volume_area());
    random_surface.push_back(random.back().surface_area());
    random_void.push_back(-random.back().void_area());
  }
  comparison.contenders.push_back({views.curve("recorded order", views.recorded_order())});
  comparison.contenders.push_back({views.evenly_spaced("evenly spaced")});
  comparison.contenders.push_back({median_of(random, std::mem_fn(&ViewOrderCurve::volume_area))});
  comparison.random_void = median_of(random, std::mem_fn(&ViewOrderCurve::void_area));
  add_choosers(request, recording, views, told, comparison.contenders);
  for (Contender& contender : comparison.contenders) {
    contender.above_random_volume = share_below(random_volume, contender.curve.volume_area());
    contender.above_random_surface = share_below(random_surface, contender.curve.surface_area());
    contender.above_random_void = share_below(random_void, -contender.curve.void_area());
  }
  const auto greedy = [&](RecordedViews::Measure measure) {
    return views.curve("greedy", views.greedy_order(0, measure));
  };
  comparison.greedy_volume = greedy(RecordedViews::Measure::Volume);
  comparison.greedy_surface = greedy(RecordedViews::Measure::Surface);
  comparison.greedy_void = greedy(RecordedViews::Measure::Void);
  comparison.cell_dm3 = std::pow(10.0 * request.run.resolution_m, 3);
  comparison.void_cells = views.void_cells();
  return comparison;
}

void print_table(std::ostream& out, const Comparison& comparison) {
  char text[256];
  const double volume = comparison.greedy_volume.volume_area();
  const double surface = comparison.greedy_surface.surface_area();
  std::snprintf(text, sizeof text, "\n%-30s %7s %9s %8s   %8s %9s %8s  %12s\n", "", "volume", "of greedy", "> random",
                "surface", "of greedy", "> random", "choosing");
  out << text;
  for (const Contender& contender : comparison.contenders) {
    const ViewOrderCurve& curve = contender.curve;
    std::snprintf(text, sizeof text, "%-30s %7.4f %7.1f %% %6.0f %%   %8.4f %7.1f %% %6.0f %%", curve.name.c_str(),
                  curve.volume_area(), 100.0 * curve.volume_area() / volume, 100.0 * contender.above_random_volume,
                  curve.surface_area(), 100.0 * curve.surface_area() / surface,
                  100.0 * contender.above_random_surface);
    out << text;
    if (contender.choose_ms > 0.0) {
      std::snprintf(text, sizeof text, "  %9.1f ms", contender.choose_ms);
      out << text;
    }
    out << '\n';
  }
  std::snprintf(text, sizeof text, "%-30s %7.4f %7.1f %% %8s   %8.4f %7.1f %%\n", "greedy", volume, 100.0, "",
                surface, 100.0);
  out << text
      << "\nAreas under the curves of what is known over the number of views, as shares of what all views know;\n"
         "> random: of 100 random orders, those it is above; greedy: who has seen all views already.\n";
}

// Up to eight numbers of views, evenly spread, including the first and the last.
std::vector<std::size_t> columns_of(std::size_t views) {
  const std::size_t count = std::min<std::size_t>(views, 8);
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < count; ++i) {
    columns.push_back(1 + (2 * i * (views - 1) + count - 1) / (2 * (count - 1)));
  }
  return columns;
}

void print_void_table(std::ostream& out, const Comparison& comparison) {
  if (comparison.void_cells == 0) {
    return;  // the hits enclose no volume
  }
  const std::vector<std::size_t> columns = columns_of(comparison.frames.size());
  char text[128];
  std::snprintf(text, sizeof text, "\n%-30s", "void left, dm^3, after");
  out << text;
  for (const std::size_t views : columns) {
    std::snprintf(text, sizeof text, " %7zu", views);
    out << text;
  }
  out << "     mean  > random\n";
  const auto row = [&](const ViewOrderCurve& curve, const Contender* contender) {
    std::snprintf(text, sizeof text, "%-30s", curve.name.c_str());
    out << text;
    for (const std::size_t views : columns) {
      std::snprintf(text, sizeof text, " %7.1f",
                    comparison.cell_dm3 * static_cast<double>(curve.void_cells[views - 1]));
      out << text;
    }
    std::snprintf(text, sizeof text, " %8.2f", comparison.cell_dm3 * curve.void_area());
    out << text;
    if (contender != nullptr) {
      std::snprintf(text, sizeof text, " %7.0f %%", 100.0 * contender->above_random_void);
      out << text;
    }
    out << '\n';
  };
  for (const Contender& contender : comparison.contenders) {
    const bool median = contender.curve.name == comparison.random_void.name;
    median ? row(comparison.random_void, nullptr) : row(contender.curve, &contender);
  }
  row(comparison.greedy_void, nullptr);
  std::snprintf(text, sizeof text, "\nOf %.1f dm^3 inside the convex hull of all that the views hit;",
                comparison.cell_dm3 * static_cast<double>(comparison.void_cells));
  out << text << " the less is left, the better.\n";
}

SelectionJson json_of(const ViewOrderCurve& curve) {
  return {{"name", curve.name},
          {"volume_area", curve.volume_area()},
          {"surface_area", curve.surface_area()},
          {"void_area", curve.void_area()},
          {"order", curve.order},
          {"volume", curve.volume},
          {"surface", curve.surface},
          {"void_cells", curve.void_cells}};
}

std::string selection_json(const ReplayRequest& request, const Comparison& comparison) {
  SelectionJson orders = SelectionJson::array();
  for (const Contender& contender : comparison.contenders) {
    SelectionJson order = json_of(contender.curve);
    order["above_random_volume"] = contender.above_random_volume;
    order["above_random_surface"] = contender.above_random_surface;
    order["above_random_void"] = contender.above_random_void;
    order["choose_ms"] = contender.choose_ms;
    orders.push_back(std::move(order));
  }
  SelectionJson skipped = SelectionJson::array();
  for (const SkippedFrame& frame : comparison.skipped) {
    skipped.push_back({{"frame", frame.name}, {"reason", frame.reason}});
  }
  const SelectionJson json = {{"vantage", VANTAGE_VERSION_STRING},
                              {"command", "replay"},
                              {"world", request.dataset},
                              {"seed", request.run.seed},
                              {"threads", request.run.threads},
                              {"resolution_m", request.run.resolution_m},
                              {"selection",
                               {{"format", request.format},
                                {"frames", comparison.frames},
                                {"skipped", std::move(skipped)},
                                {"void_cells", comparison.void_cells},
                                {"orders", std::move(orders)},
                                {"random_void", json_of(comparison.random_void)},
                                {"greedy_volume", json_of(comparison.greedy_volume)},
                                {"greedy_surface", json_of(comparison.greedy_surface)},
                                {"greedy_void", json_of(comparison.greedy_void)}}}};
  return json.dump(1, ' ', false, SelectionJson::error_handler_t::replace) + "\n";
}

}  // namespace

int select_views(const ReplayRequest& request, const Recording& recording, ProgressStream& told) {
  std::ostream& progress = told.stream();
  const Comparison comparison = compare(request, recording, told);
  print_table(progress, comparison);
  print_void_table(progress, comparison);
  for (const SkippedFrame& frame : comparison.skipped) {
    progress << "left out " << frame.name << ": " << frame.reason << '\n';
  }
  const std::string json = selection_json(request, comparison);
  if (!request.run.out.empty()) {
    const std::filesystem::path folder(request.run.out);
    make_run_folder(folder);
    detail::write_whole_file(folder / "selection.json", json);
    tell_files(progress, {folder / "selection.json"});
  }
  give_json(request.run.json, json);
  return kDone;
}

}  // namespace vantage::apps
