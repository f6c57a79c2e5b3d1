// SPDX-License-Identifier: Apache-2.0
// SKYFIT_CLONES before a function compiles it for several instruction sets; the one that the
// processor has is chosen when the program is loaded, so that one binary runs everywhere.
#pragma once

// Levels of x86-64 are chosen by features; the names of processors would fit those processors only.
// Sanitizers instrument the functions that choose a clone before they can run.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define SKYFIT_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SKYFIT_CLONES
#endif
