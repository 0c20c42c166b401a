// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/geometry/box.hpp>
