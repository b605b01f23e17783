#include "yaml_reader.h"

#include <regex>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parse_number.h>

namespace ssphh::report {
namespace {

constexpr std::size_t most_values = 1'000'000;

std::string at_line(const std::string& name, const YAML::Mark& mark) {
  return mark.is_null() ? name : fmt::format("{}:{}", name, mark.line + 1);
}

// Plain scalars by the core schema of YAML 1.2: null, true and false, whole numbers, other numbers, text.
json::Value plain_scalar(const std::string& text) {
  if (text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL") return nullptr;
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  const std::string_view digits = text[0] == '+' ? std::string_view(text).substr(1) : text;
  if (const auto whole = parse_number<std::int64_t>(digits)) return *whole;
  if (const auto number = parse_number<double>(digits)) return *number;
  return text;
}

class Converter {
 public:
  explicit Converter(const std::string& name) : name_(name) {}

  json::Value convert(const YAML::Node& node) {
    if (++values_ > most_values) throw Error(at_line(name_, node.Mark()), "holds over a million values");
    switch (node.Type()) {
      case YAML::NodeType::Scalar:
        return node.Tag() == "!" ? json::Value(node.Scalar())
                                 : plain_scalar(node.Scalar());  // "!": in quotes
      case YAML::NodeType::Sequence: {
        json::Value list = json::Value::array();
        for (const YAML::Node& item : node) list.push_back(convert(item));
        return list;
      }
      case YAML::NodeType::Map: {
        json::Value object = json::Value::object();
        for (const auto& pair : node) {
          if (!pair.first.IsScalar()) throw Error(at_line(name_, pair.first.Mark()), "a key must be text");
          const std::string& key = pair.first.Scalar();
          if (object.contains(key))
            throw Error(at_line(name_, pair.first.Mark()), fmt::format("\"{}\" stands twice", key));
          object[key] = convert(pair.second);
        }
        return object;
      }
      default:
        return nullptr;
    }
  }

 private:
  const std::string& name_;
  std::size_t values_ = 0;
};

}  // namespace

bool is_yaml_name(std::string_view name) {
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

json::Value parse_yaml(std::string_view text, const std::string& name) {
  try {
    return Converter(name).convert(YAML::Load(std::string(text)));
  } catch (const YAML::Exception& e) {
    throw Error(at_line(name, e.mark), fmt::format("is not YAML: {}", e.msg));
  }
}

int yaml_line(std::string_view text, const std::string& name, const std::string& where,
              const std::string& key) {
  if (!where.starts_with(name)) return 0;
  YAML::Node node = YAML::Load(std::string(text));
  int line = node.Mark().line + 1;
  const std::string path = where.substr(name.size());
  static const std::regex word(R"(([^.: \[\]]+)|\[(\d+)\])");
  for (auto it = std::sregex_iterator(path.begin(), path.end(), word); it != std::sregex_iterator(); ++it) {
    YAML::Node next;
    if ((*it)[2].matched) {
      const std::size_t index = std::stoul((*it)[2]);
      if (!node.IsSequence() || index >= node.size()) break;
      next.reset(node[index]);
    } else {
      if (!node.IsMap() || !node[(*it)[1].str()]) break;
      next.reset(node[(*it)[1].str()]);
    }
    node.reset(next);
    line = node.Mark().line + 1;
  }
  if (node.IsMap() && !key.empty()) {
    for (const auto& pair : node)
      if (pair.first.IsScalar() && pair.first.Scalar() == key) line = pair.first.Mark().line + 1;
  }
  return line;
}

}  // namespace ssphh::report
