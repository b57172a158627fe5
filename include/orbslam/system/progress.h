// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace orbslam {

/// Shows how far a run is: one line that is redrawn where the stream is a terminal, else a plain line now and
/// then.
class Progress {
 public:
  enum class Mode { kQuiet, kAutomatic };

  Progress(std::FILE* stream, int total, Mode mode);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// done of total; `detail` is what else is worth knowing. Cheap to call for every frame.
  void Update(int done, const std::string& detail);
  /// Whether Update would show something now: details need not be put together otherwise.
  bool IsDue(int done) const;
  /// Ends the line, so that other output starts on its own.
  void Finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::FILE* stream_;
  int total_;
  bool is_quiet_, is_terminal_;
  bool has_open_line_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

/// "####------  25 %  30/120  12.5 fps  ETA 0:07", the text that Progress shows before the detail.
std::string FormatProgress(int done, int total, double elapsed_s, bool with_bar);

}  // namespace orbslam
