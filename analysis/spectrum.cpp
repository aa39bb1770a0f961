// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/spectrum.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

namespace bedscope::analysis {
namespace {

constexpr std::size_t most_segments = 8;
constexpr double least_periods = 5;

std::vector<double> hann(std::size_t length) {
  std::vector<double> window(length);
  for (std::size_t n = 0; n < length; ++n)
    window[n] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(n) /
                                     static_cast<double>(length));
  return window;
}

/// The segment less its least-squares line, times the window.
std::vector<double> prepared(std::span<const double> segment, const std::vector<double>& window) {
  const auto n = static_cast<double>(segment.size());
  const double middle = (n - 1) / 2;
  double mean = 0, slope = 0;
  for (const double x : segment) mean += x / n;
  for (std::size_t i = 0; i < segment.size(); ++i)
    slope += (static_cast<double>(i) - middle) * (segment[i] - mean);
  slope *= 12 / (n * (n * n - 1));
  std::vector<double> result(segment.size());
  for (std::size_t i = 0; i < segment.size(); ++i)
    result[i] = window[i] * (segment[i] - mean - slope * (static_cast<double>(i) - middle));
  return result;
}

double sum_of_products(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += a[i] * b[i];
  return sum;
}

/// The largest even number of factors 2, 3, 5 up to `most`: lengths for which a transform is fast.
std::size_t smooth_length(std::size_t most) {
  for (std::size_t length = most / 2 * 2; length > 2; length -= 2) {
    std::size_t rest = length;
    for (const std::size_t factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
  return 2;
}

std::size_t largest(const Spectrum& spectrum) {
  const auto& density = spectrum.density;
  return static_cast<std::size_t>(std::max_element(density.begin() + 1, density.end()) -
                                  density.begin());
}

/// P(a, x), the regularised lower incomplete gamma function.
double incomplete_gamma(double a, double x) {
  double term = std::exp(a * std::log(x) - x - std::lgamma(a + 1)), sum = term;
  for (double k = a + 1; term > 1e-17 * sum; ++k) sum += term *= x / k;
  return sum;
}

}  // namespace

Spectrum welch(std::span<const double> values, double step, std::size_t length) {
  assert(length >= 4 && length % 2 == 0 && length <= values.size() && step > 0);
  [[maybe_unused]] static const bool serial = (cv::setNumThreads(0), true);
  const auto window = hann(length);
  const double power = sum_of_products(window, window);
  Spectrum spectrum;
  spectrum.density.assign(length / 2 + 1, 0);
  for (std::size_t first = 0; first + length <= values.size(); first += length / 2) {
    auto segment = prepared(values.subspan(first, length), window);
    cv::Mat parts;
    cv::dft(cv::Mat(1, static_cast<int>(length), CV_64F, segment.data()), parts,
            cv::DFT_COMPLEX_OUTPUT);
    for (std::size_t k = 0; k <= length / 2; ++k) {
      const auto part = parts.at<cv::Vec2d>(0, static_cast<int>(k));
      spectrum.density[k] += part[0] * part[0] + part[1] * part[1];
    }
    ++spectrum.segments;
  }

  const double segments = spectrum.segments;
  const double overlap = sum_of_products(window, std::span(window).subspan(length / 2)) / power;
  spectrum.degrees_of_freedom =
      2 * segments / (1 + 2 * (segments - 1) / segments * overlap * overlap);
  spectrum.resolution = 1 / (static_cast<double>(length) * step);
  const auto bounds = [](double degrees) {
    return std::pair{degrees / chi_squared(0.975, degrees), degrees / chi_squared(0.025, degrees)};
  };
  const auto inner = bounds(spectrum.degrees_of_freedom);
  const auto edge = bounds(spectrum.degrees_of_freedom / 2);
  for (std::size_t k = 0; k <= length / 2; ++k) {
    const bool real = k == 0 || k == length / 2;
    spectrum.density[k] *= (real ? 1 : 2) * step / (segments * power);
    spectrum.frequency.push_back(static_cast<double>(k) * spectrum.resolution);
    spectrum.low.push_back(spectrum.density[k] * (real ? edge : inner).first);
    spectrum.high.push_back(spectrum.density[k] * (real ? edge : inner).second);
  }
  return spectrum;
}

std::size_t segment_length(std::span<const double> values) {
  const std::size_t whole = smooth_length(values.size());
  const auto peak = static_cast<double>(largest(welch(values, 1, whole)));  // periods in the record
  for (std::size_t segments = most_segments; segments > 1; --segments) {
    const std::size_t length = smooth_length(2 * values.size() / (segments + 1));
    if (length >= least_record &&
        peak * static_cast<double>(length) >= least_periods * static_cast<double>(whole))
      return length;
  }
  return whole;
}

Estimate dominant_frequency(const Spectrum& spectrum) {
  const auto& density = spectrum.density;
  const std::size_t peak = largest(spectrum);
  if (!(density[peak] > 0)) return {};
  double place = 0;
  if (peak + 1 < density.size() && density[peak - 1] > 0 && density[peak + 1] > 0) {
    const double before = std::log(density[peak - 1] / density[peak]);
    const double after = std::log(density[peak + 1] / density[peak]);
    if (before + after < 0)
      place = std::clamp((before - after) / (2 * (before + after)), -0.5, 0.5);
  }
  std::size_t first = peak, last = peak;
  while (first > 1 && density[first - 1] >= spectrum.low[peak]) --first;
  while (last + 1 < density.size() && density[last + 1] >= spectrum.low[peak]) ++last;
  return {(static_cast<double>(peak) + place) * spectrum.resolution,
          std::max(1., static_cast<double>(last - first) / 2) * spectrum.resolution};
}

double chi_squared(double probability, double degrees_of_freedom) {
  const double a = degrees_of_freedom / 2;
  double low = 0, high = degrees_of_freedom + 10 * std::sqrt(degrees_of_freedom) + 30;
  while (high - low > 1e-12 * high) {
    const double middle = (low + high) / 2;
    (incomplete_gamma(a, middle / 2) < probability ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace bedscope::analysis
