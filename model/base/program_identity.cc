// SPDX-License-Identifier: Apache-2.0
#include "model/base/program_identity.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include "model/base/content_hash.h"

namespace skyfit {
namespace {

// NT_GNU_BUILD_ID among the notes of a segment, in hexadecimal digits, or "".
std::string build_id_in(std::string_view notes) {
  constexpr std::size_t kPad = 4;
  const auto padded = [](std::size_t size) { return (size + kPad - 1) / kPad * kPad; };
  ElfW(Nhdr) note;
  while (notes.size() >= sizeof note) {
    std::memcpy(&note, notes.data(), sizeof note);
    const std::size_t name = sizeof note, text = name + padded(note.n_namesz);
    const std::size_t end = text + padded(note.n_descsz);
    if (end > notes.size()) return {};
    if (note.n_type == NT_GNU_BUILD_ID &&
        notes.substr(name, note.n_namesz) == std::string_view(ELF_NOTE_GNU, sizeof ELF_NOTE_GNU)) {
      std::string digits;
      for (const char byte : notes.substr(text, note.n_descsz))
        digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
      return digits;
    }
    notes.remove_prefix(end);
  }
  return {};
}

// An address, and the build of the loaded file that it lies in.
struct Search {
  ElfW(Addr) address;
  std::string build_id;
};

int look_into(dl_phdr_info* file, std::size_t, void* search_address) {
  auto& search = *static_cast<Search*>(search_address);
  bool holds = false;
  std::string build_id;
  for (ElfW(Half) i = 0; i < file->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = file->dlpi_phdr[i];
    const ElfW(Addr) begin = file->dlpi_addr + segment.p_vaddr;
    if (segment.p_type == PT_LOAD)
      holds |= search.address >= begin && search.address < begin + segment.p_memsz;
    if (segment.p_type == PT_NOTE && build_id.empty())
      build_id = build_id_in({reinterpret_cast<const char*>(begin), segment.p_memsz});
  }
  if (holds) search.build_id = build_id;
  return holds ? 1 : 0;
}

template <class Function>
std::string build_id_of(Function* function) {
  Search search{reinterpret_cast<ElfW(Addr)>(function), {}};
  dl_iterate_phdr(look_into, &search);
  return search.build_id;
}

// The line of /proc/cpuinfo that lists them: "flags" or, on ARM, "Features".
std::string processor_features() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("flags") || line.starts_with("Features")) return line;
  return {};
}

std::string identity() {
  const std::string program = build_id_of(&program_identity);
  const std::string library = build_id_of(static_cast<double (*)(double)>(&std::exp));
  const std::string processor = processor_features();
  if (program.empty() || library.empty() || processor.empty()) return {};
  ContentHash hash;
  hash.add(fmt::format("{}\n{}\n{}\n", program, library, processor));
  return hash.text();
}

}  // namespace

const std::string& program_identity() {
  static const std::string known = identity();
  return known;
}

}  // namespace skyfit
