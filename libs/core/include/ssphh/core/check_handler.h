#pragma once
/// What happens before a mistake of this library ends the program: a host's own crash report, for instance.

namespace ssphh {

/// Is told the condition that did not hold and its place in the source, on the thread that found it. When it
/// returns the program aborts; it may end the program itself, but must not throw or use the library.
using CheckHandler = void (*)(const char* condition, const char* file, int line);

/// Sets what SSPHH_CHECK calls, in place of a line on stderr, and returns what it called before; null: that
/// line. From any thread.
CheckHandler set_check_handler(CheckHandler handler);

}  // namespace ssphh
