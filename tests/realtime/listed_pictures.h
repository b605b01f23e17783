#pragma once
/// Pictures against a file of the tree that says what each of their pixels was.

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/image.h>

#include "places.h"

namespace ssphh::test {

class ListedPictures {
 public:
  /// Sums are taken in another order by another driver.
  static constexpr double of_drivers = 2e-4;

  /// One number stands for the colours of a pixel, which have weights of their own in it; each may differ by
  /// `slack` of itself and 2e-5 of the picture's mean.
  void add(const std::string& name, const image::Image& picture, double slack = of_drivers) {
    Listed& listed = pictures_.emplace_back(Listed{name, picture.width, slack, {}});
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x)
        listed.values.push_back(static_cast<double>(glm::dot(picture.rgb(x, y), vec3(1, 0.6f, 0.3f))));
    }
  }

  /// `file`: below the root of the tree. SSPHH_UPDATE_EXPECTED=1 in the environment writes it anew, for a
  /// change that is meant.
  void expect(const std::string& file) const {
    const std::filesystem::path path = source_dir() / file;
    if (std::getenv("SSPHH_UPDATE_EXPECTED") != nullptr) write_file(path, text());
    ASSERT_TRUE(std::filesystem::exists(path)) << file << " as it would be:\n" << text();
    std::istringstream lines(read_text_file(path));
    for (const Listed& listed : pictures_) {
      std::string name;
      std::getline(lines, name);
      EXPECT_EQ(name, listed.name) << file;
      std::vector<double> before(listed.values.size());
      for (double& value : before) lines >> value;
      ASSERT_TRUE(lines) << file << " ends in " << listed.name;
      lines.ignore(1);
      expect_same(listed, before);
    }
  }

 private:
  struct Listed {
    std::string name;
    int width;
    double slack;
    std::vector<double> values;
  };

  static void expect_same(const Listed& listed, const std::vector<double>& before) {
    double mean = 0;
    for (const double value : before) mean += std::abs(value) / static_cast<double>(before.size());
    EXPECT_GT(mean, 0) << listed.name << " shows nothing";
    int off = 0;
    std::string first;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (std::abs(listed.values[i] - before[i]) <= listed.slack * std::abs(before[i]) + 2e-5 * mean)
        continue;
      if (off++ == 0) first = fmt::format("{} was {}, is {}", i, before[i], listed.values[i]);
    }
    EXPECT_EQ(off, 0) << "pixels of " << listed.name << " are not what they were; the first: " << first;
  }
  std::string text() const {
    std::string out;
    for (const Listed& listed : pictures_) {
      out += listed.name + "\n";
      for (std::size_t i = 0; i < listed.values.size(); ++i)
        out += fmt::format("{:.5g}{}", listed.values[i],
                           (i + 1) % static_cast<std::size_t>(listed.width) == 0 ? '\n' : ' ');
    }
    return out;
  }

  std::vector<Listed> pictures_;
};

}  // namespace ssphh::test
