#include "enum_tables.h"
#include "model/settings.h"

namespace ssphh::test {
namespace {

using Tables = testing::Types<viewer::Show, viewer::DebugView, viewer::Ball>;
INSTANTIATE_TYPED_TEST_SUITE_P(OfTheViewer, EnumTable, Tables);

}  // namespace
}  // namespace ssphh::test
