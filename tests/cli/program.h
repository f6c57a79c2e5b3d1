// SPDX-License-Identifier: Apache-2.0
// Runs the program in a folder of its own, the way a user does.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "model/base/temporary_directory.h"

namespace skyfit::cli {

struct Outcome {
  int status = -1;  // exit status, or -1 when a signal ended it
  std::string out, err;
};

class ProgramTest : public ::testing::Test {
 protected:
  // Runs the program with the folder as its working directory and caches that no user has.
  // `environment` holds NAME=VALUE to add; `out` is the file that takes stdout instead of
  // Outcome::out, `in` the one that stdin reads.
  Outcome run(const std::vector<std::string>& arguments,
              const std::vector<std::string>& environment = {}, const std::string& out = {},
              const std::string& in = "/dev/null") const;

  // Runs and expects success without a word on stderr; returns stdout.
  std::string output(const std::vector<std::string>& arguments) const;

  // Asserts that the program refuses: one line on stderr that contains every text, a status that is
  // not 0, nothing on stdout, and no file more or less than before.
  void expect_refusal(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& texts) const;

  std::filesystem::path write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  std::set<std::string> files() const;  // everything below the folder

  const TemporaryDirectory working_, collected_;
  const std::filesystem::path folder_ = working_.path();     // the program's working directory
  const std::filesystem::path capture_ = collected_.path();  // where its output is collected
};

// The first line, and the lines, of a text.
std::vector<std::string> lines(const std::string& text);

// A CSV's fields of one line.
std::vector<std::string> fields(const std::string& line);

}  // namespace skyfit::cli
