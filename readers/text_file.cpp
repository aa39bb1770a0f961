// SPDX-License-Identifier: BSD-3-Clause
#include "readers/text_file.hpp"

#include <algorithm>
#include <utility>

#include "readers/error.hpp"
#include "readers/source.hpp"

namespace bedscope::readers {

std::string read_text(const std::string& path, std::size_t most) {
  constexpr std::size_t piece = 1U << 16;
  Source source(path);
  const bool plain = !source.compressed();  // and read at once; who knows what others expand to
  std::string text;
  std::size_t got = 0,
              step = plain ? std::min<std::size_t>(source.size_bound(), most - 1) + 1 : piece;
  do {
    const auto have = text.size();
    text.resize(have + step);
    got = source.read({text.data() + have, step});
    text.resize(have + got);
    if (text.size() > most)
      throw FormatError("{}: a text of more than {} MB is not accepted", path, most >> 20);
  } while (got == std::exchange(step, piece));
  if (!source.cut().empty()) throw CutError("{}: {}", path, source.cut());
  return text;
}

}  // namespace bedscope::readers
