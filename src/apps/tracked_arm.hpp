// SPDX-License-Identifier: MIT
#pragma once

namespace vantage::apps {

/// examples/tracked_arm.urdf, as text.
extern const char* const kTrackedArm;

}  // namespace vantage::apps
