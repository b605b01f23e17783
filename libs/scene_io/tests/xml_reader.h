#pragma once
/// A small strict XML reader for tests: elements, attributes, texts, comments, the five entities. Anything
/// else, a repeated attribute or a character that XML forbids is an exception.

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ssphh::test {

struct XmlElement {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;

  const std::string& at(const std::string& attribute) const {
    const auto found = attributes.find(attribute);
    if (found == attributes.end()) throw std::runtime_error("<" + name + "> has no " + attribute);
    return found->second;
  }
  /// The only child of that name.
  const XmlElement& child(const std::string& wanted) const {
    const XmlElement* result = nullptr;
    for (const XmlElement& c : children) {
      if (c.name != wanted) continue;
      if (result) throw std::runtime_error("<" + name + "> has two <" + wanted + ">");
      result = &c;
    }
    if (!result) throw std::runtime_error("<" + name + "> has no <" + wanted + ">");
    return *result;
  }
  std::vector<const XmlElement*> all(const std::string& wanted) const {
    std::vector<const XmlElement*> result;
    for (const XmlElement& c : children)
      if (c.name == wanted) result.push_back(&c);
    return result;
  }
};

class XmlReader {
 public:
  explicit XmlReader(std::string_view text) : text_(text) {}

  XmlElement document() {
    for (const char c : text_)
      if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r')
        fail("control character");
    if (take("<?xml ")) skip_past("?>");
    skip_misc();
    XmlElement root = element();
    skip_misc();
    if (at_ != text_.size()) fail("something after the root");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("XML, byte " + std::to_string(at_) + ": " + what);
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(std::string_view s) {
    if (text_.substr(at_, s.size()) != s) return false;
    at_ += s.size();
    return true;
  }
  void skip_space() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }
  void skip_past(std::string_view s) {
    const std::size_t end = text_.find(s, at_);
    if (end == std::string_view::npos) fail("no end");
    at_ = end + s.size();
  }
  bool comment() {
    if (!take("<!--")) return false;
    const std::size_t end = text_.find("--", at_);
    if (end == std::string_view::npos || text_.substr(end, 3) != "-->") fail("-- in a comment");
    at_ = end + 3;
    return true;
  }
  void skip_misc() {
    do skip_space();
    while (comment());
  }
  std::string name() {
    const std::size_t begin = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '_') ++at_;
    if (at_ == begin) fail("no name");
    return std::string(text_.substr(begin, at_ - begin));
  }
  std::string content(char end) {
    std::string out;
    while (peek() != end) {
      if (at_ >= text_.size() || peek() == '<') fail("bad text");
      if (peek() != '&') {
        out += text_[at_++];
        continue;
      }
      if (take("&amp;"))
        out += '&';
      else if (take("&lt;"))
        out += '<';
      else if (take("&gt;"))
        out += '>';
      else if (take("&quot;"))
        out += '"';
      else if (take("&apos;"))
        out += '\'';
      else
        fail("unknown entity");
    }
    return out;
  }
  XmlElement element() {
    XmlElement result;
    if (!take("<")) fail("no element");
    result.name = name();
    for (;;) {
      skip_space();
      if (take("/>")) return result;
      if (take(">")) break;
      const std::string key = name();
      if (!take("=\"")) fail("no value");
      if (!result.attributes.emplace(key, content('"')).second) fail("attribute twice");
      if (!take("\"")) fail("no end of a value");
    }
    for (;;) {
      if (comment()) continue;
      if (take("</")) {
        if (name() != result.name || !take(">")) fail("wrong end of <" + result.name + ">");
        return result;
      }
      if (peek() == '<') {
        result.children.push_back(element());
      } else {
        const std::string text = content('<');
        if (text.find_first_not_of(" \t\r\n") != std::string::npos) result.text += text;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace ssphh::test
