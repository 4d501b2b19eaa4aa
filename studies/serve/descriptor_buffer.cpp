#include "studies/serve/descriptor_buffer.hpp"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace rollres {

DescriptorBuffer::int_type DescriptorBuffer::underflow() {
  while (!stop_) {
    pollfd asked{descriptor_, POLLIN, 0};
    constexpr int milliseconds = 100;
    if (const int ready = ::poll(&asked, 1, milliseconds); ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t got = ::read(descriptor_, received_.data(), received_.size());
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) break;
    setg(received_.data(), received_.data(), received_.data() + got);
    return traits_type::to_int_type(*gptr());
  }
  return traits_type::eof();
}

DescriptorBuffer::int_type DescriptorBuffer::overflow(int_type letter) {
  const char one = traits_type::to_char_type(letter);
  return xsputn(&one, 1) == 1 ? letter : traits_type::eof();
}

std::streamsize DescriptorBuffer::xsputn(const char* text, std::streamsize size) {
  for (std::streamsize written = 0; written < size;) {
    const ssize_t some = ::write(descriptor_, text + written, static_cast<std::size_t>(size - written));
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) return written;
    written += some;
  }
  return size;
}

}  // namespace rollres
