// SPDX-License-Identifier: MIT
#pragma once

#include <vantage/map/impl/octomap_file.hpp>

#include <cmath>
#include <cstring>
#include <fstream>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace vantage::detail {

inline constexpr const char* kStatesLine = "# Octomap OcTree binary file";
inline constexpr const char* kLogOddsLine = "# Octomap OcTree file";

// Number of bytes between the log-odds and the children of a node, by type of tree; nullopt for an unknown type.
inline std::optional<std::size_t> payload_of(const std::string& type) {
  if (type == "OcTree" || type == "OcTreeStamped") {  // OctoMap does not write the time stamps
    return 0;
  }
  if (type == "ColorOcTree") {
    return 3;
  }
  return std::nullopt;
}

template <class Value>
bool parse(const std::string& text, Value& value) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  return static_cast<bool>(stream >> value) && (stream >> std::ws).eof();
}

inline VoxelIndex child_of(const VoxelIndex& first, int child_level, unsigned child) {
  const std::int32_t edge = std::int32_t{1} << child_level;
  return first + VoxelIndex{(child & 1U) != 0 ? edge : 0, (child & 2U) != 0 ? edge : 0, (child & 4U) != 0 ? edge : 0};
}

// Reads all nodes depth first, in the order of the file.
class OctomapFile::Reader {
 public:
  Reader(const OctomapFile& file, const std::function<void(const OctomapLeaf&)>& visit)
      : file_(file), visit_(visit), at_(file.data_) {}

  void read_all() {
    if (file_.nodes_ > 0) {
      count_node();
      const VoxelIndex first{-kOctomapReach, -kOctomapReach, -kOctomapReach};
      file_.states_only_ ? read_states(first, kOctomapDepth) : read_log_odds(first, kOctomapDepth);
    }
    if (nodes_ != file_.nodes_) {
      file_.fail("holds " + std::to_string(nodes_) + " nodes, its header says " + std::to_string(file_.nodes_));
    }
    if (at_ != file_.bytes_.size()) {
      file_.fail(std::to_string(file_.bytes_.size() - at_) + " bytes follow the last node");
    }
  }

 private:
  // Two bits per child: 0 unknown, 1 free, 2 occupied, 3 has children.
  void read_states(const VoxelIndex& first, int level) {
    const char* bytes = take(2);
    const unsigned children = static_cast<unsigned char>(bytes[0]) | unsigned{static_cast<unsigned char>(bytes[1])}
                                                                         << 8U;
    if (children == 0) {
      file_.fail("inner node " + std::to_string(nodes_) + " has no children");
    }
    if (level == 0) {
      fail_depth();
    }
    for (unsigned child = 0; child < 8; ++child) {
      const unsigned state = children >> (2 * child) & 3U;
      if (state == 0) {
        continue;
      }
      count_node();
      const VoxelIndex corner = child_of(first, level - 1, child);
      if (state == 3) {
        read_states(corner, level - 1);
      } else {
        visit_({corner, level - 1, state == 2 ? HUGE_VAL : -HUGE_VAL, state == 2});
      }
    }
  }

  void read_log_odds(const VoxelIndex& first, int level) {
    float log_odds = 0.0F;
    std::memcpy(&log_odds, take(sizeof log_odds), sizeof log_odds);
    take(file_.payload_bytes_);
    const unsigned children = static_cast<unsigned char>(*take(1));
    if (children == 0) {
      if (!std::isfinite(log_odds)) {
        file_.fail("node " + std::to_string(nodes_) + " has log-odds that are not finite");
      }
      visit_({first, level, log_odds, log_odds >= 0.0F});
      return;
    }
    if (level == 0) {
      fail_depth();
    }
    for (unsigned child = 0; child < 8; ++child) {
      if ((children >> child & 1U) != 0) {
        count_node();
        read_log_odds(child_of(first, level - 1, child), level - 1);
      }
    }
  }

  const char* take(std::size_t count) {
    if (file_.bytes_.size() - at_ < count) {
      file_.fail("ends within node " + std::to_string(nodes_) + " of " + std::to_string(file_.nodes_) +
                 "; it is cut short or damaged");
    }
    at_ += count;
    return file_.bytes_.data() + (at_ - count);
  }
  void count_node() {
    if (++nodes_ > file_.nodes_) {
      file_.fail("holds more nodes than the " + std::to_string(file_.nodes_) + " that its header says");
    }
  }
  [[noreturn]] void fail_depth() const {
    file_.fail("node " + std::to_string(nodes_) + " lies more than " + std::to_string(kOctomapDepth) +
               " levels below the root");
  }

  const OctomapFile& file_;
  const std::function<void(const OctomapLeaf&)>& visit_;
  std::size_t at_;
  std::uint64_t nodes_ = 0;
};

VANTAGE_INLINE OctomapFile::OctomapFile(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (!is_file || !stream) {
    fail(std::filesystem::exists(path, error) ? "cannot be read" : "no such file");
  }
  std::ostringstream content;
  content << stream.rdbuf();
  if (stream.bad()) {
    fail("cannot be read");
  }
  bytes_ = std::move(content).str();
  read_header();
}

VANTAGE_INLINE void OctomapFile::for_each_leaf(const std::function<void(const OctomapLeaf&)>& visit) const {
  Reader(*this, visit).read_all();
}

VANTAGE_INLINE void OctomapFile::fail(const std::string& what) const {
  throw std::runtime_error(path_.string() + ": " + what);
}

VANTAGE_INLINE void OctomapFile::read_header() {
  std::string type;
  std::string nodes;
  std::string resolution;
  for (bool first = true;; first = false) {
    const std::size_t end = bytes_.find('\n', data_);
    std::string line = bytes_.substr(data_, end == std::string::npos ? end : end - data_);
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    if (first) {
      states_only_ = line.rfind(kStatesLine, 0) == 0;
      if (!states_only_ && line.rfind(kLogOddsLine, 0) != 0) {
        fail("is not an OctoMap file: its first line is neither \"" + std::string(kStatesLine) + "\" nor \"" +
             kLogOddsLine + "\"");
      }
    }
    if (end == std::string::npos) {
      fail("ends within its header");
    }
    data_ = end + 1;
    const std::string keyword = line.substr(0, line.find(' '));
    if (keyword == "data") {
      break;
    }
    if (keyword == "id" || keyword == "size" || keyword == "res") {
      std::string& value = keyword == "id" ? type : keyword == "size" ? nodes : resolution;
      value = line.size() > keyword.size() ? line.substr(keyword.size() + 1) : "";
    }
  }
  const std::optional<std::size_t> payload = payload_of(type);
  if (!payload) {
    fail("holds a tree of type \"" + type + "\", must be OcTree, ColorOcTree or OcTreeStamped");
  }
  payload_bytes_ = *payload;
  // A stream would read "-1" as a huge unsigned number.
  if (nodes.find('-') != std::string::npos || !parse(nodes, nodes_)) {
    fail("has the node count \"" + nodes + "\" in its header, must be a whole number");
  }
  if (!parse(resolution, resolution_m_) || !std::isfinite(resolution_m_) || resolution_m_ <= 0.0) {
    fail("has the resolution \"" + resolution + "\" in its header, must be a number > 0");
  }
}

}  // namespace vantage::detail
