/// What stands in the module's values before anything is put into them.

#include <gtest/gtest.h>

#include <ssphh/report/cache.h>
#include <ssphh/report/measure.h>
#include <ssphh/report/report.h>

namespace ssphh::report {
namespace {

TEST(ReportDefaults, OfPlans) {
  const Inset inset;
  EXPECT_EQ(inset.x0, 0);
  EXPECT_EQ(inset.y0, 0);
  EXPECT_EQ(inset.x1, 1);
  EXPECT_EQ(inset.y1, 1);
  EXPECT_EQ(PlanScene().exposure, std::nullopt);
  EXPECT_FALSE(PlanScene().optional);
  EXPECT_EQ(PlanMethod().repetitions, 1);
  EXPECT_EQ(Column().better, 0);
  EXPECT_FALSE(Chart().log_x);
  EXPECT_FALSE(Chart().log_y);
  EXPECT_FALSE(Plan().has_reference);
  EXPECT_EQ(Plan().block, 16);
  EXPECT_EQ(Plan().time_limit, 3600);
  EXPECT_EQ(MeasureParams().block, 16);
}

TEST(ReportDefaults, OfRuns) {
  EXPECT_EQ(Cell().scene, 0u);
  EXPECT_EQ(Cell().method, -1) << "the reference";
  EXPECT_EQ(ExpandContext().threads, 0);
  const JobRecord record;
  EXPECT_EQ(record.seconds, 0);
  EXPECT_EQ(record.cpu_seconds, 0);
  EXPECT_EQ(record.peak_bytes, 0u);
}

TEST(ReportDefaults, OfReports) {
  const Value value;
  EXPECT_EQ(value.mean, 0);
  EXPECT_EQ(value.median, 0);
  EXPECT_EQ(value.deviation, 0);
  EXPECT_EQ(value.count, 0);
  const StepRun step;
  EXPECT_EQ(step.repetition, 0);
  EXPECT_EQ(step.seconds, 0);
  EXPECT_EQ(step.peak_bytes, 0u);
  EXPECT_EQ(ReportCell().scene, 0u);
  EXPECT_EQ(ReportCell().method, -1) << "the reference";
  const PackedImage packed;
  EXPECT_EQ(packed.width, 0);
  EXPECT_EQ(packed.height, 0);
  EXPECT_EQ(packed.channels, 3);
}

}  // namespace
}  // namespace ssphh::report
