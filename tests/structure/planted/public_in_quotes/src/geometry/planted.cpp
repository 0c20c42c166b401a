// SPDX-License-Identifier: MIT
#include "vantage/map/planted.hpp"
