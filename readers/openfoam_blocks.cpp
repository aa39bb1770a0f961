// SPDX-License-Identifier: BSD-3-Clause
#include "readers/openfoam_blocks.hpp"

#include "readers/numbers.hpp"

namespace bedscope::readers {

FoamBlocks::FoamBlocks(const std::string& path) : stream_(path), header_(read_header(stream_)) {
  collated_ = header_.class_name == "decomposedBlockData";
}

void FoamBlocks::close() {
  if (!open_) return;
  stream_.leave();
  open_ = false;
  if (stream_.take(')')) return;
  if (stream_.peek() == '\0')
    throw CutError("{}: block {}: expected \")\" after {} bytes, found end of file", stream_.path(),
                   blocks_ - 1, bytes_);
  throw FormatError("{}: block {}: expected \")\" after {} bytes, found {}", stream_.path(),
                    blocks_ - 1, bytes_, stream_.found());
}

bool FoamBlocks::next() {
  if (!collated_) return blocks_++ == 0;
  close();
  const auto count = stream_.next();
  if (count.at_end()) return false;
  std::int64_t bytes = 0;
  bool overflow = false;
  if (!parse_integer(count.text, bytes, overflow) || bytes < 0)
    stream_.fail(count.offset, "block {}: expected its number of bytes, found \"{}\"", blocks_,
                 count.text);
  stream_.expect('(', fmt::format("the length of block {}", blocks_));
  bytes_ = static_cast<std::uint64_t>(bytes);
  if (bytes_ > stream_.left())
    stream_.fail_cut("block {}: {} bytes declared, the file ends after {}", blocks_, bytes_,
                     stream_.left());
  stream_.enter(bytes_);
  open_ = true;
  const bool first = blocks_++ == 0;
  const auto inner = read_header(stream_);
  if (inner.present || first)
    header_ = inner;
  else
    header_.note.clear();  // of the first block's own numbers
  return true;
}

}  // namespace bedscope::readers
