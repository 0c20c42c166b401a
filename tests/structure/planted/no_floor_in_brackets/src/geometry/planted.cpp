// SPDX-License-Identifier: MIT
#include <util/help.hpp>
