#pragma once
/// What ThreadSanitizer cannot see: an order between threads that a library without instrumentation makes,
/// such as TBB between the thread that starts a loop and those that run it. Say so as narrowly as it is true,
/// or real races are hidden. Without the sanitizer (CMake: SSPHH_SANITIZE=thread) these functions are empty.

#ifdef SSPHH_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
extern "C" void AnnotateIgnoreWritesBegin(const char* file, int line);
extern "C" void AnnotateIgnoreWritesEnd(const char* file, int line);
#endif

namespace ssphh {

/// All that this thread did so far comes before what a thread does after happens_after() of the same address.
inline void happens_before([[maybe_unused]] void* address) {
#ifdef SSPHH_THREAD_SANITIZER
  __tsan_release(address);
#endif
}

/// What threads did before their happens_before() of this address comes before all that this thread does from
/// now on.
inline void happens_after([[maybe_unused]] void* address) {
#ifdef SSPHH_THREAD_SANITIZER
  __tsan_acquire(address);
#endif
}

/// Around a call into such a library: what it writes there for its own threads is its own affair.
class LibraryWrites {
 public:
#ifdef SSPHH_THREAD_SANITIZER
  LibraryWrites() {
    AnnotateIgnoreWritesBegin(__FILE__, __LINE__);
  }
  ~LibraryWrites() {
    AnnotateIgnoreWritesEnd(__FILE__, __LINE__);
  }
#else
  LibraryWrites() {}
  ~LibraryWrites() {}
#endif
  LibraryWrites(const LibraryWrites&) = delete;
  LibraryWrites& operator=(const LibraryWrites&) = delete;
};

}  // namespace ssphh
