#pragma once
/// Memory of this machine.

#include <cstdint>

namespace ssphh {

/// Memory that this process may take [bytes]: the machine's, or its control group's limit where that is less.
std::uint64_t memory_of_machine();

}  // namespace ssphh
