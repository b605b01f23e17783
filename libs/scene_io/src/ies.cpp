#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/scene_io/ies.h>

#include "printable.h"
#include "text_lines.h"

namespace ssphh::scene_io {
namespace {

using scene::Photometry;

/// Numbers after TILT, by blanks, line ends or commas.
class Numbers {
 public:
  Numbers(std::string_view text, std::size_t line, const std::string& where)
      : rest_(text), line_(line), where_(where) {}

  [[noreturn]] void fail(const std::string& problem, const std::string& hint = {}) const {
    throw Error(fmt::format("{}:{}", where_, line_), problem, hint);
  }

  float next(const char* what) {
    const auto word = take();
    if (word.empty()) fail(fmt::format("the file ends where {} should be", what));
    const auto number = parse_float(word);
    if (!number || !std::isfinite(*number)) fail(fmt::format("\"{}\" is not {}", printable(word, 40), what));
    return *number;
  }

  int whole(const char* what, int low, int high) {
    const float number = next(what);
    if (number != std::floor(number) || number < static_cast<float>(low) || number > static_cast<float>(high))
      fail(fmt::format("{} is {}, it must be a whole number from {} to {}", what, number, low, high));
    return static_cast<int>(number);
  }

  std::vector<float> list(std::size_t count, const char* what) {
    // Two characters at least for each: no memory is taken for what cannot be there.
    if (count > rest_.size() / 2 + 1) fail(fmt::format("the file is too short for {} of {}", count, what));
    std::vector<float> out;
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i) out.push_back(next(what));
    return out;
  }

  bool more_numbers() { return parse_float(take()).has_value(); }

 private:
  static bool parts(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == '\f';
  }

  std::string_view take() {
    while (!rest_.empty() && parts(rest_.front())) {
      line_ += rest_.front() == '\n' ? 1 : 0;
      rest_.remove_prefix(1);
    }
    const auto end = std::ranges::find_if(rest_, parts) - rest_.begin();
    const std::string_view word = rest_.substr(0, static_cast<std::size_t>(end));
    rest_.remove_prefix(word.size());
    return word;
  }

  std::string_view rest_;
  std::size_t line_;
  const std::string& where_;
};

/// Reads over the lines before the numbers; true if tilt factors stand before them.
bool skip_labels(std::string_view& rest, std::size_t& line, const std::string& where) {
  const std::size_t size = rest.size();
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++line;
    if (!text.starts_with("TILT")) continue;
    const std::string_view tilt = trimmed(text.substr(4));
    if (!tilt.starts_with("=")) continue;
    return trimmed(tilt.substr(1)) == "INCLUDE";
  }
  throw Error(where, size == 0 ? "is empty" : "has no line that begins with TILT=",
              "photometric files of IES LM-63 have one before their numbers");
}

/// Columns by their angle, 0 to 360, of a luminaire that is alike on both sides of planes.
std::map<float, std::size_t> all_around(const std::vector<float>& turn, const Numbers& numbers) {
  if (turn.size() == 1) return {{0.0f, 0}};
  std::map<float, std::size_t> columns;
  const auto add = [&](float angle, std::size_t column) {
    columns.emplace(angle > 360 ? angle - 360 : angle, column);
  };
  const float first = turn.front(), last = turn.back();
  const bool sides = first == 90 && last == 270;
  if (!sides && (first != 0 || !(last == 90 || last >= 180)))
    numbers.fail(fmt::format("horizontal angles of type C go from {} to {} degrees", first, last),
                 "they go from 0 to 0, 90, 180 or 360, or from 90 to 270");
  for (std::size_t i = 0; i < turn.size(); ++i) {
    add(turn[i], i);
    if (sides) add(540 - turn[i], i);
    if (last == 90) add(180 - turn[i], i), add(180 + turn[i], i);
    if (last <= 180) add(360 - turn[i], i);
  }
  if (!columns.contains(0) && !columns.contains(360))
    numbers.fail("horizontal angles from 90 to 270 degrees have no 180 among them");
  if (!columns.contains(360)) columns[360] = columns[0];
  if (!columns.contains(0)) columns[0] = columns[360];
  return columns;
}

/// Columns as they come; from 0 on, the other side is alike.
std::map<float, std::size_t> both_sides(const std::vector<float>& turn) {
  std::map<float, std::size_t> columns;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    columns.emplace(turn[i], i);
    if (turn.front() == 0) columns.emplace(0 - turn[i], i);
  }
  return columns;
}

void check_rising(const std::vector<float>& angles, float low, float high, const char* what,
                  const Numbers& numbers) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!(angles[i] >= low && angles[i] <= high))
      numbers.fail(fmt::format("a {} is {}, it must be from {} to {} degrees", what, angles[i], low, high));
    if (i > 0 && !(angles[i] > angles[i - 1]))
      numbers.fail(fmt::format("{}s do not rise: {} follows {}", what, angles[i], angles[i - 1]));
  }
}

}  // namespace

scene::PhotometricTable ies_from_text(std::string_view text, const std::string& where) {
  std::size_t line = 0;
  std::string_view rest = text;
  const bool tilted = skip_labels(rest, line, where);
  Numbers numbers(rest, line + 1, where);
  constexpr int most = static_cast<int>(scene::max_profile_values);
  if (tilted) {
    numbers.next("the lamp's geometry");
    const auto count = static_cast<std::size_t>(numbers.whole("the number of tilt angles", 0, most));
    numbers.list(2 * count, "the tilt angles and factors");
  }
  numbers.next("the number of lamps");
  numbers.next("the lumens per lamp");
  float factor = numbers.next("the multiplier");
  const auto height = static_cast<std::size_t>(numbers.whole("the number of vertical angles", 2, most));
  const auto width = static_cast<std::size_t>(numbers.whole("the number of horizontal angles", 1, most));
  if (width > scene::max_profile_values / height)
    numbers.fail(fmt::format("{} by {} angles are too many", height, width),
                 fmt::format("{} intensities are the most", scene::max_profile_values));
  const int type = numbers.whole("the photometric type", 1, 3);
  for (const char* what : {"the type of units", "the width", "the length", "the height"}) numbers.next(what);
  factor *= numbers.next("the ballast factor");
  factor *= numbers.next("the ballast-lamp factor");
  numbers.next("the input watts");
  if (!(factor > 0 && std::isfinite(factor)))
    numbers.fail(fmt::format("its multiplier times its ballast factors is {}", factor), "it must be above 0");
  const std::vector<float> vertical = numbers.list(height, "a vertical angle"),
                           horizontal = numbers.list(width, "a horizontal angle");
  std::vector<float> candela = numbers.list(height * width, "an intensity");
  if (numbers.more_numbers())
    numbers.fail(fmt::format("numbers follow the {} by {} intensities", height, width),
                 "the numbers of angles do not suit the table");
  for (float& value : candela) value *= factor;

  constexpr Photometry types[] = {Photometry::c, Photometry::b, Photometry::a};
  scene::PhotometricTable table;
  table.type = types[type - 1];
  const bool about_aim = table.type == Photometry::c;
  check_rising(vertical, about_aim ? 0 : -90, about_aim ? 180 : 90, "vertical angle", numbers);
  check_rising(horizontal, about_aim ? 0 : -90, about_aim ? 360 : 90, "horizontal angle", numbers);
  if (!about_aim && width == 1)
    numbers.fail("photometry of type A or B has one horizontal angle", "at least 2 are needed");
  const std::map<float, std::size_t> columns =
      about_aim ? all_around(horizontal, numbers) : both_sides(horizontal);
  std::vector<float> turns;
  for (const auto& [angle, unused] : columns) turns.push_back(angle);
  const auto from_pole = [](std::vector<float> angles) {
    for (float& angle : angles) angle += 90;
    return angles;
  };
  if (table.type == Photometry::b) {
    // Its pole is horizontal: the angles change places.
    table.polar = from_pole(turns), table.turn = vertical;
    for (std::size_t row = 0; row < height; ++row)
      for (const auto& [unused, column] : columns) table.candela.push_back(candela[column * height + row]);
  } else {
    table.polar = about_aim ? vertical : from_pole(vertical), table.turn = turns;
    for (const auto& [unused, column] : columns) {
      const auto begin = candela.begin() + static_cast<std::ptrdiff_t>(column * height);
      table.candela.insert(table.candela.end(), begin, begin + static_cast<std::ptrdiff_t>(height));
    }
  }
  scene::check_profile(table, where);
  return table;
}

scene::LampProfile read_ies(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, max_ies_bytes);
  return {path.filename().string(),
          std::make_shared<const scene::PhotometricTable>(ies_from_text(text, path.string()))};
}

std::string ies_to_text(const scene::LampProfile& profile) {
  const scene::PhotometricTable& table = *profile.table;
  std::string name;
  for (const char c : profile.name) name += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  std::vector<float> polar = table.polar;
  if (table.type != Photometry::c)
    for (float& angle : polar) angle -= 90;
  const bool b = table.type == Photometry::b;
  const std::vector<float>&vertical = b ? table.turn : polar, &horizontal = b ? polar : table.turn;
  const int type = 1 + static_cast<int>(table.type);
  std::string text =
      fmt::format("IESNA:LM-63-2002\n[LUMINAIRE] {}\n[OTHER] written by ssphh\nTILT=NONE\n", name);
  text += fmt::format("1 -1 1 {} {} {} 2 0 0 0\n1 1 0\n", vertical.size(), horizontal.size(), type);
  const auto append = [&](const std::vector<float>& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      text += fmt::format("{}{}", numbers[i], i + 1 == numbers.size() || i % 10 == 9 ? '\n' : ' ');
  };
  append(vertical), append(horizontal);
  const std::size_t rows = table.polar.size();
  for (std::size_t h = 0; h < horizontal.size(); ++h) {
    std::vector<float> column;
    for (std::size_t v = 0; v < vertical.size(); ++v)
      column.push_back(table.candela[b ? v * rows + h : h * rows + v]);
    append(column);
  }
  return text;
}

}  // namespace ssphh::scene_io
