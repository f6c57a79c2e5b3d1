// SPDX-License-Identifier: Apache-2.0
// What the handler of a signal that ends the program must know: see temporary_directory.h.
#pragma once

#include <sys/types.h>

namespace skyfit::signal_cleanup {

// The place of a directory in the list, or -1 where the path is too long or the list is full; then
// a signal leaves it to the next run.
int add_directory(const char* absolute_path);
void remove_directory(int place);

void set_child(pid_t child);  // 0: none

}  // namespace skyfit::signal_cleanup
