// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vantage/frontier/frontiers.hpp>
#include <vantage/report/map_export.hpp>
#include <vantage/report/run_record_reader.hpp>

#include "report/vtk_file.hpp"

namespace vantage {
namespace {

using Part = std::pair<std::size_t, std::filesystem::path>;

// A time series: a folder of parts and the .pvd file that lists them.
class Series {
 public:
  Series(const std::filesystem::path& folder, const std::string& name, std::string suffix)
      : file_(folder / (name + ".pvd")), folder_(folder / name), suffix_(std::move(suffix)) {}

  // Adds a time step and returns the path of its part.
  std::filesystem::path at(std::size_t view) {
    if (parts_.empty()) {
      std::filesystem::create_directories(folder_);
    }
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%05zu", view);
    parts_.emplace_back(view, folder_ / (digits.data() + suffix_));
    return parts_.back().second;
  }
  void finish(std::vector<std::filesystem::path>& files) const {
    if (!parts_.empty()) {
      detail::write_pvd(parts_, file_);
      files.push_back(file_);
    }
  }

 private:
  std::filesystem::path file_;
  std::filesystem::path folder_;
  std::string suffix_;
  std::vector<Part> parts_;
};

void write_occupancy(const OccupancyMap& map, const std::filesystem::path& file) {
  const VoxelBox cells = map.region().value_or(map.bounds());
  std::vector<std::uint8_t> states;
  states.reserve(cells.size());
  for_each_cell(cells, [&](const VoxelIndex& cell) {
    const Occupancy state = map.at(cell);
    states.push_back(state == Occupancy::Unknown ? 0 : state == Occupancy::Free ? 1 : 2);
  });
  detail::write_vti(cells, map.frame(), "occupancy", states, file);
}

void write_frontiers(const OccupancyMap& map, const std::filesystem::path& file) {
  detail::VtkPolyData data;
  for (const VoxelIndex& cell : frontier_cells(map)) {
    data.points.push_back(map.frame().centre_of(cell));
  }
  detail::write_vtp(data, file);
}

void write_field(const OccupancyMap& map, const std::vector<FieldArrow>& field, const std::filesystem::path& file) {
  detail::VtkPolyData data;
  std::vector<float> phi;
  std::vector<float> downhill;
  for (const FieldArrow& arrow : field) {
    data.points.push_back(map.frame().centre_of(arrow.cell));
    phi.push_back(arrow.phi);
    downhill.insert(downhill.end(), {arrow.downhill.x(), arrow.downhill.y(), arrow.downhill.z()});
  }
  data.point_arrays = detail::vtk_array("phi", phi) + detail::vtk_array("downhill", downhill, 3);
  detail::write_vtp(data, file);
}

void write_path(const std::vector<Eigen::Vector3d>& behind, const std::vector<Pose>& ahead,
                const std::filesystem::path& file) {
  detail::VtkPolyData data;
  data.points = behind;
  if (behind.size() == 1) {  // VTK cannot read a line with a single point
    data.points.push_back(behind.front());
  }
  data.line_lengths = {static_cast<std::int32_t>(data.points.size())};
  std::vector<std::uint8_t> planned{0};
  if (ahead.size() > 1) {
    for (const Pose& pose : ahead) {
      data.points.push_back(pose.translation());
    }
    data.line_lengths.push_back(static_cast<std::int32_t>(ahead.size()));
    planned.push_back(1);
  }
  data.line_arrays = detail::vtk_array("planned", planned);
  detail::write_vtp(data, file);
}

}  // namespace

std::vector<std::filesystem::path> write_paraview(const std::filesystem::path& record,
                                                  const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(folder.string() + ": is not a folder");
  }
  RunRecordReader reader(record);
  std::optional<RecordedCycle> cycle = reader.next();
  OccupancyMap map = reader.new_map();
  Series occupancy(folder, "occupancy", ".vti");
  Series frontiers(folder, "frontiers", ".vtp");
  Series path(folder, "path", ".vtp");
  Series field(folder, "field", ".vtp");
  while (cycle) {
    apply_changes(*cycle, map);
    const std::vector<Eigen::Vector3d> behind = reader.run().travelled;
    std::optional<RecordedCycle> next = reader.next();
    const std::size_t view = cycle->view.view;
    if (cycle->planned || !next) {
      write_occupancy(map, occupancy.at(view));
      write_frontiers(map, frontiers.at(view));
      write_path(behind, cycle->path, path.at(view));
      if (!cycle->field.empty()) {
        write_field(map, cycle->field, field.at(view));
      }
    }
    cycle = std::move(next);
  }
  std::vector<std::filesystem::path> files;
  for (const Series* series : {&occupancy, &frontiers, &path, &field}) {
    series->finish(files);
  }
  return files;
}

}  // namespace vantage
