#include <chrono>

#include <epoxy/gl.h>

#include <ssphh/gl/timer.h>

namespace ssphh::gl {
namespace {

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

void delete_query(unsigned id) {
  glDeleteQueries(1, &id);
}

Timer::Timer(bool software) : software_(software) {
  if (software_) return;
  for (auto& query : queries_) {
    unsigned id = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &id);
    query = Handle<delete_query>(id);
  }
}

void Timer::begin() {
  if (!software_) {
    // Take the results that are there; the oldest is waited for when all queries are under way
    while (pending_ > 0) {
      const auto oldest = static_cast<std::size_t>((next_ - pending_ + in_flight) % in_flight);
      const unsigned id = queries_[oldest].get();
      GLint ready = 0;
      glGetQueryObjectiv(id, GL_QUERY_RESULT_AVAILABLE, &ready);
      if (!ready && pending_ < in_flight) break;
      GLuint64 nanoseconds = 0;
      glGetQueryObjectui64v(id, GL_QUERY_RESULT, &nanoseconds);
      gpu_ms_ = static_cast<double>(nanoseconds) * 1e-6;
      --pending_;
    }
    glBeginQuery(GL_TIME_ELAPSED, queries_[next_].get());
  }
  start_ = now_ms();
}

void Timer::end() {
  if (software_) {
    glFinish();
    cpu_ms_ = gpu_ms_ = now_ms() - start_;
    return;
  }
  cpu_ms_ = now_ms() - start_;
  glEndQuery(GL_TIME_ELAPSED);
  next_ = (next_ + 1) % in_flight;
  ++pending_;
}

SampleCounter::SampleCounter(bool software) : software_(software) {
  unsigned id = 0;
  glCreateQueries(GL_SAMPLES_PASSED, 1, &id);
  query_ = Handle<delete_query>(id);
}

void SampleCounter::begin() {
  if (waiting_) {
    GLint ready = 0;
    glGetQueryObjectiv(query_.get(), GL_QUERY_RESULT_AVAILABLE, &ready);
    if (!ready && !software_) return;
    GLuint64 samples = 0;
    glGetQueryObjectui64v(query_.get(), GL_QUERY_RESULT, &samples);
    count_ = samples;
    waiting_ = false;
  }
  glBeginQuery(GL_SAMPLES_PASSED, query_.get());
  counting_ = true;
}

void SampleCounter::end() {
  if (!counting_) return;
  glEndQuery(GL_SAMPLES_PASSED);
  counting_ = false;
  waiting_ = true;
}

}  // namespace ssphh::gl
