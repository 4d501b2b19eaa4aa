#include "studies/run/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

namespace rollres {

namespace {

template <class... Values>
std::string formatted(const char* pattern, Values... values) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

}  // namespace

namespace {

std::optional<winsize> terminal_size(const std::ostream& stream) {
  const int file = &stream == &std::cout ? STDOUT_FILENO : &stream == &std::cerr ? STDERR_FILENO : -1;
  if (file < 0 || !isatty(file)) return std::nullopt;
  winsize size{};
  constexpr unsigned short usual_width = 80, usual_height = 24;
  if (ioctl(file, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    size.ws_col = usual_width;
    size.ws_row = usual_height;
  }
  return size;
}

}  // namespace

std::size_t terminal_width(const std::ostream& stream) {
  const auto size = terminal_size(stream);
  return size ? size->ws_col : 0;
}

std::size_t terminal_height(const std::ostream& stream) {
  const auto size = terminal_size(stream);
  return size ? size->ws_row : 0;
}

std::string duration_in_words(double seconds) {
  if (seconds < 9.95) return formatted("%.2g s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 60) return formatted("%ld s", whole);
  if (whole < 3600) return formatted("%ld:%02ld", whole / 60, whole % 60);
  return formatted("%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_line(const SweepProgress& progress, std::size_t width) {
  std::string words = std::to_string(progress.solved) + " of " + std::to_string(progress.to_solve);
  if (progress.solved > 0 && progress.seconds > 0) {
    const double rate = static_cast<double>(progress.solved) / progress.seconds;
    words += formatted(", %.3g/s, ", rate);
    const std::size_t left = progress.to_solve - std::min(progress.solved, progress.to_solve);
    words += duration_in_words(static_cast<double>(left) / rate) + " left";
  }
  if (progress.failed > 0) words += ", " + std::to_string(progress.failed) + " failed";
  if (progress.stopping) words += "; stopping after the running points (interrupt again: at once)";
  if (words.size() >= width) return words.substr(0, width);
  const std::size_t length = std::min<std::size_t>(40, width - words.size());
  if (length < 10) return words;
  const double part = progress.to_solve == 0 ? 1.0 : static_cast<double>(progress.solved) / progress.to_solve;
  const std::size_t full = static_cast<std::size_t>(std::min(1.0, part) * static_cast<double>(length - 3));
  return "[" + std::string(full, '#') + std::string(length - 3 - full, '-') + "] " + words;
}

StatusLine::StatusLine(std::ostream& stream) : stream_(stream), width_(terminal_width(stream)) {}

void StatusLine::show(const std::string& text) {
  if (width_ > 0) stream_ << '\r' << text.substr(0, width_ - 1) << "\x1b[K" << std::flush;
}

}  // namespace rollres
