// SPDX-License-Identifier: MIT
#pragma once

namespace vantage {

struct Planted {};

}  // namespace vantage
