#pragma once

#include <ssphh/core/happens_before.h>

namespace ssphh {

/// The order that a parallel loop makes: what came before it comes before every chunk, and every chunk before
/// what follows it. Between two chunks there is none, so that races between them are found.
class ForkJoin {
 public:
  ForkJoin() { happens_before(&fork_); }
  ~ForkJoin() { happens_after(&join_); }
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;

  /// Stands around the work of one chunk, also when it throws.
  class Chunk {
   public:
    explicit Chunk(ForkJoin& loop) : loop_(loop) { happens_after(&loop_.fork_); }
    ~Chunk() { happens_before(&loop_.join_); }
    Chunk(const Chunk&) = delete;
    Chunk& operator=(const Chunk&) = delete;

   private:
    ForkJoin& loop_;
  };

 private:
  char fork_ = 0, join_ = 0;
};

}  // namespace ssphh
