// SPDX-License-Identifier: GPL-3.0-or-later
#include "tum_list.h"

#include <limits>

#include "orbslam/util/file.h"
#include "orbslam/util/text.h"

namespace orbslam {
namespace {

/// Lines skipped for one reason; reported once, however many they are.
struct Skipped {
  std::string reason;
  int count = 0;
  int first_line = 0;
  std::string first_text = {};

  void Add(const TextLine& line) {
    if (count++ > 0) return;
    constexpr size_t kMaxShown = 60;
    first_line = line.number;
    first_text = line.text.substr(0, kMaxShown);
  }

  std::string Describe(const std::string& path) const {
    return path + ":" + std::to_string(first_line) + ": " + reason + ": '" + first_text + "'; " +
           std::to_string(count) + (count == 1 ? " such line" : " such lines") + " skipped";
  }
};

bool TimesAreNumbers(const std::vector<std::string_view>& fields) {
  for (size_t i = 0; i < fields.size(); i += 2) {
    if (!ParseDouble(fields[i])) return false;
  }
  return true;
}

}  // namespace

Result<TumList> ReadTumList(const std::string& path, const TumListFormat& format) {
  const Result<std::string> content = ReadFile(path);
  if (!content) return content.error();

  Skipped wrong_fields{"expected " + std::to_string(format.num_fields) + " fields (" + format.description +
                       ")"};
  Skipped wrong_time{"the time is not a finite number"};
  Skipped wrong_order{"the time is not after the one before"};
  TumList list;
  double last_s = -std::numeric_limits<double>::infinity();
  for (const TextLine& line : SplitLines(*content)) {
    const std::vector<std::string_view> fields = SplitFields(line.text);
    if (fields.empty() || fields[0].starts_with('#')) continue;
    if (static_cast<int>(fields.size()) != format.num_fields) {
      wrong_fields.Add(line);
    } else if (!TimesAreNumbers(fields)) {
      wrong_time.Add(line);
    } else if (const double time_s = *ParseDouble(fields[0]); time_s <= last_s) {
      wrong_order.Add(line);
    } else {
      last_s = time_s;
      list.rows.push_back({time_s, {fields.begin(), fields.end()}});
    }
  }
  for (const Skipped& skipped : {wrong_fields, wrong_time, wrong_order}) {
    if (skipped.count > 0) list.warnings.push_back(skipped.Describe(path));
  }
  if (!list.rows.empty()) return list;
  return Error{list.warnings.empty() ? path + ": no line with " + format.description + " in it"
                                     : list.warnings.front() + ", none is left"};
}

}  // namespace orbslam
