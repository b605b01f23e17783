#pragma once
/// XML text, element by element: indented, UTF-8, names and texts escaped.

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ssphh::scene_io {

class XmlWriter {
 public:
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  /// `declaration`: begins with <?xml …?>, which some readers of XML dialects do not expect.
  explicit XmlWriter(bool declaration = true);

  /// Begins an element that holds others.
  void open(std::string_view element, Attributes attributes = {});
  /// Ends the elements that were opened last, so many.
  void close(int count = 1);
  /// An element that holds nothing.
  void empty(std::string_view element, Attributes attributes = {});
  /// An element that holds a text.
  void text(std::string_view element, std::string_view text, Attributes attributes = {});
  void comment(std::string_view text);

  /// All that was written; every element must be closed.
  const std::string& str() const;

 private:
  void begin(std::string_view element, Attributes attributes);

  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace ssphh::scene_io
