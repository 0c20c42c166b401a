// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vantage/view/object_views.hpp>
#include <vector>

#include <vantage/settings/impl/number_list.hpp>
#include <vantage/settings/impl/setting_table.hpp>

namespace vantage::detail {

/// The settings of where to look at an object from, in `member`.
template <class Options>
SettingTable<Options> with_object_views(std::string_view owner, ObjectViewOptions Options::*member) {
  using V = ObjectViewOptions;
  return SettingTable<Options>(owner)
      .text("object", "m", "the box of the object, x0,y0,z0,x1,y1,z1; none: the whole map", "six numbers",
            [member](Options& options, const std::string& text) {
              const std::vector<double> c = number_list(text);
              if (c.size() == 6) {
                (options.*member).object = Box{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
              }
              return c.size() == 6;
            })
      .text("radii_m", "m",
            "distances of the candidates from the middle of the object; none: the whole box is in view",
            "numbers > 0, with commas between them",
            [member](Options& options, const std::string& text) {
              std::vector<double>& radii_m = (options.*member).radii_m;
              radii_m = number_list(text);
              return !radii_m.empty() && *std::min_element(radii_m.begin(), radii_m.end()) > 0.0;
            })
      .number("subdivisions", "", "candidates of a shell: 20 * 4^this; -1: none", within(-1, 6), member,
              &V::subdivisions)
      .number("random_candidates", "views", "additional candidates drawn anywhere", within(0, 1e6), member,
              &V::random_candidates)
      .number("aimed_candidates", "views",
              "additional candidates aimed at what is not seen, from up to the largest radius", within(0, 1e6),
              member, &V::aimed_candidates)
      .check([member](const Options& options) {
        const ObjectViewOptions& views = options.*member;
        if (views.object.empty() || !views.object.min.allFinite() || !views.object.max.allFinite()) {
          throw std::invalid_argument("ObjectViewOptions::object must have min < max on every axis and be finite");
        }
        for (const double radius_m : views.radii_m) {
          require_option(std::isfinite(radius_m) && radius_m > 0.0, "ObjectViewOptions::radii_m", radius_m, "> 0");
        }
      });
}

}  // namespace vantage::detail
