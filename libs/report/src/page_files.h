#pragma once
/// The files of libs/report/page, kept in the library at build time.

#include <string_view>

namespace ssphh::report {

extern const std::string_view page_html;
extern const std::string_view page_style;
extern const std::string_view page_script;

}  // namespace ssphh::report
