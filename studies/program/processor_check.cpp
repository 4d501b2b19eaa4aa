// Ends the program with a message, and not with an illegal instruction, where the processor lacks what it was compiled
// for (ROLLRES_PROCESSOR in CMakeLists.txt). Runs before anything else of the program.

#if defined(__x86_64__) && defined(__GNUC__)

#include <unistd.h>

#include <cstring>

namespace {

/// The instructions this file, as all others, was compiled for.
#define ROLLRES_REQUIRE(name) \
  if (!__builtin_cpu_supports(name)) missing(name)

__attribute__((target("arch=x86-64"))) void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

int missing_instructions = 0;

__attribute__((target("arch=x86-64"))) void missing(const char* name) {
  say(missing_instructions++ == 0 ? "rollres: was built for a processor with " : ", ");
  say(name);
}

__attribute__((constructor(101), target("arch=x86-64"))) void check_processor() {
  __builtin_cpu_init();
#ifdef __SSE4_2__
  ROLLRES_REQUIRE("sse4.2");
#endif
#ifdef __POPCNT__
  ROLLRES_REQUIRE("popcnt");
#endif
#ifdef __AVX__
  ROLLRES_REQUIRE("avx");
#endif
#ifdef __AVX2__
  ROLLRES_REQUIRE("avx2");
#endif
#ifdef __FMA__
  ROLLRES_REQUIRE("fma");
#endif
#ifdef __BMI__
  ROLLRES_REQUIRE("bmi");
#endif
#ifdef __BMI2__
  ROLLRES_REQUIRE("bmi2");
#endif
#ifdef __AVX512F__
  ROLLRES_REQUIRE("avx512f");
#endif
#ifdef __AVX512DQ__
  ROLLRES_REQUIRE("avx512dq");
#endif
#ifdef __AVX512BW__
  ROLLRES_REQUIRE("avx512bw");
#endif
#ifdef __AVX512VL__
  ROLLRES_REQUIRE("avx512vl");
#endif
  if (missing_instructions == 0) return;
  say(", which this one lacks: configure with -D ROLLRES_PROCESSOR=x86-64 for any processor, native for this one\n");
  _exit(3);
}

}  // namespace

#endif
