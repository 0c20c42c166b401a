// SPDX-License-Identifier: MIT
#include <vantage/geometry/box.hpp>

#include "geometry/box_distance.hpp"

namespace vantage {

double Box::distance_to(const Eigen::Vector3d& point) const { return detail::distance_between(*this, point); }

}  // namespace vantage
