// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vantage/robot/free_flyer.hpp>
#include <vantage/view/object_views.hpp>

namespace vantage {
namespace {

// From everywhere on the sphere a ball around the box is in the image and in range, and the body has room.
TEST(FittingRadius, HasTheWholeBoxInViewAndRoomForTheBody) {
  std::mt19937 engine(3);
  const auto draw = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine);
  };
  std::size_t fitted = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d half(draw(0.01, 1.0), draw(0.01, 1.0), draw(0.01, 1.0));
    const Box box{-half, half};
    const RangeSensor sensor =
        RangeSensor::pinhole(64, 48, draw(0.5, 1.5), draw(0.5, 1.5), draw(0.05, 0.5), draw(3.0, 10.0));
    const double body_m = draw(0.0, 0.5);
    const double cell_m = draw(0.005, 0.2);
    const double radius_m = fitting_radius_m(box, sensor, cell_m, body_m);
    EXPECT_GE(radius_m, half.norm() + std::max(body_m, sensor.min_range_m));
    const double angle = 0.5 * std::min(sensor.horizontal_angle_rad(), sensor.vertical_angle_rad());
    const double resolved_m = sensor.resolving_range_m(cell_m);
    if (half.norm() / std::sin(angle) < std::min(sensor.max_range_m - half.norm(), resolved_m)) {
      EXPECT_GE(radius_m * std::sin(angle), half.norm() - 1e-9);
      ++fitted;
    }
    const FreeFlyer flyer({.radius_m = body_m});
    const ObjectViewOptions options = with_radii({.object = box}, sensor, flyer, cell_m);
    EXPECT_EQ(options.radii_m,
              std::vector{fitting_radius_m(box, sensor, cell_m, std::max(body_m, cell_m) + 2.0 * cell_m)});
    EXPECT_EQ(options.aimed().max_distance_m, options.radii_m.front());
    EXPECT_EQ(with_radii({.object = box, .radii_m = {2.0, 3.0}}, sensor, flyer, cell_m).radii_m,
              (std::vector{2.0, 3.0}));
  }
  EXPECT_GT(fitted, 200U);
  EXPECT_THROW((void)ObjectViewOptions{}.aimed(), std::invalid_argument);
  EXPECT_THROW((void)views_of_object({.object = {{0, 0, 0}, {1, 1, 1}}}, OccupancyMap({.resolution_m = 0.1}),
                                     FreeFlyer(), {}, 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace vantage
