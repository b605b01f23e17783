/// Dates, times and places as people write them.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <ssphh/core/parse_number.h>
#include <ssphh/scene/sun_position.h>

namespace ssphh::scene {
namespace {

/// The numbers of "17:30", parted by the sign; none where one of them is no number without a sign.
std::optional<std::vector<double>> parted(std::string_view text, char sign) {
  std::vector<double> numbers;
  for (std::size_t begin = 0;; ++begin) {
    const std::size_t end = std::min(text.find(sign, begin), text.size());
    const auto number = parse_number<double>(text.substr(begin, end - begin));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (end == text.size()) return numbers;
    begin = end;
  }
}

bool whole(double number) {
  return number == std::floor(number) && std::abs(number) < 1e6;
}

/// check_sun_time(), with the option's name.
void check_as(const SunTime& time, std::string_view text, const std::string& where) {
  try {
    check_sun_time(time);
  } catch (const Error& e) {
    throw Error(fmt::format("{} {}", where, text), e.what());
  }
}

}  // namespace

void read_date(SunTime& time, std::string_view text, const std::string& where) {
  const auto n = parted(text, '-');
  if (!n || n->size() != 3 || !whole((*n)[0]) || !whole((*n)[1]) || !whole((*n)[2]))
    throw Error(where, fmt::format("\"{}\" is no date", text), "write YEAR-MONTH-DAY, as 2026-06-21");
  time.year = static_cast<int>((*n)[0]), time.month = static_cast<int>((*n)[1]);
  time.day = static_cast<int>((*n)[2]);
  check_as(time, text, where);
}

double read_hour(std::string_view text, const std::string& where) {
  const auto n = parted(text, ':');
  const bool good = n && (n->size() == 2 || n->size() == 3) && whole((*n)[0]) && whole((*n)[1]) &&
                    (*n)[0] >= 0 && (*n)[1] >= 0 && (*n)[1] < 60 &&
                    (n->size() == 2 || ((*n)[2] >= 0 && (*n)[2] < 60));
  const double hour = good ? (*n)[0] + (*n)[1] / 60 + (n->size() == 3 ? (*n)[2] / 3600 : 0) : 25;
  if (!(hour <= 24))
    throw Error(where, fmt::format("\"{}\" is no time of day", text),
                "write HOUR:MINUTE, from 00:00 to 24:00");
  return hour;
}

void read_place(SunTime& time, std::string_view text, const std::string& where) {
  const auto n = parted(text, ',');
  if (!n || n->size() != 2)
    throw Error(where, fmt::format("\"{}\" is no place", text),
                "write LATITUDE,LONGITUDE in degrees, north and east positive, as 48.1,11.6");
  time.latitude = (*n)[0], time.longitude = (*n)[1];
  check_as(time, text, where);
}

std::string clock_text(double hour) {
  const int seconds = static_cast<int>(std::lround((hour > 24 ? hour - 24 : hour) * 3600));
  const std::string text = fmt::format("{:02}:{:02}", seconds / 3600, seconds / 60 % 60);
  return seconds % 60 == 0 ? text : fmt::format("{}:{:02}", text, seconds % 60);
}

}  // namespace ssphh::scene
