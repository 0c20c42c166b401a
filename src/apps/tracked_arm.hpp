// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::apps {

/// The text of examples/tracked_arm.urdf.
extern const char* const kTrackedArm;

}  // namespace vantage::apps
