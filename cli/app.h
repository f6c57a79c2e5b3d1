// SPDX-License-Identifier: Apache-2.0
// The program `skyfit`.
#pragma once

namespace skyfit::cli {

// Runs the command line. Returns the exit status: 0 on success, 1 when the command fails, 2 when
// the command line cannot be understood; every failure is one line `skyfit: error: ...` on stderr.
int run(int argc, char** argv);

}  // namespace skyfit::cli
