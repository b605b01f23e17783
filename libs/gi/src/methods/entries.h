#pragma once
/// One function per method, in its folder.

#include <ssphh/gi/methods/table.h>

namespace ssphh::gi::methods {

MethodEntry direct_entry();
MethodEntry ambient_entry();
MethodEntry irradiance_volume_entry();
MethodEntry prt_entry();
MethodEntry ssphh_entry();
MethodEntry vct_entry();
MethodEntry ddgi_entry();
MethodEntry vpl_entry();

}  // namespace ssphh::gi::methods
