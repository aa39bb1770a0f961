// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/exchange.hpp"

#include <numeric>

namespace bedscope::coupled {
namespace {

void all_to_all(MPI_Comm comm, const std::vector<double>& out, const std::vector<int>& out_count,
                std::vector<double>& in, const std::vector<int>& in_count, int width) {
  const std::size_t ranks = out_count.size();
  std::vector<int> counts(2 * ranks), offsets(2 * ranks);
  int sent = 0, received = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    counts[r] = out_count[r] * width;
    counts[ranks + r] = in_count[r] * width;
    offsets[r] = sent;
    offsets[ranks + r] = received;
    sent += counts[r];
    received += counts[ranks + r];
  }
  in.resize(received);
  MPI_Alltoallv(out.data(), counts.data(), offsets.data(), MPI_DOUBLE, in.data(),
                counts.data() + ranks, offsets.data() + ranks, MPI_DOUBLE, comm);
}

}  // namespace

Exchange::Exchange(MPI_Comm comm, const Vec3& mesh_low, const Vec3& mesh_high) : comm_(comm) {
  MPI_Comm_size(comm, &ranks_);
  std::vector<double> box(mesh_low.begin(), mesh_low.end());
  box.insert(box.end(), mesh_high.begin(), mesh_high.end());
  boxes_.resize(6 * ranks_);
  MPI_Allgather(box.data(), 6, MPI_DOUBLE, boxes_.data(), 6, MPI_DOUBLE, comm);
}

void Exchange::plan(int particles, const double* positions, const double* radii) {
  owned_ = copies_ = particles;
  if (alone()) return;
  sent_.clear();
  send_count_.assign(ranks_, 0);
  recv_count_.resize(ranks_);
  for (int r = 0; r < ranks_; ++r) {
    const double* box = &boxes_[6 * r];
    for (int i = 0; i < particles; ++i) {
      bool touches = true;
      for (int a = 0; a < 3; ++a)
        touches = touches && positions[3 * i + a] + radii[i] >= box[a] &&
                  positions[3 * i + a] - radii[i] <= box[3 + a];
      if (touches) sent_.push_back(i), ++send_count_[r];
    }
  }
  MPI_Alltoall(send_count_.data(), 1, MPI_INT, recv_count_.data(), 1, MPI_INT, comm_);
  copies_ = std::accumulate(recv_count_.begin(), recv_count_.end(), 0);
}

void Exchange::forward(const std::vector<double>& owned, std::vector<double>& copied,
                       int width) const {
  if (alone()) {
    copied = owned;
    return;
  }
  std::vector<double> out(sent_.size() * width);
  for (std::size_t n = 0; n < sent_.size(); ++n)
    for (int k = 0; k < width; ++k) out[n * width + k] = owned[std::size_t(sent_[n]) * width + k];
  all_to_all(comm_, out, send_count_, copied, recv_count_, width);
}

void Exchange::sum_back(const std::vector<double>& copied, std::vector<double>& owned,
                        int width) const {
  if (alone()) {
    owned = copied;
    return;
  }
  std::vector<double> in;
  all_to_all(comm_, copied, recv_count_, in, send_count_, width);
  owned.assign(std::size_t(owned_) * width, 0);
  for (std::size_t n = 0; n < sent_.size(); ++n)
    for (int k = 0; k < width; ++k) owned[std::size_t(sent_[n]) * width + k] += in[n * width + k];
}

}  // namespace bedscope::coupled
