// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

namespace orbslam {
namespace {

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr auto kLineInterval = std::chrono::seconds(5);

}  // namespace

std::string FormatProgress(int done, int total, double elapsed_s, bool with_bar) {
  constexpr int kBarWidth = 24;
  const double share = total > 0 ? static_cast<double>(done) / total : 1.0;
  const double fps = elapsed_s > 0 ? done / elapsed_s : 0.0;
  const int eta_s = fps > 0 ? static_cast<int>(std::ceil((total - done) / fps)) : 0;
  const int filled = static_cast<int>(share * kBarWidth);
  const std::string bar =
      with_bar ? fmt::format("[{:#>{}}{:->{}}] ", "", filled, "", kBarWidth - filled) : std::string();
  return fmt::format("{}{:3.0f} %  {}/{}  {:.1f} fps  ETA {}:{:02}", bar, 100 * share, done, total, fps,
                     eta_s / 60, eta_s % 60);
}

Progress::Progress(std::FILE* stream, int total, Mode mode)
    : stream_(stream),
      total_(total),
      is_quiet_(mode == Mode::kQuiet),
      is_terminal_(isatty(fileno(stream)) == 1) {}

Progress::~Progress() { Finish(); }

bool Progress::IsDue(int done) const { return !is_quiet_ && (done >= total_ || Clock::now() >= next_); }

void Progress::Update(int done, const std::string& detail) {
  if (!IsDue(done)) return;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  const std::string text = FormatProgress(done, total_, elapsed_s, is_terminal_) + "  " + detail;
  if (is_terminal_) {
    std::fputs(("\r" + text + "\x1b[K").c_str(), stream_);  // ESC [ K erases what a longer line left behind
    has_open_line_ = true;
  } else {
    std::fputs((text + "\n").c_str(), stream_);
  }
  std::fflush(stream_);
  next_ = Clock::now() + (is_terminal_ ? Clock::duration(kRedrawInterval) : Clock::duration(kLineInterval));
}

void Progress::Finish() {
  if (has_open_line_) std::fputs("\n", stream_);
  has_open_line_ = false;
}

}  // namespace orbslam
