// SPDX-License-Identifier: BSD-3-Clause
#include "validation/tradeoff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/statistics.hpp"

namespace bedscope::validation {
namespace {

using analysis::BlockSum;
using analysis::half_blocks;
using analysis::ProductRange;
using analysis::VariantSums;
using analysis::window_blocks;
using Values = std::vector<double>;

constexpr double rounding = 1e-12;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr int most_parts = 4;  // a quarter of half the window is still two blocks
constexpr std::size_t no_block = window_blocks;

/// Consecutive blocks.
struct Blocks {
  std::size_t first = 0, count = 0;
};

BlockSum sum_over(const std::vector<BlockSum>& blocks, const Blocks& wanted, std::size_t left_out) {
  BlockSum total{0, Values(blocks.front().sum.size(), 0.)};
  for (std::size_t b = wanted.first; b < wanted.first + wanted.count; ++b) {
    if (b == left_out) continue;
    total.weight += blocks[b].weight;
    for (std::size_t k = 0; k < total.sum.size(); ++k) total.sum[k] += blocks[b].sum[k];
  }
  return total;
}

/// The error of one product where the setting has several ways: mean squares are collected.
struct Deviation {
  double squares = 0, ways = 0;
  void add(const Values& a, const Values& r, const ProductRange& product) {
    double sum = 0, points = 0, magnitude = 0, known = 0;
    for (std::size_t k = product.first; k < product.first + product.count; ++k) {
      if (!std::isfinite(r[k])) continue;
      magnitude += std::abs(r[k]);
      known += 1;
      if (!std::isfinite(a[k])) continue;
      sum += (a[k] - r[k]) * (a[k] - r[k]);
      points += 1;
    }
    if (known == 0) return;  // nothing to compare with
    const double mean = magnitude / known;
    if (points == 0)
      squares += 1;
    else if (sum > 0)
      squares += mean > 0 ? sum / points / (mean * mean) : 1;
    ways += 1;
  }
  double value() const { return ways > 0 ? std::sqrt(squares / ways) : undefined; }
};

/// The reference over some blocks, and without each of them.
struct Reference {
  Blocks blocks;
  std::vector<Values> without;  // the last: with all
};

class Errors {
 public:
  explicit Errors(const TradeoffRun& run) : run_(run) {
    for (const Blocks blocks :
         {Blocks{0, window_blocks}, Blocks{0, half_blocks}, Blocks{half_blocks, half_blocks}}) {
      Reference reference{blocks, {}};
      for (std::size_t b = 0; b <= blocks.count; ++b)
        reference.without.push_back(
            values(0, 0, blocks, b == blocks.count ? no_block : blocks.first + b));
      references_.push_back(std::move(reference));
    }
  }

  std::vector<ProductError> of(std::size_t variant, int every, int part) const {
    std::vector<ProductError> errors(run_.products.size());
    const std::array members{&ProductError::whole, &ProductError::first, &ProductError::second};
    for (std::size_t r = 0; r < references_.size(); ++r) {
      const auto found = over(references_[r], variant, every, part);
      for (std::size_t p = 0; p < errors.size(); ++p) errors[p].*members[r] = found[p];
    }
    return errors;
  }

  /// See Tradeoff::noise.
  std::vector<double> noise() const {
    std::vector<double> all;
    const auto& reference = references_.front();
    const auto& mean = reference.without.back();
    for (const auto& product : run_.products) {
      double squares = 0, magnitude = 0, points = 0;
      for (std::size_t k = product.first; k < product.first + product.count; ++k) {
        Values without;
        for (std::size_t b = 0; b < reference.blocks.count; ++b)
          without.push_back(reference.without[b][k]);
        const double half_width = jackknife(without);
        if (!std::isfinite(mean[k]) || !std::isfinite(half_width)) continue;
        squares += half_width * half_width;
        magnitude += std::abs(mean[k]);
        points += 1;
      }
      all.push_back(magnitude > 0 ? std::sqrt(squares / points) / (magnitude / points) : undefined);
    }
    return all;
  }

 private:
  Values values(std::size_t variant, std::size_t thinning, const Blocks& blocks,
                std::size_t left_out) const {
    const auto& sums = run_.sums.variants[variant];
    return analysis::values_of(sums.layout, sum_over(sums.sums[thinning], blocks, left_out),
                               run_.sums.variants.front().layout);
  }

  /// Half-width of the 95 % interval from the values without each block.
  static double jackknife(const Values& without) {
    const auto n = static_cast<double>(without.size());
    const double mean = std::accumulate(without.begin(), without.end(), 0.) / n;
    double squares = 0;
    for (const double value : without) squares += (value - mean) * (value - mean);
    return analysis::student_t(0.95, static_cast<int>(without.size()) - 1) *
           std::sqrt((n - 1) / n * squares);
  }

  std::vector<Estimate> over(const Reference& reference, std::size_t variant, int every,
                             int part) const {
    const auto& blocks = reference.blocks;
    const std::size_t length = blocks.count / static_cast<std::size_t>(part);
    const std::size_t products = run_.products.size();
    std::vector<Values> without(products);  // errors
    std::vector<Estimate> found(products);
    for (std::size_t b = 0; b <= blocks.count; ++b) {
      const std::size_t left_out = b == blocks.count ? no_block : blocks.first + b;
      std::vector<Deviation> deviations(products);
      for (std::size_t t = 0; t < run_.sums.thinnings.size(); ++t) {
        if (run_.sums.thinnings[t].every != every) continue;
        for (std::size_t at = blocks.first; at < blocks.first + blocks.count; at += length) {
          if (length == 1 && at == left_out) continue;
          const auto a = values(variant, t, {at, length}, left_out);
          for (std::size_t p = 0; p < products; ++p)
            deviations[p].add(a, reference.without[b], run_.products[p]);
        }
      }
      for (std::size_t p = 0; p < products; ++p)
        if (b < blocks.count)
          without[p].push_back(deviations[p].value());
        else
          found[p].value = deviations[p].value();
    }
    for (std::size_t p = 0; p < products; ++p) {
      found[p].ci95 = jackknife(without[p]);
      if (found[p].value < rounding) found[p] = {0, 0};
    }
    return found;
  }

  const TradeoffRun& run_;
  std::vector<Reference> references_;
};

std::string ordinal(int n) { return n == 2 ? "2nd" : n == 3 ? "3rd" : fmt::format("{}th", n); }

void take_larger(Estimate& worst, const Estimate& other) {
  if (!(worst.value >= other.value)) worst = other;  // also where none was known
}

/// The largest error of all runs that have the product.
void merge(std::vector<ProductError>& worst, const std::vector<std::string>& products,
           const TradeoffRun& run, const std::vector<ProductError>& errors) {
  for (std::size_t p = 0; p < run.products.size(); ++p) {
    const auto at = std::find(products.begin(), products.end(), run.products[p].name);
    auto& into = worst[static_cast<std::size_t>(at - products.begin())];
    take_larger(into.whole, errors[p].whole);
    take_larger(into.first, errors[p].first);
    take_larger(into.second, errors[p].second);
  }
}

std::vector<Setting> settings_of(std::span<const analysis::Variant> variants,
                                 const std::vector<int>& everies, int present_every) {
  std::vector<Setting> settings;
  for (std::size_t v = 0; v < variants.size(); ++v)
    for (const int every : everies)
      for (int part = 1; part <= most_parts; part *= 2) {
        if (!variants[v].candidate && (every > 1 || part > 1)) continue;
        Setting setting;
        setting.variant = v;
        setting.every = every;
        setting.part = part;
        setting.candidate = variants[v].candidate;
        setting.present = variants[v].present && every == present_every && part == 1;
        setting.name = variants[v].name;
        if (setting.candidate)
          setting.name += fmt::format(
              ", {}, {}", every == 1 ? "every snapshot" : "every " + ordinal(every) + " snapshot",
              part == 1 ? std::string("whole window") : fmt::format("1/{} of the window", part));
        settings.push_back(std::move(setting));
      }
  return settings;
}

/// Where there was nothing to compare with, nothing was lost.
bool within(const Estimate& error, double tolerance) {
  return std::isnan(error.value) || error.value == 0 || error.value + error.ci95 <= tolerance;
}

/// The cheapest candidate that passes; the finest choice, which has no error, always does.
template <class Passes>
std::size_t cheapest_that(const Tradeoff& tradeoff, const Passes& passes) {
  std::size_t best = 0;
  for (std::size_t s = 0; s < tradeoff.settings.size(); ++s)
    if (const auto& setting = tradeoff.settings[s];
        setting.candidate && setting.seconds < tradeoff.settings[best].seconds && passes(setting))
      best = s;
  return best;
}

bool holds(const Setting& setting, std::span<const std::size_t> products, double tolerance,
           Estimate ProductError::*half) {
  return std::all_of(products.begin(), products.end(),
                     [&](std::size_t p) { return within(setting.errors[p].*half, tolerance); });
}

}  // namespace

std::size_t Tradeoff::present() const {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [](const Setting& setting) { return setting.present; });
  return found == settings.end() ? 0 : static_cast<std::size_t>(found - settings.begin());
}

std::vector<bool> Tradeoff::front(std::size_t product) const {
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < settings.size(); ++s)
    if (settings[s].candidate && std::isfinite(settings[s].errors[product].whole.value))
      order.push_back(s);
  const auto error = [&](std::size_t s) { return settings[s].errors[product].whole.value; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return settings[a].seconds != settings[b].seconds ? settings[a].seconds < settings[b].seconds
                                                      : error(a) < error(b);
  });
  std::vector<bool> on_front(settings.size(), false);
  double least = std::numeric_limits<double>::infinity();
  for (const auto s : order) {
    if (!(error(s) < least)) continue;
    on_front[s] = true;
    least = error(s);
  }
  return on_front;
}

Tradeoff weigh(std::span<const TradeoffRun> runs, std::span<const analysis::Variant> variants,
               int present_every) {
  Tradeoff tradeoff;
  std::vector<int> everies;
  for (const auto& thinning : runs.front().sums.thinnings)
    if (thinning.phase == 0) everies.push_back(thinning.every);
  tradeoff.settings = settings_of(variants, everies, present_every);
  for (const auto& run : runs)
    for (const auto& product : run.products)
      if (std::find(tradeoff.products.begin(), tradeoff.products.end(), product.name) ==
          tradeoff.products.end())
        tradeoff.products.push_back(product.name);
  const auto products = tradeoff.products.size();
  tradeoff.noise.assign(products, undefined);
  for (auto& setting : tradeoff.settings) setting.errors.resize(products);
  for (const auto& run : runs) {
    const Errors errors(run);
    const auto noise = errors.noise();
    for (std::size_t p = 0; p < run.products.size(); ++p) {
      const auto at =
          std::find(tradeoff.products.begin(), tradeoff.products.end(), run.products[p].name);
      auto& most = tradeoff.noise[static_cast<std::size_t>(at - tradeoff.products.begin())];
      if (!(most >= noise[p])) most = noise[p];
    }
    for (auto& setting : tradeoff.settings) {
      merge(setting.errors, tradeoff.products, run,
            errors.of(setting.variant, setting.every, setting.part));
      const double snapshots =
          static_cast<double>(run.sums.window.snapshots) / (setting.every * setting.part);
      const auto& cost = run.costs[setting.variant];
      setting.seconds += snapshots * (cost.read + cost.products);
      setting.bytes += snapshots * cost.bytes;
    }
  }
  tradeoff.required.resize(products);
  std::iota(tradeoff.required.begin(), tradeoff.required.end(), std::size_t{0});
  return tradeoff;
}

std::size_t cheapest(const Tradeoff& tradeoff, std::span<const std::size_t> products) {
  return cheapest_that(tradeoff, [&](const Setting& setting) {
    return holds(setting, products, tradeoff.tolerance, &ProductError::first);
  });
}

std::size_t cheapest_on_both(const Tradeoff& tradeoff, std::span<const std::size_t> products) {
  return cheapest_that(tradeoff, [&](const Setting& setting) {
    return holds(setting, products, tradeoff.tolerance, &ProductError::first) &&
           holds(setting, products, tradeoff.tolerance, &ProductError::second);
  });
}

bool kept_promise(const Tradeoff& tradeoff, std::size_t setting,
                  std::span<const std::size_t> products) {
  return std::all_of(products.begin(), products.end(), [&](std::size_t p) {
    return !(tradeoff.settings[setting].errors[p].second.value > tradeoff.tolerance);
  });
}

Recommendation recommend(const Tradeoff& tradeoff) {
  Recommendation found;
  found.chosen = cheapest(tradeoff, tradeoff.required);
  found.kept = kept_promise(tradeoff, found.chosen, tradeoff.required);
  found.setting = found.kept ? found.chosen : cheapest_on_both(tradeoff, tradeoff.required);
  return found;
}

}  // namespace bedscope::validation
