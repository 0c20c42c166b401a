// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/planner/impl/frontier_survey_settings.hpp>

namespace vantage::detail {

VANTAGE_INLINE const SettingTable<FrontierSurveyOptions>& frontier_survey_settings() {
  static const auto table = with_survey<FrontierSurveyOptions>("FrontierSurveyOptions");
  return table;
}

}  // namespace vantage::detail
