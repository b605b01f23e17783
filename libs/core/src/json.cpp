#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ssphh/core/error.h>
#include <ssphh/core/json.h>

namespace ssphh::json {

/// What nlohmann's reader tells, in order; limits are checked before anything is kept.
class Builder {
 public:
  Builder(const std::string& where, const Limits& limits) : where_(where), limits_(limits) {}

  bool null() { return add_plain({}); }
  bool boolean(bool value) { return add_plain(value); }
  bool number_integer(std::int64_t value) { return add_plain(value); }
  bool number_unsigned(std::uint64_t value) { return add_plain(value); }
  bool number_float(double value, const std::string&) { return add_plain(value); }
  bool string(std::string& text) { return add_plain(std::move(text)); }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool start_object(std::size_t) { return begin(Value::object()); }
  bool start_array(std::size_t) { return begin(Value::array()); }
  bool key(std::string& name) {
    names_.back() = std::move(name);
    return true;
  }
  bool end_object() {
    keep_last(std::get<Members>(open_.back().data_));
    return end();
  }
  bool end_array() { return end(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& e) {
    const std::string_view message = e.what();
    const auto end_of_id = message.find("] ");  // "[json.exception.parse_error.101] parse error at …"
    throw Error(where_, fmt::format("is not valid JSON: {}",
                                    end_of_id == message.npos ? message : message.substr(end_of_id + 2)));
  }

  Value result;

 private:
  // Two bytes of text, "0,", are a value of forty.
  bool add_plain(Value value) {
    if (++plain_ > 8 * limits_.containers)
      throw Error(where_, fmt::format("the JSON has more than {} values", 8 * limits_.containers));
    return add(std::move(value));
  }

  bool add(Value value) {
    if (open_.empty()) {
      result = std::move(value);
    } else if (open_.back().is_array()) {
      open_.back().push_back(std::move(value));
    } else {
      std::get<Members>(open_.back().data_).emplace_back(std::move(names_.back()), std::move(value));
    }
    return true;
  }

  bool begin(Value container) {
    if (open_.size() >= static_cast<std::size_t>(limits_.depth))
      throw Error(where_, fmt::format("the JSON is nested deeper than {} levels", limits_.depth));
    if (++containers_ > limits_.containers)
      throw Error(where_, fmt::format("the JSON has more than {} arrays and objects", limits_.containers));
    open_.push_back(std::move(container));
    names_.emplace_back();
    return true;
  }

  bool end() {
    Value finished = std::move(open_.back());
    open_.pop_back();
    names_.pop_back();
    return add(std::move(finished));
  }

  /// Of members of one name the last, where the first stood. To look for each as it comes would take the
  /// square of their number.
  static void keep_last(Members& members) {
    std::unordered_map<std::string_view, std::size_t> last;
    for (std::size_t i = 0; i < members.size(); ++i) last[members[i].first] = i;
    if (last.size() == members.size()) return;
    Members kept;
    for (const Member& member : members) {
      const auto found = last.find(member.first);
      if (found == last.end()) continue;
      kept.push_back(members[found->second]);
      last.erase(found);
    }
    members = std::move(kept);
  }

  const std::string& where_;
  const Limits& limits_;
  std::size_t containers_ = 0, plain_ = 0;
  std::vector<Value> open_;         ///< containers that have begun
  std::vector<std::string> names_;  ///< of the member that each of them reads
};

namespace {

/// As nlohmann/json prints it, kind by kind.
struct Printer {
  int indent;
  bool ascii;
  std::string out;

  void scalar(const nlohmann::json& value) {
    out += value.dump(-1, ' ', ascii, nlohmann::json::error_handler_t::replace);
  }
  void line(int level) {
    if (indent < 0) return;
    out += '\n';
    out.append(static_cast<std::size_t>(indent * level), ' ');
  }

  void print(const Value& value, int level) {
    if (value.is_array()) {
      list('[', ']', value.elements(), level, [&](const Value& element) { print(element, level + 1); });
    } else if (value.is_object()) {
      list('{', '}', value.members(), level, [&](const Member& member) {
        scalar(member.first);
        out += indent < 0 ? ":" : ": ";
        print(member.second, level + 1);
      });
    } else if (value.is_string()) {
      scalar(value.string());
    } else if (value.is_boolean()) {
      scalar(value.boolean());
    } else if (value.is_integer()) {
      out += value.digits();
    } else if (value.is_number()) {
      scalar(value.number());
    } else {
      out += "null";
    }
  }

  template <class Items, class PrintItem>
  void list(char open, char close, const Items& items, int level, PrintItem print_item) {
    out += open;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0) out += ',';
      line(level + 1);
      print_item(items[i]);
    }
    if (!items.empty()) line(level);
    out += close;
  }
};

[[noreturn]] void wrong_kind(const Value& value, const char* wanted) {
  throw std::logic_error(fmt::format("JSON: asked for {} of {}", wanted, value.type_name()));
}

}  // namespace

Value::Value() noexcept : data_(nullptr) {}
Value::Value(const Value&) = default;
Value::Value(Value&&) noexcept = default;
Value& Value::operator=(const Value&) = default;
Value& Value::operator=(Value&&) noexcept = default;
Value::~Value() = default;

Value::Value(Array elements) noexcept : data_(std::move(elements)) {}

Value::Value(std::initializer_list<Value> list) {
  const bool pairs = std::ranges::all_of(list, [](const Value& element) {
    return element.is_array() && element.size() == 2 && element[0].is_string();
  });
  if (!pairs) {
    data_ = Array(list);
    return;
  }
  Members& members = data_.emplace<Members>();
  for (const Value& element : list) members.emplace_back(element[0].string(), element[1]);
}

Value Value::array(std::initializer_list<Value> elements) {
  Value value;
  value.data_ = Array(elements);
  return value;
}

Value Value::object() {
  Value value;
  value.data_ = Members();
  return value;
}

void Value::add(std::string name, Value value) {
  std::get<Members>(data_).emplace_back(std::move(name), std::move(value));
}

void Value::set_integer(bool negative, std::int64_t with_sign, std::uint64_t without) {
  if (negative) {
    data_ = with_sign;
  } else {
    data_ = without;
  }
}

bool Value::is_null() const {
  return std::holds_alternative<std::nullptr_t>(data_);
}
bool Value::is_boolean() const {
  return std::holds_alternative<bool>(data_);
}
bool Value::is_integer() const {
  return std::holds_alternative<std::int64_t>(data_) || std::holds_alternative<std::uint64_t>(data_);
}
bool Value::is_number() const {
  return is_integer() || std::holds_alternative<double>(data_);
}
bool Value::is_string() const {
  return std::holds_alternative<std::string>(data_);
}
bool Value::is_array() const {
  return std::holds_alternative<Array>(data_);
}
bool Value::is_object() const {
  return std::holds_alternative<Members>(data_);
}

const char* Value::type_name() const {
  static constexpr const char* names[] = {"null",   "boolean", "number", "number",
                                          "number", "string",  "array",  "object"};
  return names[data_.index()];
}

bool Value::boolean() const {
  if (const bool* value = std::get_if<bool>(&data_)) return *value;
  wrong_kind(*this, "a boolean");
}

double Value::number() const {
  if (const double* value = std::get_if<double>(&data_)) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&data_)) return static_cast<double>(*value);
  if (const auto* value = std::get_if<std::uint64_t>(&data_)) return static_cast<double>(*value);
  wrong_kind(*this, "a number");
}

std::optional<std::int64_t> Value::integer() const {
  constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  if (const auto* value = std::get_if<std::int64_t>(&data_)) return *value;
  if (const auto* value = std::get_if<std::uint64_t>(&data_); value && *value <= most)
    return static_cast<std::int64_t>(*value);
  if (const double* value = std::get_if<double>(&data_);
      value && *value == std::floor(*value) && std::abs(*value) <= 9007199254740992.0)  // 2^53
    return static_cast<std::int64_t>(*value);
  return std::nullopt;
}

std::string Value::digits() const {
  if (const auto* value = std::get_if<std::int64_t>(&data_)) return fmt::format("{}", *value);
  if (const auto* value = std::get_if<std::uint64_t>(&data_)) return fmt::format("{}", *value);
  wrong_kind(*this, "the digits");
}

const std::string& Value::string() const {
  if (const auto* value = std::get_if<std::string>(&data_)) return *value;
  wrong_kind(*this, "a text");
}

const Array& Value::elements() const {
  if (const auto* value = std::get_if<Array>(&data_)) return *value;
  wrong_kind(*this, "the elements");
}

const Members& Value::members() const {
  if (const auto* value = std::get_if<Members>(&data_)) return *value;
  wrong_kind(*this, "the members");
}

std::size_t Value::size() const {
  return is_array() ? elements().size() : is_object() ? members().size() : 0;
}

const Value& Value::operator[](std::size_t i) const {
  return elements().at(i);
}
Value& Value::operator[](std::size_t i) {
  return const_cast<Value&>(std::as_const(*this)[i]);
}

void Value::push_back(Value element) {
  if (is_null()) data_ = Array();
  if (!is_array()) wrong_kind(*this, "the elements");
  std::get<Array>(data_).push_back(std::move(element));
}

const Value* Value::find(std::string_view name) const {
  if (!is_object()) return nullptr;
  for (const Member& member : members())
    if (member.first == name) return &member.second;
  return nullptr;
}

const Value& Value::operator[](const char* name) const {
  if (const Value* found = find(name)) return *found;
  throw std::logic_error(fmt::format("JSON: asked for the member \"{}\", which is not there", name));
}

Value& Value::operator[](std::string_view name) {
  if (is_null()) data_ = Members();
  if (const Value* found = find(name)) return const_cast<Value&>(*found);
  if (!is_object()) wrong_kind(*this, "the members");
  return std::get<Members>(data_).emplace_back(name, Value()).second;
}

void Value::erase(std::string_view name) {
  if (!is_object()) wrong_kind(*this, "the members");
  std::erase_if(std::get<Members>(data_), [&](const Member& member) { return member.first == name; });
}

void Value::update(const Value& object) {
  for (const Member& member : object.members()) (*this)[member.first] = member.second;
}

bool Value::operator==(const Value& other) const {
  if (is_number() && other.is_number() && !(is_integer() && other.is_integer()))
    return number() == other.number();
  return data_ == other.data_;
}

Value parse(std::string_view text, const std::string& where, const Limits& limits) {
  if (text.size() > limits.bytes)
    throw Error(where,
                fmt::format("the JSON is too large: {} bytes, the limit is {}", text.size(), limits.bytes));
  Builder builder(where, limits);
  nlohmann::json::sax_parse(text, &builder);
  return std::move(builder.result);
}

std::optional<Value> try_parse(std::string_view text, const Limits& limits) {
  try {
    return parse(text, {}, limits);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string print(const Value& value, int indent, Letters letters) {
  Printer printer{indent, letters == Letters::ascii, {}};
  printer.print(value, 0);
  return std::move(printer.out);
}

}  // namespace ssphh::json
