/// Times and counts against those that the queries themselves give.

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <ssphh/gl/timer.h>

#include "shaders.h"

namespace ssphh::gl {
namespace {

class GlTimer : public WithShaders {
 protected:
  void TearDown() override {
    if (!IsSkipped()) gl().throw_on_error("after the test");
  }
  static unsigned current_query(GLenum target) {
    GLint id = 0;
    glGetQueryiv(target, GL_CURRENT_QUERY, &id);
    return static_cast<unsigned>(id);
  }
  static std::uint64_t result_of(unsigned query) {
    GLuint64 result = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &result);
    return result;
  }
  /// Milliseconds that `action` takes.
  template <class Action>
  static double ms_of(const Action& action) {
    const auto begin = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
};

TEST_F(GlTimer, OnASoftwareRendererIsTheClock) {
  Timer timer(true);
  EXPECT_EQ(timer.gpu_ms(), 0);
  EXPECT_EQ(timer.cpu_ms(), 0);
  double inner = 0;
  const double outer = ms_of([&] {
    timer.begin();
    EXPECT_EQ(current_query(GL_TIME_ELAPSED), 0u);
    inner = ms_of([] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); });
    timer.end();
  });
  EXPECT_GE(timer.cpu_ms(), inner);
  EXPECT_LE(timer.cpu_ms(), outer);
  EXPECT_EQ(timer.gpu_ms(), timer.cpu_ms());
}

TEST_F(GlTimer, OnAGpuIsTheQueryOfTheLastSpanThatIsKnown) {
  Timer timer(false);
  std::vector<unsigned> queries;
  std::uint64_t last = 0;
  for (int i = 0; i < 9; ++i) {
    double inner = 0;
    const double outer = ms_of([&] {
      timer.begin();
      EXPECT_EQ(timer.gpu_ms(), static_cast<double>(last) * 1e-6);
      queries.push_back(current_query(GL_TIME_ELAPSED));
      inner = ms_of([] { std::this_thread::sleep_for(std::chrono::microseconds(100)); });
      timer.end();
    });
    EXPECT_GE(timer.cpu_ms(), inner);
    EXPECT_LE(timer.cpu_ms(), outer);
    glFinish();
    last = result_of(queries.back());
    EXPECT_GT(last, 0u);
  }
  EXPECT_EQ(std::set(queries.begin(), queries.end()).size(), 4u) << "four are in flight";
  for (std::size_t i = 4; i < queries.size(); ++i) EXPECT_EQ(queries[i], queries[i - 4]);
}

/// A query that has ended.
struct GlQuery {
  GlQuery() {
    glCreateQueries(GL_TIME_ELAPSED, 1, &id);
    glBeginQuery(GL_TIME_ELAPSED, id);
    glEndQuery(GL_TIME_ELAPSED);
  }
  ~GlQuery() { glDeleteQueries(1, &id); }
  GlQuery(const GlQuery&) = delete;
  GlQuery& operator=(const GlQuery&) = delete;
  unsigned id = 0;
};

/// The queries whose results were asked for, while this lives.
class AskedQueries {
 public:
  AskedQueries() {
    // The first call of a function is what finds it: what stands there before would be called for ever
    const GlQuery query;
    GLint ready = 0;
    glGetQueryObjectiv(query.id, GL_QUERY_RESULT_AVAILABLE, &ready);
    real = before_ = epoxy_glGetQueryObjectiv;
    ids.clear();
    epoxy_glGetQueryObjectiv = [](GLuint id, GLenum what, GLint* result) {
      ids.insert(id);
      real(id, what, result);
    };
  }
  ~AskedQueries() { epoxy_glGetQueryObjectiv = before_; }
  AskedQueries(const AskedQueries&) = delete;
  AskedQueries& operator=(const AskedQueries&) = delete;

  static inline std::set<unsigned> ids;

 private:
  static inline PFNGLGETQUERYOBJECTIVPROC real = nullptr;
  PFNGLGETQUERYOBJECTIVPROC before_;
};

// Of one that was never begun GL need not say that it is ready: a driver may let its result be waited for.
TEST_F(GlTimer, AsksOnlyQueriesThatWereBegun) {
  Timer timer(false);
  const AskedQueries asked;
  std::set<unsigned> begun;
  for (int i = 0; i < 6; ++i) {
    timer.begin();
    EXPECT_TRUE(std::ranges::includes(begun, asked.ids)) << "span " << i;
    begun.insert(current_query(GL_TIME_ELAPSED));
    timer.end();
    glFinish();
  }
  EXPECT_EQ(asked.ids.size(), 4u);
}

/// Samples drawn by `triangles` times the whole picture of 3 × 2.
class GlSampleCounter : public GlTimer {
 protected:
  void SetUp() override {
    GlTimer::SetUp();
    if (IsSkipped()) return;
    picture = Texture(Format::rgba8, 3, 2);
    target = Framebuffer(std::array<const Texture*, 1>{&picture}, nullptr);
    program = whole_picture();
    vertices.emplace();
    bind_framebuffer(target.id(), {0, 0, 3, 2});
    apply_conventions();
    apply({});
    program.use();
    vertices->bind();
  }
  void count(SampleCounter& counter, int triangles) {
    counter.begin();
    for (int i = 0; i < triangles; ++i) draw_triangles(3);
    counter.end();
  }
  Texture picture;
  Framebuffer target;
  Program program;
  std::optional<VertexArray> vertices;  // made when there is a context
};

TEST_F(GlSampleCounter, CountsWhatIsDrawnBetweenBeginAndEnd) {
  for (const bool software : {true, false}) {
    SampleCounter counter(software);
    EXPECT_EQ(counter.count(), 0u);
    count(counter, 2);
    EXPECT_EQ(counter.count(), 0u) << "known from the next begin on";
    draw_triangles(3);
    if (!software) glFinish();
    count(counter, 5);
    EXPECT_EQ(counter.count(), 12u);
    if (!software) glFinish();
    count(counter, 0);
    EXPECT_EQ(counter.count(), 30u);
    EXPECT_EQ(current_query(GL_SAMPLES_PASSED), 0u);
  }
}

TEST_F(GlSampleCounter, EndWithoutABeginEndsNobodysQuery) {
  SampleCounter counter(true), other(true);
  other.begin();
  counter.end();
  EXPECT_NE(current_query(GL_SAMPLES_PASSED), 0u);
  draw_triangles(3);
  other.end();
  counter.begin();
  counter.end();
  other.begin();
  EXPECT_EQ(other.count(), 6u);
  other.end();
}

template <class Query>
void end_early(Query& query) {
  try {
    const During looking(query);
    throw std::runtime_error("a shader does not compile");
  } catch (const std::runtime_error&) {
  }
}

TEST_F(GlTimer, ASpanThatEndsEarlyRefusesNoneThatComesAfterIt) {
  for (const bool software : {true, false}) {
    Timer timer(software);
    SampleCounter counter(software), other(software);
    end_early(timer);
    end_early(counter);
    end_early(timer);
    { const During looking(other); }
    EXPECT_NO_THROW(gl().throw_on_error("counting"));
  }
}

}  // namespace
}  // namespace ssphh::gl
