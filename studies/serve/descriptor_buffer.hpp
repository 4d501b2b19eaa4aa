#pragma once

/// A file descriptor behind a stream: standard input, or a connection.

#include <array>
#include <atomic>
#include <streambuf>

namespace rollres {

class DescriptorBuffer : public std::streambuf {
 public:
  /// @param stop  set from outside: the input ends, within 0.1 s where nothing comes
  DescriptorBuffer(int descriptor, const std::atomic<bool>& stop) : descriptor_(descriptor), stop_(stop) {}

 protected:
  int_type underflow() override;
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;

 private:
  int descriptor_;
  const std::atomic<bool>& stop_;
  std::array<char, 65536> received_{};
};

}  // namespace rollres
