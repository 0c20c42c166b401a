// SPDX-License-Identifier: MIT
#pragma once

#include <raytrace/planted.hpp>
