// SPDX-License-Identifier: MIT
// The format: Turk, "The PLY Polygon File Format", 1994.
#include "sim/ply_check.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace vantage::detail {
namespace {

enum class PlyFormat : std::uint8_t { Ascii, LittleEndian, BigEndian };

struct PlyType {
  std::string_view name;
  std::size_t bytes;
  bool is_signed;
  bool is_real;
};

constexpr std::array<PlyType, 16> kPlyTypes{{{"char", 1, true, false},
                                             {"int8", 1, true, false},
                                             {"uchar", 1, false, false},
                                             {"uint8", 1, false, false},
                                             {"short", 2, true, false},
                                             {"int16", 2, true, false},
                                             {"ushort", 2, false, false},
                                             {"uint16", 2, false, false},
                                             {"int", 4, true, false},
                                             {"int32", 4, true, false},
                                             {"uint", 4, false, false},
                                             {"uint32", 4, false, false},
                                             {"float", 4, true, true},
                                             {"float32", 4, true, true},
                                             {"double", 8, true, true},
                                             {"float64", 8, true, true}}};

struct PlyProperty {
  std::string_view name;
  const PlyType* type;
  const PlyType* length_type;  // of a list; null for a scalar
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::uint64_t vertices = 0;
  std::size_t end = 0;  // first byte of the body
};

[[noreturn]] void refuse_ply(const std::string& what) { throw std::runtime_error("is a damaged PLY file: " + what); }

std::string quoted(std::string_view text) {
  constexpr std::size_t kShown = 40;
  std::string shown(text.substr(0, kShown));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c > 0x7E; }, '?');
  return "'" + shown + (text.size() > kShown ? "...'" : "'");
}

// Takes the next line, without its end, off `text`. Throws if there is none.
std::string_view take_line(std::string_view& text, const char* what) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos && text.find_first_not_of(" \t\r") == std::string_view::npos) {
    refuse_ply(std::string("it ends before ") + what);
  }
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (!line.empty() && line.back() == '\r') {
    line.remove_suffix(1);
  }
  return line;
}

// Takes the next word off `line`; empty at its end.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

const PlyType& type_of(std::string_view name) {
  const auto* found =
      std::find_if(kPlyTypes.begin(), kPlyTypes.end(), [&](const PlyType& type) { return type.name == name; });
  if (found == kPlyTypes.end()) {
    refuse_ply("its header names a type " + quoted(name));
  }
  return *found;
}

PlyFormat format_of(std::string_view words) {
  const std::string_view name = take_word(words);
  if (take_word(words) != "1.0") {
    refuse_ply("its format is not of version 1.0");
  }
  if (name == "ascii") {
    return PlyFormat::Ascii;
  }
  if (name != "binary_little_endian" && name != "binary_big_endian") {
    refuse_ply("there is no format " + quoted(name));
  }
  return name == "binary_little_endian" ? PlyFormat::LittleEndian : PlyFormat::BigEndian;
}

PlyElement element_of(std::string_view words) {
  const std::string_view name = take_word(words);
  const std::string_view digits = take_word(words);
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (name.empty() || digits.empty() || error != std::errc{} || end != digits.data() + digits.size() ||
      !take_word(words).empty()) {
    refuse_ply("the count of its element " + quoted(name) + " is " + quoted(digits));
  }
  return {name, count, {}};
}

PlyProperty property_of(std::string_view words) {
  PlyProperty property{};
  std::string_view word = take_word(words);
  if (word == "list") {
    property.length_type = &type_of(take_word(words));
    if (property.length_type->is_real) {
      refuse_ply("the length of a list is no whole number");
    }
    word = take_word(words);
  }
  property.type = &type_of(word);
  property.name = take_word(words);
  if (property.name.empty() || !take_word(words).empty()) {
    refuse_ply("its header has a property without a name, or with two");
  }
  return property;
}

// Checks that there is exactly one vertex element and that it has three coordinates.
void check_vertices(PlyHeader& header) {
  const auto is_vertex = [](const PlyElement& element) { return element.name == "vertex"; };
  const auto found = std::find_if(header.elements.begin(), header.elements.end(), is_vertex);
  if (found == header.elements.end() ||
      std::count_if(header.elements.begin(), header.elements.end(), is_vertex) > 1) {
    refuse_ply("its header must name one element 'vertex'");
  }
  for (const char* axis : {"x", "y", "z"}) {
    const auto holds = std::count_if(found->properties.begin(), found->properties.end(), [&](const PlyProperty& p) {
      return p.name == axis && p.length_type == nullptr;
    });
    if (holds != 1) {
      refuse_ply(std::string("its vertices have no property '") + axis + "', or two");
    }
  }
  header.vertices = found->count;
}

PlyHeader header_of(std::string_view bytes) {
  PlyHeader header;
  std::string_view rest = bytes;
  if (take_line(rest, "its header does") != "ply") {
    refuse_ply("its first line is not 'ply'");
  }
  bool has_format = false;
  for (;;) {
    std::string_view line = take_line(rest, "its header does");
    const std::string_view kind = take_word(line);
    if (kind == "end_header") {
      break;
    }
    if (kind == "format" && !has_format) {
      header.format = format_of(line);
      has_format = true;
    } else if (kind == "element") {
      header.elements.push_back(element_of(line));
    } else if (kind == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(property_of(line));
    } else if (kind != "comment" && kind != "obj_info") {
      refuse_ply("its header has a line that begins with " + quoted(kind));
    }
  }
  if (!has_format) {
    refuse_ply("its header names no format");
  }
  check_vertices(header);
  header.end = bytes.size() - rest.size();
  return header;
}

bool holds_corners(const PlyElement& element, const PlyProperty& property) {
  return property.length_type != nullptr && (element.name == "face" || element.name == "tristrips") &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

// Reads an ascii body: one line per element.
class PlyWords {
 public:
  explicit PlyWords(std::string_view body) : body_(body) {}

  void begin() { line_ = take_line(body_, "its elements do"); }
  void end() {
    if (!take_word(line_).empty()) {
      refuse_ply("a line holds more than one element");
    }
  }
  std::int64_t whole(const PlyType& /*type*/) {
    const std::string_view word = take();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) {
      refuse_ply(quoted(word) + " is not a whole number");
    }
    return value;
  }
  void pass(const PlyType& /*type*/) {
    std::string_view word = take();
    word.remove_prefix(word.front() == '+' ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::invalid_argument || end != word.data() + word.size()) {
      refuse_ply(quoted(word) + " is not a number");
    }
  }
  /// A word takes at least two bytes with the blank after it; the last one has none.
  [[nodiscard]] bool may_hold(std::uint64_t values, std::uint64_t /*bytes*/) const {
    return values <= (body_.size() + line_.size() + 1) / 2;
  }
  [[nodiscard]] bool spent() const { return body_.find_first_not_of(" \t\r\n") == std::string_view::npos; }

 private:
  std::string_view take() {
    const std::string_view word = take_word(line_);
    if (word.empty()) {
      refuse_ply("a line ends before its element does");
    }
    return word;
  }

  std::string_view body_;
  std::string_view line_;
};

class PlyBytes {
 public:
  PlyBytes(std::string_view body, bool big_endian) : body_(body), big_endian_(big_endian) {}

  void begin() {}
  void end() {}
  std::int64_t whole(const PlyType& type) {
    const std::string_view part = take(type.bytes);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      value = value << 8U | static_cast<std::uint8_t>(part[big_endian_ ? i : part.size() - 1 - i]);
    }
    const unsigned unused = 64U - 8U * static_cast<unsigned>(type.bytes);
    return type.is_signed ? static_cast<std::int64_t>(value << unused) >> unused : static_cast<std::int64_t>(value);
  }
  void pass(const PlyType& type) { (void)take(type.bytes); }
  [[nodiscard]] bool may_hold(std::uint64_t /*values*/, std::uint64_t bytes) const { return bytes <= body_.size(); }
  // Some writers end the file with line breaks.
  [[nodiscard]] bool spent() const { return body_.find_first_not_of("\r\n") == std::string_view::npos; }

 private:
  std::string_view take(std::size_t size) {
    if (size > body_.size()) {
      refuse_ply("it ends before its elements do");
    }
    const std::string_view part = body_.substr(0, size);
    body_.remove_prefix(size);
    return part;
  }

  std::string_view body_;
  bool big_endian_;
};

template <class Body>
void check_list(Body& body, const PlyHeader& header, const PlyElement& element, const PlyProperty& list) {
  const std::int64_t length = body.whole(*list.length_type);
  const auto values = static_cast<std::uint64_t>(length);
  if (length < 0 || !body.may_hold(values, values * list.type->bytes)) {
    refuse_ply("a list of " + std::to_string(length) + " values is longer than the file");
  }
  const bool corners = holds_corners(element, list);
  if (corners && list.type->is_real) {
    refuse_ply("the corners of its faces are no whole numbers");
  }
  for (std::int64_t i = 0; i < length; ++i) {
    if (!corners) {
      body.pass(*list.type);
      continue;
    }
    const std::int64_t index = body.whole(*list.type);
    const bool ends_strip = index == -1 && element.name == "tristrips";
    if (!ends_strip && (index < 0 || static_cast<std::uint64_t>(index) >= header.vertices)) {
      refuse_ply("a face has a corner at vertex " + std::to_string(index) + " of " + std::to_string(header.vertices));
    }
  }
}

template <class Body>
void check_element(Body& body, const PlyHeader& header, const PlyElement& element) {
  std::uint64_t bytes = 0;  // of one element whose lists are empty
  for (const PlyProperty& property : element.properties) {
    bytes += (property.length_type != nullptr ? property.length_type : property.type)->bytes;
  }
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;  // so that nothing below overflows
  if (element.count > 0 && (element.properties.empty() || element.count > kMost / bytes ||
                            !body.may_hold(element.count * element.properties.size(), element.count * bytes))) {
    refuse_ply("its header names " + std::to_string(element.count) + " of the element " + quoted(element.name) +
               ", more than the file holds");
  }
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin();
    for (const PlyProperty& property : element.properties) {
      if (property.length_type != nullptr) {
        check_list(body, header, element, property);
      } else {
        body.pass(*property.type);
      }
    }
    body.end();
  }
}

template <class Body>
void check_body(Body body, const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    check_element(body, header, element);
  }
  if (!body.spent()) {
    refuse_ply("it holds more than its header names");
  }
}

}  // namespace

bool begins_as_ply(std::string_view bytes) {
  constexpr std::string_view kStart = "ply";
  return bytes.size() >= kStart.size() && std::equal(kStart.begin(), kStart.end(), bytes.begin(), [](char a, char b) {
           return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
         });
}

void check_ply(std::string_view bytes) {
  const PlyHeader header = header_of(bytes);
  const std::string_view body = bytes.substr(header.end);
  if (header.format == PlyFormat::Ascii) {
    check_body(PlyWords(body), header);
  } else {
    check_body(PlyBytes(body, header.format == PlyFormat::BigEndian), header);
  }
}

}  // namespace vantage::detail
