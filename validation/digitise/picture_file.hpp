// SPDX-License-Identifier: BSD-3-Clause
// Pictures on disk: PNG and JPEG.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

namespace bedscope::digitise {

struct Picture {
  cv::Mat image;        ///< 8-bit BGR, as viewers show it; transparency laid on white
  bool lossy = false;   ///< a JPEG
  bool turned = false;  ///< turned or mirrored, as the file's EXIF orientation says
};

inline constexpr double most_pixels = 80e6;  ///< an A4 page at 600 dpi has 35e6

/// Throws FileError where the file cannot be read, FormatError where it is no PNG or JPEG, is cut
/// off, or declares more pixels than `most_pixels` or than its bytes can hold.
Picture read_picture(const std::filesystem::path& path);

/// The bytes of a PNG file.
std::string png_of(const cv::Mat& image);

}  // namespace bedscope::digitise
