#pragma once

namespace ssphh::test {

/// How often this program called operator new so far. OpenGL's driver has its own allocator.
long allocations();

}  // namespace ssphh::test
