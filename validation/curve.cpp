// SPDX-License-Identifier: BSD-3-Clause
#include "validation/curve.hpp"

namespace bedscope::validation {

Title parse_title(std::string_view text) {
  const auto open = text.rfind('[');
  if (open == text.npos || !text.ends_with(']')) return {std::string(text), ""};
  auto name = text.substr(0, open);
  while (name.ends_with(' ')) name.remove_suffix(1);
  return {std::string(name), std::string(text.substr(open + 1, text.size() - open - 2))};
}

}  // namespace bedscope::validation
