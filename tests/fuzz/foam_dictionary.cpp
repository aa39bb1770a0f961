// SPDX-License-Identifier: BSD-3-Clause
// Dictionaries of OpenFOAM: controlDict, uniform/time; and boundary, a list of dictionaries.
#include "readers/error.hpp"
#include "readers/openfoam_dictionary.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

void look_up(const FoamDictionary& dictionary, const std::string& where) {
  for (const auto& entry : dictionary.entries) {
    require(dictionary.find(entry.keyword) != nullptr, "an entry is found by its name");
    try {
      dictionary.value(entry.keyword, where);
    } catch (const Error& error) {
      require_line(error.what());
    }
    for (const auto& nested : entry.nested) look_up(nested, where);
  }
}

}  // namespace

void use(std::string_view input) {
  static MemoryFile file;
  const auto& path = file.write(input);
  try {
    FoamStream stream(path);
    read_header(stream);
    look_up(read_named_list(stream), path);
  } catch (const Error& error) {
    require_line(error.what());
  }
  look_up(read_dictionary(path), path);
}

}  // namespace bedscope::fuzz
