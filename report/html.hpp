// SPDX-License-Identifier: BSD-3-Clause
// What every page of ours has: one style sheet, pictures inside the page, texts escaped.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "report/figures.hpp"

namespace bedscope::report {

/// "&lt;" for "<" and so on: a user's text as HTML or XML shows it, in text and in attributes.
std::string escaped(std::string_view text);

/// The page up to its heading, which is `title`; > 0: browsers load it again after so many seconds.
std::string page_head(const std::string& title, int refresh_seconds = 0);

/// A drawn figure of `folder` as a data URI: a picture of its own rather than SVG in the page, as
/// the names inside would clash. A figure of very many marks is smaller as PNG (`png`: there is
/// one). Throws FileError.
std::string picture(const Figure& figure, const std::filesystem::path& folder, bool png);

}  // namespace bedscope::report
