// SPDX-License-Identifier: BSD-3-Clause
// One OpenFOAM file as one block, or a collated file (class decomposedBlockData) as one block a
// rank.
#pragma once

#include <cstddef>
#include <string>

#include "readers/openfoam_dictionary.hpp"

namespace bedscope::readers {

/// Opens the file and reads its header. A collated file holds `// Processor0`, a count of bytes and
/// `( bytes )` for each rank; most writers put the inner header into the first block only, so it
/// holds for all.
class FoamBlocks {
 public:
  explicit FoamBlocks(const std::string& path);

  /// Enters the next block; false behind the last. A plain file has one.
  /// Throws FormatError where the length of a block is not as declared.
  bool next();

  /// Leaves the block and proves its length by the closing parenthesis.
  void close();

  FoamStream& stream() { return stream_; }
  const FoamHeader& header() const { return header_; }  ///< of the data in this block
  bool collated() const { return collated_; }

 private:
  FoamStream stream_;
  FoamHeader header_;
  bool collated_ = false;
  bool open_ = false;
  std::size_t blocks_ = 0;   // entered
  std::uint64_t bytes_ = 0;  // of the open block
};

}  // namespace bedscope::readers
