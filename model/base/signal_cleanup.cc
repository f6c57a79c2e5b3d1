// SPDX-License-Identifier: Apache-2.0
#include "model/base/signal_cleanup.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>

#include "model/base/temporary_directory.h"

namespace skyfit {
namespace {

struct Slot {
  std::atomic<int> state{0};  // 0 free, 1 being written, 2 holds a path
  pid_t owner = 0;            // a forked child must not remove what its parent uses
  std::array<char, 1024> path;
};

std::array<Slot, 64> slots;
std::atomic<pid_t> running_child{0};

// What getdents64(2) writes.
struct DirectoryEntry {
  std::uint64_t inode;
  std::int64_t offset;
  unsigned short length;
  unsigned char type;
  char name[1];
};

// Removes what is in an open directory by system calls alone, for opendir(3) may not be called in a
// signal handler. Links are removed, not followed.
void empty_directory(int directory, int depth) {
  constexpr int kDeepest = 16;
  alignas(DirectoryEntry) char buffer[4096];
  for (;;) {
    const long size = syscall(SYS_getdents64, directory, buffer, sizeof buffer);
    if (size <= 0) return;
    for (long at = 0; at < size;) {
      const auto* const entry = reinterpret_cast<const DirectoryEntry*>(buffer + at);
      at += entry->length;
      const char* const name = buffer + (entry->name - buffer);
      if (std::strcmp(name, ".") == 0 || std::strcmp(name, "..") == 0) continue;
      if (unlinkat(directory, name, 0) == 0 || depth == kDeepest) continue;
      const int inner = openat(directory, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
      if (inner < 0) continue;
      empty_directory(inner, depth + 1);
      close(inner);
      unlinkat(directory, name, AT_REMOVEDIR);
    }
  }
}

void remove_tree(const char* path) {
  // Another thread may still be writing: what it adds goes in the next round.
  for (int round = 0; round < 3; ++round) {
    const int directory = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (directory < 0) return;
    empty_directory(directory, 0);
    close(directory);
    if (rmdir(path) == 0) return;
  }
}

void end_program(int signal) {
  if (const pid_t child = running_child.load(); child > 0) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  for (Slot& slot : slots)
    if (slot.state.load() == 2 && slot.owner == getpid()) remove_tree(slot.path.data());
  _exit(128 + signal);
}

}  // namespace

namespace signal_cleanup {

int add_directory(const char* absolute_path) {
  const std::size_t length = std::strlen(absolute_path);
  for (std::size_t i = 0; i < slots.size() && length < slots[i].path.size(); ++i) {
    int free = 0;
    if (!slots[i].state.compare_exchange_strong(free, 1)) continue;
    slots[i].owner = getpid();
    std::memcpy(slots[i].path.data(), absolute_path, length + 1);
    slots[i].state.store(2);
    return static_cast<int>(i);
  }
  return -1;
}

void remove_directory(int place) {
  if (place >= 0) slots[static_cast<std::size_t>(place)].state.store(0);
}

void set_child(pid_t child) { running_child.store(child); }

}  // namespace signal_cleanup

void clean_up_on_signals() {
  struct sigaction action = {};
  action.sa_handler = end_program;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  ::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace skyfit
