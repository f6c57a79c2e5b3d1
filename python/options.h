// SPDX-License-Identifier: Apache-2.0
// Keyword arguments are the options of the command line: `sun_zenith_deg` is --sun-zenith-deg. The
// same code reads both, so that values, defaults and messages are the same.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::python {

// The values of each option as the command line spells them; a flag that is set has none.
using Options = std::map<std::string, std::vector<std::string>>;

// The keywords of a command's options, without those that are refused.
std::vector<std::string> keywords(const CLI::App& command,
                                  const std::map<std::string, std::string>& refused = {});

// Gives the command its options. Several values of an option become several uses where it may be
// repeated, else one list. Throws std::invalid_argument `call(): ...` for a name that the command
// does not know, or that `refused` lists with what to do instead; and what the command says of a
// value.
void parse(CLI::App& command, std::string_view call, const Options& options,
           const std::map<std::string, std::string>& refused = {});

}  // namespace skyfit::python
