// SPDX-License-Identifier: MIT
#include "apps/progress_stream.hpp"

#include <unistd.h>

#include <iostream>

namespace vantage::apps {

ProgressStream::ProgressStream(const ExploreRequest& request)
    : stream_(request.quiet         ? silence_
              : request.json == "-" ? std::cerr
                                    : std::cout),
      is_terminal_(isatty(request.json == "-" ? STDERR_FILENO : STDOUT_FILENO) != 0) {}

}  // namespace vantage::apps
