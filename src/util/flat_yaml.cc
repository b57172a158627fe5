// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_yaml.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

#include "orbslam/util/text.h"

namespace orbslam {
namespace {

using Entries = std::map<std::string, ConfigEntry>;

Error LineError(const std::string& name, int line, const std::string& what) {
  return {name + ":" + std::to_string(line) + ": " + what};
}

/// Position of the first tab that YAML would take for content or indentation; one before a comment or at the
/// end of the line does no harm.
size_t FindHarmfulTab(std::string_view line) {
  char quote = 0;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      break;
    } else if (c == '\t') {
      const size_t next = line.find_first_not_of(" \t", i);
      return next == std::string_view::npos || line[next] == '#' ? std::string_view::npos : i;
    }
  }
  return std::string_view::npos;
}

/// True for "Camera.fx:517", which YAML does not take for a key and a value.
bool LacksBlankAfterColon(std::string_view line) {
  const auto is_key_letter = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '_'; };
  line = Trim(line);
  const size_t colon = line.find(':');
  return colon != std::string_view::npos && colon > 0 && colon + 1 < line.size() && line[colon + 1] != ' ' &&
         std::all_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(colon), is_key_letter);
}

/// Turns the dialects that users have into what yaml-cpp reads, line by line so that its line numbers hold.
Result<std::string> Normalize(std::string_view content, const std::string& name) {
  std::string yaml;
  for (const TextLine& line : SplitLines(content)) {
    if (line.text.find('\0') != std::string_view::npos) return Error{name + ": not a text file"};
    if (line.number == 1 && line.text.starts_with("%YAML")) {
      yaml += '\n';  // OpenCV's "%YAML:1.0" is no YAML directive
      continue;
    }
    if (FindHarmfulTab(line.text) != std::string_view::npos) {
      return LineError(name, line.number,
                       "a tab; YAML allows only blanks between and before keys and values");
    }
    if (LacksBlankAfterColon(line.text)) {
      const std::string key(Trim(line.text.substr(0, line.text.find(':'))));
      return LineError(name, line.number, "a blank is missing after the colon of '" + key + "'");
    }
    yaml += std::string(line.text) + '\n';
  }
  return yaml;
}

/// Remembers where the last document began, and where something is referred to.
class Outline : public YAML::EventHandler {
 public:
  int document_line() const { return document_line_; }
  int alias_line() const { return alias_line_; }

  void OnDocumentStart(const YAML::Mark& mark) override { document_line_ = mark.line + 1; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { alias_line_ = mark.line + 1; }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
  }
  void OnMapEnd() override {}

 private:
  int document_line_ = 0, alias_line_ = 0;
};

/// YAML::Load() would silently drop all that follows the first document, and a stray bracket or comma ends
/// one; YAML::LoadAll() never ends on some of these. References are refused: with a few, a map can contain
/// itself.
Status CheckOutline(const std::string& yaml, const std::string& name) {
  std::istringstream stream(yaml);
  YAML::Parser parser(stream);
  Outline outline;
  if (!parser.HandleNextDocument(outline)) return Error{name + ": no settings in it"};
  if (outline.alias_line() > 0)
    return LineError(name, outline.alias_line(), "references (*name) are not allowed");
  if (!parser.HandleNextDocument(outline)) return OkStatus();
  return LineError(name, outline.document_line(),
                   "does not belong to the settings before it; one YAML document is expected");
}

ConfigEntry MakeEntry(const YAML::Node& value, int line) {
  ConfigEntry entry;
  entry.line = line;
  if (value.Tag().find("opencv-matrix") != std::string::npos) {
    entry.kind = ConfigEntry::Kind::kMatrix;
  } else if (value.IsSequence()) {
    entry.kind = ConfigEntry::Kind::kList;
  } else if (!value.IsScalar()) {
    entry.kind = ConfigEntry::Kind::kEmpty;
  } else {
    entry.kind = value.Tag() == "!" ? ConfigEntry::Kind::kQuoted : ConfigEntry::Kind::kPlain;
    entry.text = value.Scalar();
  }
  return entry;
}

class Flattener {
 public:
  explicit Flattener(const std::string& name) : name_(name) {}

  Status Add(const std::string& prefix, const YAML::Node& map) {
    for (const auto& item : map) {
      const YAML::Node& key = item.first;
      const YAML::Node& value = item.second;
      const int key_line = key.Mark().line + 1;
      if (!key.IsScalar()) return LineError(name_, key_line, "a key must be a word");
      const std::string full_key = prefix + key.Scalar();
      const bool is_section = value.IsMap() && value.Tag().find("opencv-matrix") == std::string::npos;
      Status status = is_section ? Add(full_key + ".", value) : AddEntry(full_key, key_line, value);
      if (!status) return status;
    }
    return OkStatus();
  }

  Entries Take() { return std::move(entries_); }

 private:
  Status AddEntry(const std::string& key, int line, const YAML::Node& value) {
    const ConfigEntry entry = MakeEntry(value, line);
    const auto [existing, is_new] = entries_.emplace(key, entry);
    if (is_new) return OkStatus();
    return LineError(name_, line, key + ": given before, in line " + std::to_string(existing->second.line));
  }

  std::string name_;
  Entries entries_;
};

}  // namespace

Result<Entries> ParseFlatYaml(std::string_view content, const std::string& name) {
  const Result<std::string> yaml = Normalize(content, name);
  if (!yaml) return yaml.error();
  try {
    Status status = CheckOutline(*yaml, name);
    if (!status) return status.error();
    const YAML::Node root = YAML::Load(*yaml);
    if (root.IsNull()) return Error{name + ": no settings in it"};
    if (!root.IsMap()) return Error{name + ": no settings file; expected lines like 'Camera.fx: 517.3'"};
    Flattener flattener(name);
    status = flattener.Add("", root);
    if (!status) return status.error();
    return flattener.Take();
  } catch (const YAML::Exception& exception) {
    return LineError(name, exception.mark.line + 1, "not valid YAML (" + exception.msg + ")");
  }
}

}  // namespace orbslam
