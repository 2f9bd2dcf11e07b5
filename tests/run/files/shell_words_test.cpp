// SPDX-FileCopyrightText: The Vesiflow authors
// SPDX-License-Identifier: BSD-3-Clause
#include "files/shell_words.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <vector>

namespace vesiflow::run::shell_words_test {
namespace {

std::string line_of(std::vector<std::string> words) {
  return shell_line(words);
}

TEST(ShellWords, AreQuotedOnlyWhereTheyMustBe) {
  EXPECT_EQ(line_of({"build/release/apps/vesicles", "--restart", "out/run_1/checkpoint.h5", "--set=time.end=3"}),
            "build/release/apps/vesicles --restart out/run_1/checkpoint.h5 --set=time.end=3");
  EXPECT_EQ(line_of({"a b", "it's", ""}), "'a b' 'it'\\''s' ''");
}

TEST(ShellWords, AreWhatAShellMakesOfTheLine) {
  const std::vector<std::string> words{"printf", "<%s>", "$HOME", "`ls`", "a;b&c|d", "*", "~", "\"x\"", "\\", "'", "ü"};
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> shell(popen(shell_line(words).c_str(), "r"), pclose);
  std::array<char, 256> text{};
  const std::size_t size = std::fread(text.data(), 1, text.size(), shell.get());
  EXPECT_EQ(std::string(text.data(), size), "<$HOME><`ls`><a;b&c|d><*><~><\"x\"><\\><'><ü>");
}

}  // namespace
}  // namespace vesiflow::run::shell_words_test
