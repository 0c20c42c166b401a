// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/robot/platform.hpp>
