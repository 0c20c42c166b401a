// SPDX-License-Identifier: MIT
#include <vantage/vantage.hpp>
