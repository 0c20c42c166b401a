// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/surface_matching.hpp>
#include <opencv2/surface_matching/ppf_helpers.hpp>
#include <sstream>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vantage/geometry/voxel.hpp>
#include <vantage/vision/registration.hpp>

#include <vantage/settings/impl/option_rule.hpp>

namespace vantage {
namespace {

using detail::require_option;
using Points = std::vector<Eigen::Vector3f>;

constexpr int kNeighbours = 12;            // number of neighbours used to estimate the plane of a point
constexpr std::size_t kFewestPoints = 50;  // fewer points determine neither planes nor a pose

void check(const RegistrationOptions& options, const Pose& guess) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  require_option(positive(options.point_spacing_m), "RegistrationOptions::point_spacing_m", options.point_spacing_m,
                 "> 0");
  require_option(positive(options.gap_m), "RegistrationOptions::gap_m", options.gap_m, "> 0");
  require_option(options.iterations > 0, "RegistrationOptions::iterations", options.iterations, "> 0");
  require_option(options.levels >= 1 && options.levels <= 8, "RegistrationOptions::levels", options.levels,
                 "in [1, 8]");
  require_option(options.least_overlap >= 0.0 && options.least_overlap <= 1.0, "RegistrationOptions::least_overlap",
                 options.least_overlap, "in [0, 1]");
  require_option(positive(options.most_moved_m), "RegistrationOptions::most_moved_m", options.most_moved_m, "> 0");
  require_option(positive(options.most_turned_rad), "RegistrationOptions::most_turned_rad", options.most_turned_rad,
                 "> 0");
  if (!is_rigid(guess)) {
    throw std::invalid_argument("the guess is not a rigid transform");
  }
}

// Transforms points by `pose` and keeps the first one in every cube.
Points thinned(std::span<const Eigen::Vector3f> points, const Pose& pose, double spacing_m) {
  const VoxelFrame cubes{spacing_m};
  std::unordered_set<VoxelIndex> taken;
  Points result;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d world = pose * point.cast<double>();
    if (world.allFinite() && cubes.addressable(world) && taken.insert(cubes.cell_of(world)).second) {
      result.push_back(world.cast<float>());
    }
  }
  return result;
}

// Points with normals in OpenCV's layout: rows of x y z nx ny nz, relative to `middle`.
cv::Mat with_normals(const Points& points, const Eigen::Vector3d& middle) {
  cv::Mat rows(static_cast<int>(points.size()), 3, CV_32F);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].cast<double>() - middle;
    auto* row = rows.ptr<float>(static_cast<int>(i));
    for (int axis = 0; axis < 3; ++axis) {
      row[axis] = static_cast<float>(p[axis]);
    }
  }
  cv::Mat result;
  cv::ppf_match_3d::computeNormalsPC3d(rows, result, kNeighbours, false, cv::Vec3f(0.0F, 0.0F, 0.0F));
  return result;
}

Eigen::Vector3d vector_at(const cv::Mat& rows, std::size_t row, int first) {
  const auto* values = rows.ptr<float>(static_cast<int>(row));
  return {static_cast<double>(values[first]), static_cast<double>(values[first + 1]),
          static_cast<double>(values[first + 2])};
}

// Finds the nearest point within a distance.
class NearestWithin {
 public:
  NearestWithin(const cv::Mat& rows, double gap_m) : rows_(rows), gap_m_(gap_m), cubes_{gap_m} {
    for (int i = 0; i < rows.rows; ++i) {
      in_cube_[cubes_.cell_of(vector_at(rows, static_cast<std::size_t>(i), 0))].push_back(
          static_cast<std::size_t>(i));
    }
  }
  // Index of the nearest row; rows.rows if there is none.
  [[nodiscard]] std::size_t find(const Eigen::Vector3d& point) const {
    auto best = static_cast<std::size_t>(rows_.rows);
    double least = gap_m_ * gap_m_;
    const VoxelIndex centre = cubes_.cell_of(point);
    for (std::int32_t z = -1; z <= 1; ++z) {
      for (std::int32_t y = -1; y <= 1; ++y) {
        for (std::int32_t x = -1; x <= 1; ++x) {
          const auto cube = in_cube_.find(centre + VoxelIndex{x, y, z});
          if (cube == in_cube_.end()) {
            continue;
          }
          for (const std::size_t candidate : cube->second) {
            const double distance = (vector_at(rows_, candidate, 0) - point).squaredNorm();
            if (distance < least) {
              least = distance;
              best = candidate;
            }
          }
        }
      }
    }
    return best;
  }

 private:
  const cv::Mat& rows_;
  double gap_m_;
  VoxelFrame cubes_;
  std::unordered_map<VoxelIndex, std::vector<std::size_t>> in_cube_;
};

// Measures how well transformed points lie on the planes of others: fills overlap, rms and covariance.
void judge(const cv::Mat& scan, const cv::Mat& known, const Pose& pose, double gap_m, Registration& result) {
  const NearestWithin nearest(known, gap_m);
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  double squares = 0.0;
  std::size_t partners = 0;
  for (int i = 0; i < scan.rows; ++i) {
    const Eigen::Vector3d point = pose * vector_at(scan, static_cast<std::size_t>(i), 0);
    const std::size_t partner = nearest.find(point);
    if (partner == static_cast<std::size_t>(known.rows)) {
      continue;
    }
    const Eigen::Vector3d normal = vector_at(known, partner, 3);
    const double off = normal.dot(point - vector_at(known, partner, 0));
    Eigen::Matrix<double, 6, 1> row;
    row << point.cross(normal), normal;
    information += row * row.transpose();
    squares += off * off;
    ++partners;
  }
  result.overlap = static_cast<double>(partners) / std::max(1.0, static_cast<double>(scan.rows));
  result.rms_m = std::sqrt(squares / std::max(1.0, static_cast<double>(partners)));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(information);
  Eigen::Matrix<double, 6, 1> inverse;  // bounded, so that unconstrained directions get a large but finite variance
  for (Eigen::Index i = 0; i < 6; ++i) {
    inverse[i] = 1.0 / std::max(solver.eigenvalues()[i], 1e-9);
  }
  result.covariance =
      result.rms_m * result.rms_m * solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

std::string percent(double share) { return std::to_string(static_cast<int>(std::lround(100.0 * share))) + " %"; }

// Why a result is rejected; empty if it is accepted.
std::string doubt(const Registration& result, const Pose& correction, const Eigen::Vector3d& middle,
                  const RegistrationOptions& options) {
  const double moved_m = (correction * middle - middle).norm();
  const double turned_rad = Eigen::AngleAxisd(correction.linear()).angle();
  if (result.overlap < options.least_overlap) {
    return "only " + percent(result.overlap) + " of the scan lies on what is known, must be " +
           percent(options.least_overlap);
  }
  if (moved_m > options.most_moved_m || turned_rad > options.most_turned_rad) {
    std::ostringstream text;
    text << "the best fit is " << moved_m << " m and " << turned_rad << " rad off the guess, further than believed";
    return text.str();
  }
  return "";
}

// Transforms rows of points and normals.
cv::Mat moved(const cv::Mat& rows, const Pose& pose) {
  cv::Mat result = rows.clone();
  for (int i = 0; i < rows.rows; ++i) {
    const Eigen::Vector3d point = pose * vector_at(rows, static_cast<std::size_t>(i), 0);
    const Eigen::Vector3d normal = pose.linear() * vector_at(rows, static_cast<std::size_t>(i), 3);
    auto* row = result.ptr<float>(i);
    for (int axis = 0; axis < 3; ++axis) {
      row[axis] = static_cast<float>(point[axis]);
      row[3 + axis] = static_cast<float>(normal[axis]);
    }
  }
  return result;
}

// One run of OpenCV's ICP; identity if the result is not rigid.
Pose corrected_by_icp(const cv::Mat& scan, const cv::Mat& known, const RegistrationOptions& options) {
  constexpr float kTolerance = 0.005F;
  constexpr float kRejection = 2.5F;
  cv::ppf_match_3d::ICP icp(options.iterations, kTolerance, kRejection, options.levels);
  double residual = 0.0;
  cv::Matx44d found = cv::Matx44d::eye();
  icp.registerModelToScene(scan, known, residual, found);
  Pose correction = Pose::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      correction.matrix()(row, column) = found(row, column);
    }
  }
  if (!is_rigid(correction, 1e-2)) {
    return Pose::Identity();
  }
  correction.linear() = Eigen::Quaterniond(correction.linear()).normalized().toRotationMatrix();
  return correction;
}

// Repeats ICP from the last result while the overlap increases, because after a poor guess the first run only comes
// close. `result` receives the fit of the best run.
Pose best_correction(const cv::Mat& scan, const cv::Mat& known, const RegistrationOptions& options,
                     Registration& result) {
  constexpr int kMostRounds = 5;
  constexpr double kMore = 1.005;
  Pose best = Pose::Identity();
  judge(scan, known, best, options.gap_m, result);
  for (int round = 0; round < kMostRounds; ++round) {
    const Pose next = corrected_by_icp(moved(scan, best), known, options) * best;
    Registration fit;
    judge(scan, known, next, options.gap_m, fit);
    const bool much_better = fit.overlap > kMore * result.overlap;
    if (round == 0 || fit.overlap >= result.overlap) {
      best = next;
      result.overlap = fit.overlap;
      result.rms_m = fit.rms_m;
      result.covariance = fit.covariance;
    }
    if (!much_better) {
      break;
    }
  }
  return best;
}

}  // namespace

Registration register_points(std::span<const Eigen::Vector3f> sensor_points,
                             std::span<const Eigen::Vector3f> world_points, const Pose& guess,
                             const RegistrationOptions& options) {
  check(options, guess);
  Registration result;
  result.world_from_sensor = guess;
  const Points scan = thinned(sensor_points, guess, options.point_spacing_m);
  const Points known = thinned(world_points, Pose::Identity(), options.point_spacing_m);
  if (scan.size() < kFewestPoints || known.size() < kFewestPoints) {
    result.reason = "there are too few points: " + std::to_string(scan.size()) + " in the scan, " +
                    std::to_string(known.size()) + " known, must be " + std::to_string(kFewestPoints) + " each";
    return result;
  }
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& point : scan) {
    middle += point.cast<double>() / static_cast<double>(scan.size());
  }
  const cv::Mat scan_rows = with_normals(scan, middle);
  const cv::Mat known_rows = with_normals(known, middle);
  const Pose correction = best_correction(scan_rows, known_rows, options, result);
  result.reason = doubt(result, correction, Eigen::Vector3d::Zero(), options);
  result.converged = result.reason.empty();
  if (result.converged) {
    result.world_from_sensor = Eigen::Translation3d(middle) * correction * Eigen::Translation3d(-middle) * guess;
    result.reason = percent(result.overlap) + " of the scan lies on what is known";
  }
  return result;
}

Registration register_scan(const Scan& scan, std::span<const Scan> before, const RegistrationOptions& options) {
  std::vector<Eigen::Vector3f> known;
  for (const Scan& other : before) {
    for (const Eigen::Vector3f& point : other.points) {
      if (point.allFinite() && static_cast<double>(point.norm()) <= other.max_range_m) {
        known.push_back((other.world_from_sensor * point.cast<double>()).cast<float>());
      }
    }
  }
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& point : scan.points) {
    if (point.allFinite() && static_cast<double>(point.norm()) <= scan.max_range_m) {
      points.push_back(point);
    }
  }
  return register_points(points, known, scan.world_from_sensor, options);
}

}  // namespace vantage
