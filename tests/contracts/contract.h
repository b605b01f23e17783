#pragma once
/// The contracts of the library's public entries as tables: a row per entry and misuse that its types allow.

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>

#include "not_finite.h"

namespace ssphh::test {

/// `entry` and `given` together are the test's name: "Rotation" "OfAMatrixThatSkews".
struct Contract {
  std::string entry, given;
  std::function<void()> run;
};
inline void PrintTo(const Contract& row, std::ostream* out) {
  *out << row.entry << " " << row.given;
}

/// The call throws an Error that holds all of `words`.
inline void expect_refusal(const std::function<void()>& call, const std::vector<std::string>& words) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& e) {
    for (const std::string& word : words) EXPECT_THAT(e.what(), testing::HasSubstr(word));
  } catch (const std::exception& e) {
    ADD_FAILURE() << "threw no Error: " << e.what();
  }
}

inline Contract refuses(std::string entry, std::string given, std::function<void()> call,
                        std::vector<std::string> words) {
  return {std::move(entry), std::move(given),
          [call = std::move(call), words = std::move(words)] { expect_refusal(call, words); }};
}

/// For entries with state: after the refusal `as_before` looks whether the object that `make` made still does
/// what it did. `make` returns a pointer.
template <class Make, class Call, class AsBefore>
Contract refuses(std::string entry, std::string given, Make make, Call call, std::vector<std::string> words,
                 AsBefore as_before) {
  return {std::move(entry), std::move(given), [=] {
            const auto object = make();
            expect_refusal([&] { call(*object); }, words);
            as_before(*object);
          }};
}

/// What is documented as a result.
inline Contract gives(std::string entry, std::string given, std::function<void()> run) {
  return {std::move(entry), std::move(given), std::move(run)};
}

class ContractTest : public testing::TestWithParam<Contract> {};

}  // namespace ssphh::test

/// One test for each row of `rows`.
#define SSPHH_CONTRACTS(Module, rows)                                     \
  class Module##Contract : public ::ssphh::test::ContractTest {};         \
  TEST_P(Module##Contract, Holds) {                                       \
    GetParam().run();                                                     \
  }                                                                       \
  INSTANTIATE_TEST_SUITE_P(Of, Module##Contract, testing::ValuesIn(rows), \
                           [](const auto& row) { return row.param.entry + row.param.given; })
