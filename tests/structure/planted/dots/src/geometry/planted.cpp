// SPDX-License-Identifier: MIT
#include <geometry/../map/planted.hpp>
