// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/exploration_planner.hpp>
