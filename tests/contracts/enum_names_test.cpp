/// Every table of names of the libraries.

#include <ssphh/core/log.h>
#include <ssphh/farm/job.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/majordomo/client.h>
#include <ssphh/methods/drawing.h>
#include <ssphh/methods/vct/pyramid.h>
#include <ssphh/methods/vpl/virtual_lights.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/sh/convert.h>
#include <ssphh/sh/window.h>
#include <ssphh/study/lint.h>

#include "enum_tables.h"

namespace ssphh::test {
namespace {

using Tables =
    testing::Types<LogLevel, image::Layout, image::ToneCurve, sh::Convention, sh::NonNegative, scene::Wrap,
                   scene::AlphaMode, scene::LightType, trace::Projection, probes::LightOperator,
                   rays::PathSet, probes::VizMethod, probes::VizSource, probes::GenMode, probes::HierOperator,
                   probes::WeightMethod, probes::LookupMethod, probes::ProbeLayer, study::ProbeProblem,
                   bake::BakeStage, methods::Drawing, methods::vct::Storage, methods::vpl::VplKind,
                   majordomo::Outcome, farm::JobKind>;
INSTANTIATE_TYPED_TEST_SUITE_P(OfLibraries, EnumTable, Tables);

}  // namespace
}  // namespace ssphh::test
