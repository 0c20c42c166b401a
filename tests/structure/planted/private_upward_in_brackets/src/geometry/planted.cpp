// SPDX-License-Identifier: MIT
#include <map/planted.hpp>
