#include <ssphh/core/nearest_word.h>

#include "property.h"

namespace ssphh::test {
namespace {

/// Few letters, so that words come near each other.
Generator<std::string> few_letters(int fewest, int most) {
  const Generator<std::vector<char>> letters = lists(one_of<char>({'a', 'b', 'c'}), fewest, most);
  return {[=](Pcg32& random) {
            const std::vector<char> word = letters.draw(random);
            return std::string(word.begin(), word.end());
          },
          [=](const std::string& word) {
            std::vector<std::string> result;
            for (const std::vector<char>& simpler : letters.simpler({word.begin(), word.end()}))
              result.emplace_back(simpler.begin(), simpler.end());
            return result;
          }};
}

/// Levenshtein's distance by its definition.
std::size_t edits(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  if (a.front() == b.front()) return edits(a.substr(1), b.substr(1));
  return 1 + std::min({edits(a.substr(1), b), edits(a, b.substr(1)), edits(a.substr(1), b.substr(1))});
}

TEST(NearestWordProperty, IsTheFirstOfThoseWithTheFewestEditsIfTheseAreFewEnough) {
  EXPECT_TRUE(for_all(few_letters(0, 6), lists(few_letters(0, 6), 0, 5))
                  .cases(200)
                  .holds([](const std::string& name, const std::vector<std::string>& candidates) {
                    std::string best;
                    std::size_t fewest = name.size() / 2;
                    bool found = false;
                    for (const std::string& candidate : candidates) {
                      const std::size_t distance = edits(name, candidate);
                      if (found ? distance < fewest : distance <= fewest)
                        best = candidate, fewest = distance, found = true;
                    }
                    const std::string nearest = nearest_word(name, candidates);
                    if (nearest == best) return testing::AssertionSuccess();
                    return testing::AssertionFailure() << '"' << nearest << "\", not \"" << best << '"';
                  }));
}

TEST(NearestWordProperty, AKnownWordIsItsOwnNearestAndTheHintQuotesIt) {
  EXPECT_TRUE(for_all(lists(few_letters(1, 6), 1, 5), seeds())
                  .cases(100)
                  .holds([](const std::vector<std::string>& words, std::uint64_t which) {
                    const std::string& word = words[which % words.size()];
                    return nearest_word(word, words) == word &&
                           nearest_hint(word, words) == "did you mean \"" + word + "\"?";
                  }));
}

}  // namespace
}  // namespace ssphh::test
