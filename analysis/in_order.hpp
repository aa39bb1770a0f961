// SPDX-License-Identifier: BSD-3-Clause
// Work on the members of a series in parallel, its results taken in order: the only file that knows
// of threads.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace bedscope::analysis {

/// 0: as many as the machine has cores.
inline int thread_count(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls make(i, item) for each i in [first, last), in parallel on items of their own, and
/// take(item) in order.
template <class Made, class Make, class Take>
void for_each_in_order(std::size_t first, std::size_t last, int threads, Make&& make, Take&& take) {
  struct Job {
    Made item;
    std::exception_ptr error;
  };
  const auto make_job = [&](std::size_t i, Job& job) {
    try {
      make(i, job.item);
    } catch (...) {  // thrown again in the order of the series, whoever met it first
      job.error = std::current_exception();
    }
  };
  const auto deliver = [&](Job& job) {
    if (job.error) std::rethrow_exception(job.error);
    take(job.item);
  };
  if (threads == 1 || last - first < 2) {
    Job job;
    for (std::size_t i = first; i < last; ++i) {
      make_job(i, job);
      deliver(job);
    }
    return;
  }
  // Each thread takes the next snapshot and makes its product; whoever finishes the one whose turn
  // it is hands over all that are ready. One product more than threads, so that nobody waits for a
  // slow neighbour.
  std::vector<Job> items(static_cast<std::size_t>(threads) + 1);
  std::vector<Job*> idle;
  idle.reserve(items.size());
  for (auto& item : items) idle.push_back(&item);
  std::map<std::size_t, Job*> ready;
  std::mutex mutex;
  std::condition_variable delivered;
  std::size_t next = first, turn = first;
  std::exception_ptr failure;
  const auto work = [&] {
    std::unique_lock lock(mutex);
    while (true) {
      delivered.wait(lock, [&] { return !idle.empty() || next == last || failure; });
      if (next == last || failure) return;
      const std::size_t i = next++;
      Job* const item = idle.back();
      idle.pop_back();
      lock.unlock();
      make_job(i, *item);
      lock.lock();
      ready[i] = item;
      try {
        for (; !failure && !ready.empty() && ready.begin()->first == turn; ++turn) {
          idle.push_back(ready.begin()->second);
          ready.erase(ready.begin());
          deliver(*idle.back());
        }
      } catch (...) {
        failure = std::current_exception();
      }
      delivered.notify_all();
    }
  };
  {
    std::vector<std::jthread> team;
    team.reserve(static_cast<std::size_t>(threads));
    for (int k = 0; k < threads; ++k) team.emplace_back(work);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace bedscope::analysis
