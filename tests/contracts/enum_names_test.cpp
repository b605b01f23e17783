/// Every table of names of the libraries.

#include <ssphh/core/log.h>
#include <ssphh/farm/job.h>
#include <ssphh/gi/lint.h>
#include <ssphh/gi/lookup.h>
#include <ssphh/gi/vct/pyramid.h>
#include <ssphh/gi/vpl/virtual_lights.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/sh/convert.h>
#include <ssphh/sh/window.h>

#include "enum_tables.h"

namespace ssphh::test {
namespace {

using Tables =
    testing::Types<LogLevel, image::Layout, image::ToneCurve, sh::Convention, sh::NonNegative, scene::Wrap,
                   scene::AlphaMode, scene::LightType, trace::Projection, gi::LightOperator, gi::VizMethod,
                   gi::GenMode, gi::HierOperator, gi::WeightMethod, gi::LookupMethod, gi::ProbeLayer,
                   gi::ProbeProblem, gi::BakeStage, gi::vct::Storage, gi::vpl::VplKind, majordomo::Outcome,
                   farm::JobKind>;
INSTANTIATE_TYPED_TEST_SUITE_P(OfLibraries, EnumTable, Tables);

}  // namespace
}  // namespace ssphh::test
