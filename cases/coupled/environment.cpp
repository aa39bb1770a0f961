// SPDX-License-Identifier: GPL-3.0-or-later
// OpenFOAM's libraries look for their etc/ by WM_PROJECT_DIR while they are loaded, before main().
// Where it is not set the program starts itself once more with Debian's place.
#include <unistd.h>

#include <cstring>
#include <vector>

namespace {

void give_openfoam_its_folder(int, char** argv, char** environment) {
  static char folder[] = "WM_PROJECT_DIR=/usr/share/openfoam";
  std::vector<char*> all{folder};
  for (char** entry = environment; *entry; ++entry) {
    if (std::strncmp(*entry, "WM_PROJECT_DIR=", 15) == 0) return;
    all.push_back(*entry);
  }
  all.push_back(nullptr);
  execve("/proc/self/exe", argv, all.data());
}

// Runs before the constructors of shared libraries, which .init_array does not.
__attribute__((section(".preinit_array"),
               used)) void (*const before_libraries)(int, char**,
                                                     char**) = give_openfoam_its_folder;

}  // namespace
