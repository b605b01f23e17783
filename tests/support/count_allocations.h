#pragma once

namespace ssphh::test {

/// How often this program called operator new so far, on any thread. OpenGL's driver and oneTBB have their
/// own allocators. 0 in builds with sanitizers.
long allocations();

}  // namespace ssphh::test
