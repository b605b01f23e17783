#pragma once
/// Parameters of a method by name, checked against what the method declares.

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>

namespace ssphh::methods {

/// A number, or one of a few words.
struct MethodParameter {
  const char* name;
  double value;  ///< default; of a choice: its index
  double least, most;
  const char* about;                      ///< with its unit
  bool whole = false;                     ///< integers only
  std::vector<std::string> choices = {};  ///< the words, in place of numbers
};

/// The choice of one of some words, by default the one of this index.
inline MethodParameter word_parameter(const char* name, std::vector<std::string> words, const char* about,
                                      std::size_t index = 0) {
  const auto most = static_cast<double>(words.size() - 1);
  return {name, static_cast<double>(index), 0, most, about, true, std::move(words)};
}

/// The choice of an enum's value by its name, where not all are meant one of `names`.
template <class E>
MethodParameter choice_parameter(const char* name, E value, const char* about,
                                 const std::vector<std::string>& names = names_of<E>()) {
  return word_parameter(name, names, about,
                        static_cast<std::size_t>(std::ranges::find(names, name_of(value)) - names.begin()));
}

class MethodParameters {
 public:
  /// The defaults, changed by `settings` of the form "name=value". Throws Error for a name that is not
  /// declared (with the nearest one that is), for what is no number or choice, and for values out of range.
  MethodParameters(const std::string& method, std::span<const MethodParameter> declared,
                   std::span<const std::string> settings = {});

  /// `name` must be declared.
  double number(const std::string& name) const;
  int integer(const std::string& name) const;
  bool flag(const std::string& name) const { return integer(name) != 0; }
  const std::string& choice(const std::string& name) const;
  /// The value that was chosen of a choice_parameter().
  template <class E>
  E choice(const std::string& name) const {
    return *parse_enum<E>(choice(name));
  }

 private:
  struct Value {
    double number;
    std::vector<std::string> choices;
  };
  std::map<std::string, Value> values_;
};

}  // namespace ssphh::methods
