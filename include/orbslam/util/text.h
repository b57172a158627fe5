// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orbslam {

/// A line of a text without its line end; numbers start at 1. Refers to the text it was cut from.
struct TextLine {
  int number = 0;
  std::string_view text;
};

/// Lines of a text; a leading UTF-8 byte order mark and the carriage returns of CRLF are dropped.
std::vector<TextLine> SplitLines(std::string_view text);

/// Pieces of a line between any number of separators.
std::vector<std::string_view> SplitFields(std::string_view line, std::string_view separators = " \t,");

/// Without blanks and tabs at both ends.
std::string_view Trim(std::string_view text);

/// The whole text as a finite number, in any locale; nothing if it is anything else, such as "1.5 m" or
/// "nan".
std::optional<double> ParseDouble(std::string_view text);
std::optional<int> ParseInt(std::string_view text);

/// The shortest text that reads back as the same number.
std::string FormatDouble(double value);
/// With the given number of decimals, at most 17, in any locale.
std::string FormatFixed(double value, int decimals);

/// Least number of characters to insert, delete or replace to make one out of the other, ignoring case
/// (Levenshtein 1966).
int EditDistance(std::string_view a, std::string_view b);

}  // namespace orbslam
