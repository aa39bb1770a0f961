// SPDX-License-Identifier: BSD-3-Clause
// The entries of OpenFOAM files: header, values, nested dictionaries, macros and #include.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readers/openfoam_stream.hpp"

namespace bedscope::readers {

/// What `FoamFile { ... }` says. `present` is false where a file has none (surface samples).
struct FoamHeader {
  bool present = false;
  bool binary = false;
  std::string class_name;  ///< volScalarField, labelList ...
  std::string note;        ///< "nPoints:462 nCells:200 ..." of owner and neighbour
  std::string arch;        ///< "LSB;label=32;scalar=64"; empty where not said
};

/// One entry. A value is kept as text, its words separated by single blanks; patterns
/// ("(inlet|outlet)") are keywords like any other.
struct FoamDictionary {
  struct Entry;
  std::vector<Entry> entries;             ///< in the order of the file; the last of a name holds
  std::vector<std::string> not_followed;  ///< directives that are never run, macros as keywords

  /// The entry of this name, or null.
  const Entry* find(std::string_view name) const;
  /// Its value with macros put in; nothing where it is absent or a dictionary. Throws FormatError
  /// naming the macro that is not defined in the file.
  std::optional<std::string> value(std::string_view name, const std::string& where) const;
  /// The dictionary of this name, or null.
  const FoamDictionary* dictionary(std::string_view name) const;
};

struct FoamDictionary::Entry {
  std::string keyword;
  std::string value;
  std::vector<FoamDictionary> nested;  ///< one for a dictionary, none for a value
};

/// Reads the header if the file begins with one. Throws FormatError for a format that is neither
/// ascii nor binary.
FoamHeader read_header(FoamStream& stream);

/// Puts values in for $name and ${name} (with path: $sub.name, $:name). The text grows to 1 MB at
/// most.
std::string expand_macros(std::string_view text, const FoamDictionary& dictionary,
                          const std::string& where);

/// Reads the entries of a file one by one, so that large values can be taken by the caller.
class FoamEntries {
 public:
  explicit FoamEntries(FoamStream& stream);

  /// The next keyword that is not a directive; `at_end()` at the end of the file. Directives are
  /// followed on the way: the entries of an included file go into `dictionary`.
  FoamToken keyword(FoamDictionary& dictionary);
  /// Reads what follows a keyword, a value or a dictionary, into `dictionary`.
  void entry(const FoamToken& keyword, FoamDictionary& dictionary);
  /// Reads the rest of the file.
  void all(FoamDictionary& dictionary);
  /// Reads the header, as `read_header` does.
  FoamHeader header();

 private:
  FoamEntries(FoamStream& stream, std::vector<std::string> chain);
  void nested(FoamDictionary& dictionary, int depth);
  void entry(const FoamToken& keyword, FoamDictionary& dictionary, int depth);
  void follow(const FoamToken& directive, FoamDictionary& dictionary);
  std::string value_text(const FoamToken& keyword);

  FoamStream* stream_;
  std::vector<std::string> chain_;  // the files that include one another down to this one
};

/// Header and entries of a small file (uniform/time, controlDict); of a collated one, its first
/// block.
FoamDictionary read_dictionary(const std::string& path);

/// Reads `N ( name { ... } name { ... } )`, as constant/polyMesh/boundary has it.
FoamDictionary read_named_list(FoamStream& stream);

}  // namespace bedscope::readers
