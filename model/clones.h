// SPDX-License-Identifier: Apache-2.0
// SKYFIT_CLONES before a function compiles it for several instruction sets; the loader takes the
// best that the processor has, so that one binary runs on any x86-64.
#pragma once

// Sanitizers instrument the functions that choose a clone before they can run.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define SKYFIT_CLONES \
  __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define SKYFIT_CLONES
#endif
