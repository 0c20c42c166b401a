// SPDX-License-Identifier: MIT
#include "sim/flat_yaml.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace vantage::detail {
namespace {

constexpr const char* kBlank = " \t\r";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// A # starts a comment if it is outside quotes and at the start of the line or after a blank.
std::string without_comment(const std::string& line) {
  char quote = '\0';
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != '\0') {
      quote = line[i] == quote ? '\0' : quote;
    } else if (line[i] == '\'' || line[i] == '"') {
      quote = line[i];
    } else if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
      return line.substr(0, i);
    }
  }
  return line;
}

class FlatYamlReader {
 public:
  explicit FlatYamlReader(const std::filesystem::path& path) : path_(path) {}

  FlatYaml read() {
    constexpr std::uintmax_t kMostBytes = 1 << 20;
    std::error_code error;
    if (!std::filesystem::is_regular_file(path_, error)) {
      throw std::runtime_error(path_.string() + ": there is no such file");
    }
    if (std::filesystem::file_size(path_, error) > kMostBytes) {
      throw std::runtime_error(path_.string() + ": is larger than 1 MiB, which no map's YAML file is");
    }
    std::ifstream in(path_);
    for (std::string line; std::getline(in, line);) {
      if (++line_ == 1 && line.starts_with("\xEF\xBB\xBF")) {
        line.erase(0, 3);  // the mark that some editors put before UTF-8
      }
      take(without_comment(line));
    }
    if (in.bad() || line_ == 0) {
      throw std::runtime_error(path_.string() + ": cannot be read, or is empty");
    }
    if (flow_) {
      refuse("a list has no ]");
    }
    return values_;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(path_.string() + ": line " + std::to_string(line_) + ": " + what);
  }

  void take(const std::string& line) {
    const std::string text = trimmed(line);
    if (text.empty() || text == "---" || text == "..." || text.starts_with('%')) {
      return;
    }
    if (flow_) {
      take_flow(text);
    } else if (text == "-" || text.starts_with("- ")) {
      if (key_.empty()) {
        refuse("there is no key that '" + text + "' belongs to");
      }
      values_[key_].push_back(scalar(text.substr(1)));
    } else {
      take_key(line, text);
    }
  }

  void take_key(const std::string& line, const std::string& text) {
    const std::size_t colon = text.find(':');
    if (line.front() == ' ' || line.front() == '\t' || colon == std::string::npos ||
        (colon + 1 < text.size() && text[colon + 1] != ' ' && text[colon + 1] != '\t')) {
      refuse("'" + text + "' is not 'key: value'");
    }
    key_ = scalar(text.substr(0, colon));
    if (values_.contains(key_)) {
      refuse("'" + key_ + "' stands there twice");
    }
    values_[key_] = {};
    const std::string value = trimmed(text.substr(colon + 1));
    if (value.starts_with('[')) {
      flow_ = true;
      take_flow(value.substr(1));
    } else if (!value.empty()) {
      values_[key_] = {scalar(value)};
      key_.clear();
    }
  }

  // Takes a part of a list in brackets, which may span several lines.
  void take_flow(const std::string& text) {
    const std::size_t end = text.find(']');
    if (end != std::string::npos && !trimmed(text.substr(end + 1)).empty()) {
      refuse("there is more after ]");
    }
    const std::string words = text.substr(0, end);
    for (std::size_t at = 0; at < words.size();) {
      const std::size_t comma = std::min(words.find(',', at), words.size());
      if (const std::string word = scalar(words.substr(at, comma - at)); !word.empty()) {
        values_[key_].push_back(word);
      }
      at = comma + 1;
    }
    if (end != std::string::npos) {
      flow_ = false;
      key_.clear();
    }
  }

  std::string scalar(const std::string& text) const {
    std::string word = trimmed(text);
    if (word.empty() || (word.front() != '\'' && word.front() != '"')) {
      if (!word.empty() && std::string("{}[]&*!|>").find(word.front()) != std::string::npos) {
        refuse("'" + word + "' is more than a word or a number");
      }
      return word;
    }
    if (word.size() < 2 || word.back() != word.front() || word.find(word.front(), 1) != word.size() - 1 ||
        (word.front() == '"' && word.find('\\') != std::string::npos)) {
      refuse(word + " is not a simple quoted text");
    }
    return word.substr(1, word.size() - 2);
  }

  std::filesystem::path path_;
  FlatYaml values_;
  std::string key_;  // the key whose list may follow
  bool flow_ = false;
  std::size_t line_ = 0;
};

}  // namespace

FlatYaml read_flat_yaml(const std::filesystem::path& path) { return FlatYamlReader(path).read(); }

}  // namespace vantage::detail
