// SPDX-License-Identifier: BSD-3-Clause
#include "validation/digitise/picture_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <vector>

#include "readers/error.hpp"

namespace bedscope::digitise {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes read_bytes(const std::filesystem::path& path) {
  std::error_code trouble;
  const auto size = std::filesystem::file_size(path, trouble);
  if (trouble || !std::filesystem::is_regular_file(path, trouble))
    throw FileError("{}: cannot be read: {}", path.string(),
                    trouble ? trouble.message() : "not a file");
  if (size > 2'000'000'000)
    throw FormatError("{}: expected a picture below 2 GB, found {} bytes", path.string(), size);
  Bytes bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    throw FileError("{}: cannot be read", path.string());
  return bytes;
}

std::uint32_t big_endian(const Bytes& bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
  return value;
}

bool starts_with(const Bytes& bytes, std::string_view magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char a, unsigned char b) { return static_cast<unsigned char>(a) == b; });
}

struct Declared {
  double width = 0, height = 0;
};

/// The size in a JPEG's start of frame; nothing where the file ends before it.
std::optional<Declared> jpeg_size(const Bytes& bytes) {
  for (std::size_t at = 2; at + 9 < bytes.size();) {
    if (bytes[at] != 0xFF) return std::nullopt;
    const int marker = bytes[at + 1];
    if (marker == 0xFF) {
      ++at;
      continue;
    }
    const bool frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame)
      return Declared{static_cast<double>(big_endian(bytes, at + 7, 2)),
                      static_cast<double>(big_endian(bytes, at + 5, 2))};
    at += 2 + big_endian(bytes, at + 2, 2);
  }
  return std::nullopt;
}

/// Both formats say where they end.
bool ends(const Bytes& bytes, bool jpeg) {
  const std::string_view end = jpeg ? std::string_view("\xFF\xD9", 2) : std::string_view("IEND", 4);
  const std::size_t tail = std::min<std::size_t>(bytes.size(), 4096);  // scanners append their own
  const std::string text(bytes.end() - static_cast<std::ptrdiff_t>(tail), bytes.end());
  return text.rfind(end) != text.npos;
}

/// The declared size against the bytes that are there: deflate packs at most 1032 to 1 (eight
/// pixels of one bit to a byte), a JPEG needs at least 6 bits for 256 pixels.
void check_size(const std::string& path, const Bytes& bytes, bool jpeg) {
  std::optional<Declared> declared;
  if (jpeg)
    declared = jpeg_size(bytes);
  else if (bytes.size() > 24)
    declared = Declared{static_cast<double>(big_endian(bytes, 16, 4)),
                        static_cast<double>(big_endian(bytes, 20, 4))};
  if (!declared)
    throw FormatError("{}: expected the size of a picture, found the end of the file", path);
  const double pixels = declared->width * declared->height;
  if (!(pixels > 0) || pixels > most_pixels)
    throw FormatError(
        "{}: expected a picture of up to {:.0f} million pixels, found {:.0f} x {:.0f}", path,
        most_pixels / 1e6, declared->width, declared->height);
  const double held = static_cast<double>(bytes.size()) * (jpeg ? 512 : 1032 * 8);
  if (pixels > held)
    throw FormatError(
        "{}: expected {:.0f} x {:.0f} pixels as declared, found {} bytes that cannot hold them",
        path, declared->width, declared->height, bytes.size());
  if (!ends(bytes, jpeg))
    throw CutError("{}: expected the picture's end mark, found the end of the file", path);
}

/// While it lives nothing is written to stderr: libpng and libjpeg say there what we say better.
class Silence {
 public:
  Silence() : kept_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere < 0) return;
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
  ~Silence() {
    if (kept_ < 0) return;
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int kept_;
};

/// Whether a JPEG has a block in which its orientation may be told (Exif 2.3, 4.5.4).
bool says_orientation(const Bytes& bytes) {
  const std::string_view mark("Exif\0\0", 6);
  return std::search(bytes.begin(), bytes.end(), mark.begin(), mark.end()) != bytes.end();
}

bool same_pixels(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

cv::Mat on_white(const cv::Mat& read) {
  cv::Mat eight = read, image;
  if (read.depth() == CV_16U) read.convertTo(eight, CV_8U, 1 / 257.0);
  if (eight.channels() == 3) return eight;
  if (eight.channels() == 1) {
    cv::merge(std::vector<cv::Mat>{eight, eight, eight}, image);
    return image;
  }
  image.create(eight.size(), CV_8UC3);
  for (int y = 0; y < eight.rows; ++y)
    for (int x = 0; x < eight.cols; ++x) {
      const auto p = eight.at<cv::Vec4b>(y, x);
      for (int c = 0; c < 3; ++c)
        image.at<cv::Vec3b>(y, x)[c] =
            static_cast<uchar>((p[c] * p[3] + 255 * (255 - p[3]) + 127) / 255);
    }
  return image;
}

}  // namespace

Picture read_picture(const std::filesystem::path& path) {
  const auto bytes = read_bytes(path);
  const bool png = starts_with(bytes, "\x89PNG\r\n\x1a\n"),
             jpeg = starts_with(bytes, "\xFF\xD8\xFF");
  if (!png && !jpeg)
    throw FormatError("{}: expected a PNG or JPEG picture, found something else", path.string());
  check_size(path.string(), bytes, jpeg);
  const auto read_as = [&](int flags) {
    try {
      const Silence silence;
      return cv::imdecode(bytes, flags);
    } catch (const cv::Exception&) {
      return cv::Mat();
    }
  };
  // As viewers show it: a JPEG of a camera or a scanner may say that it is to be turned.
  const cv::Mat read = read_as(jpeg ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED);
  if (read.empty() || (read.depth() != CV_8U && read.depth() != CV_16U) || read.channels() == 2)
    throw FormatError("{}: expected a {} picture, found damaged content", path.string(),
                      png ? "PNG" : "JPEG");
  const bool turned = jpeg && says_orientation(bytes) &&
                      !same_pixels(read, read_as(cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION));
  return {on_white(read), jpeg, turned};
}

std::string png_of(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace bedscope::digitise
