// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vantage/picture/picture.hpp>

namespace vantage::detail {

struct Colour {
  std::uint8_t red, green, blue;
};

inline constexpr Colour kPaper{255, 255, 255};
inline constexpr Colour kInk{38, 42, 51};
inline constexpr Colour kSoftInk{104, 110, 122};
inline constexpr Colour kGridLine{228, 231, 236};
inline constexpr Colour kFreeSpace{252, 252, 250};
inline constexpr Colour kUnknownSpace{183, 189, 199};
inline constexpr Colour kOccupiedSpace{29, 32, 40};
inline constexpr Colour kPartlyOccupiedSpace{128, 130, 134};  // the average of free and occupied
inline constexpr Colour kStart{22, 145, 84};
inline constexpr Colour kEnd{206, 43, 55};

/// Interpolates between two colours: 0 is `a`, 1 is `b`.
[[nodiscard]] Colour mix(Colour a, Colour b, double share_of_b);
/// Colour scale for a sequence, from the first (0) to the last (1): blue, magenta, orange.
[[nodiscard]] Colour journey_colour(double share);
/// Colour scale from low (0) to high (1): viridis.
[[nodiscard]] Colour level_colour(double share);

enum class Align : std::uint8_t { Left, Centre, Right };

/// A drawing sheet with threefold supersampling for smooth edges. Coordinates are pixels of the finished picture,
/// with fractions; y points down.
class Canvas {
 public:
  Canvas(double width, double height);

  [[nodiscard]] double width() const;
  [[nodiscard]] double height() const;

  void rectangle(const cv::Rect2d& area, Colour fill);
  void frame(const cv::Rect2d& area, Colour colour, double thickness = 1.0);
  void line(cv::Point2d from, cv::Point2d to, Colour colour, double thickness = 1.0);
  void disc(cv::Point2d centre, double radius, Colour fill);
  /// Draws an arrow of the given length, centred on `middle`, along `direction` (picture axes, any length).
  void arrow(cv::Point2d middle, cv::Point2d direction, double length, Colour colour, double thickness);
  /// Draws `image` (RGB) into `area`. Enlarged pixels stay sharp squares.
  void image(const cv::Mat& image, const cv::Rect2d& area);
  /// Draws text with capitals of height `size`. `at` is on the baseline. Non-ASCII characters are shown as '?'.
  void text(cv::Point2d at, const std::string& words, double size, Colour colour, Align align = Align::Left,
            bool bold = false);
  [[nodiscard]] static double text_width(const std::string& words, double size, bool bold = false);

  [[nodiscard]] Picture finish() const;

 private:
  cv::Mat sheet_;
};

}  // namespace vantage::detail
