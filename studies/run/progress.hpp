#pragma once

/// One line that tells how far a sweep is, for people who wait in front of a terminal.

#include <cstddef>
#include <iosfwd>
#include <string>

namespace rollres {

/// How far a run over many points or pieces is.
struct SweepProgress {
  std::size_t to_solve = 0;  ///< points without an answer at the start, or with one that is asked for again
  std::size_t solved = 0;    ///< in this run
  std::size_t failed = 0;    ///< of these, without an answer
  std::size_t left = 0;      ///< neither stored, nor being solved in this run
  double seconds = 0;        ///< since the start
  bool stopping = false;
};

/// "[######------]  57 of 180, 12.3/s, 0:10 left, 2 failed", at most `width` columns.
std::string progress_line(const SweepProgress& progress, std::size_t width);

/// A duration as people say it: "0.21 s", "41 s", "3:05", "2:10:00".
std::string duration_in_words(double seconds);

/// Columns of the terminal behind standard output or error, or 0 if the stream is no terminal.
std::size_t terminal_width(const std::ostream& stream);

/// Its lines, 0 likewise.
std::size_t terminal_height(const std::ostream& stream);

/// A line on the terminal behind a stream that each new text takes the place of; nothing where there is no terminal.
class StatusLine {
 public:
  explicit StatusLine(std::ostream& stream);
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  ~StatusLine() { clear(); }

  /// Whether there is somebody to see it.
  explicit operator bool() const { return width_ > 0; }
  void show(const std::string& text);
  void show(const SweepProgress& progress) { show(progress_line(progress, width_ - 1)); }
  void clear() { show(""); }

 private:
  std::ostream& stream_;
  std::size_t width_;  // columns, or 0
};

}  // namespace rollres
