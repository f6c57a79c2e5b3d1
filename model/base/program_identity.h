// SPDX-License-Identifier: Apache-2.0
// Which program computes here, for results that are kept and read by other processes.
#pragma once

#include <string>

namespace skyfit {

// The same where the same input gives the same bits: the build of the program or module that holds
// this code and of the mathematical library, by the identifiers that the linker gave them (ELF note
// NT_GNU_BUILD_ID), and the processor's features, by which both choose their code. "" where a build
// has no such identifier.
const std::string& program_identity();

}  // namespace skyfit
