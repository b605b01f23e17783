#pragma once
/// Whose threads the library works on: oneTBB's, in an arena of its own, or those of a caller's job system.

namespace ssphh {

/// A job system as parallel loops use it (enkiTS, a game's own, Box2D's three callbacks have this shape). The
/// thread that runs a loop works on it itself; an executor lends it others. Implementations must be safe to
/// call from several threads, also from within a job: loops nest.
class Executor {
 public:
  /// Work that does not care how often it is run, or at once on how many threads. `run(data)` does not throw,
  /// and returns at once when there is nothing left to do.
  struct Job {
    void (*run)(void* data);
    void* data;
  };

  virtual ~Executor() = default;
  /// Threads that may work on a loop, the one that runs it included: 1 or more. Asked for at each loop; 1:
  /// start() is not called.
  virtual int thread_count() const = 0;
  /// Lets other threads run the job, at most `times` times in all, as soon as they are free. Does not wait
  /// for them, and does not throw. Returns what finish() is given.
  virtual void* start(Job job, int times) = 0;
  /// Called once for each start(), on the thread that called it: returns when no run of the job is under way,
  /// and none begins any more. A run that no thread has taken yet must be dropped, or be done here: who only
  /// waits for it waits for ever where all threads do.
  virtual void finish(void* started) = 0;
};

/// Makes all parallel loops run on `executor`, which must outlive the last of them; null: oneTBB again, as at
/// first. Not while a loop runs. What is computed does not depend on it, to the bit.
void set_executor(Executor* executor);

}  // namespace ssphh
