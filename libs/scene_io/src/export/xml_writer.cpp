#include "xml_writer.h"

#include <ssphh/core/error.h>

#include "printable.h"

namespace ssphh::scene_io {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : printable(text, text.size() * 2)) {
    const char* entity = c == '&'   ? "&amp;"
                         : c == '<' ? "&lt;"
                         : c == '>' ? "&gt;"
                         : c == '"' ? "&quot;"
                                    : nullptr;
    entity ? out += entity : out += c;
  }
  return out;
}

}  // namespace

XmlWriter::XmlWriter(bool declaration) {
  if (declaration) out_ = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n";
}

void XmlWriter::begin(std::string_view element, Attributes attributes) {
  out_.append(2 * open_.size(), ' ').append("<").append(element);
  for (const auto& [name, value] : attributes) {
    out_.append(" ").append(name).append("=\"").append(escaped(value)).append("\"");
  }
}

void XmlWriter::open(std::string_view element, Attributes attributes) {
  begin(element, attributes);
  out_ += ">\n";
  open_.emplace_back(element);
}

void XmlWriter::close(int count) {
  for (; count > 0; --count) {
    SSPHH_CHECK(!open_.empty());
    const std::string element = open_.back();
    open_.pop_back();
    out_.append(2 * open_.size(), ' ').append("</").append(element).append(">\n");
  }
}

void XmlWriter::empty(std::string_view element, Attributes attributes) {
  begin(element, attributes);
  out_ += "/>\n";
}

void XmlWriter::text(std::string_view element, std::string_view text, Attributes attributes) {
  begin(element, attributes);
  out_.append(">").append(escaped(text)).append("</").append(element).append(">\n");
}

void XmlWriter::comment(std::string_view text) {
  std::string safe;
  for (const char c : escaped(text)) {
    if (c == '-' && !safe.empty() && safe.back() == '-') safe += ' ';  // "--" ends a comment
    safe += c;
  }
  out_.append(2 * open_.size(), ' ').append("<!-- ").append(safe).append(" -->\n");
}

const std::string& XmlWriter::str() const {
  SSPHH_CHECK(open_.empty());
  return out_;
}

}  // namespace ssphh::scene_io
