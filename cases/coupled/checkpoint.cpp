// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/coupled/checkpoint.hpp"

#include <charconv>
#include <filesystem>
#include <fstream>

#include "cases/coupled/bad_input.hpp"

namespace fs = std::filesystem;

namespace bedscope::coupled {
namespace {

const fs::path folder = "checkpoint";
const fs::path unfinished = folder / "unfinished";

// The highest number among the complete ones; empty where there is none.
fs::path latest() {
  long best = -1;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      long step = -1;
      const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), step);
      if (error == std::errc() && end == name.data() + name.size()) best = std::max(best, step);
    }
  return best < 0 ? fs::path() : folder / std::to_string(best);
}

int rank_of(MPI_Comm comm) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

std::string gas_file(MPI_Comm comm) { return "gas." + std::to_string(rank_of(comm)); }

struct File {
  std::FILE* handle;
  File(const fs::path& path, const char* mode) : handle(std::fopen(path.c_str(), mode)) {
    if (!handle) throw BadInput(path.string() + ": cannot be opened");
  }
  ~File() { std::fclose(handle); }
  File(const File&) = delete;
};

nlohmann::json as_json(const FeedState& state) {
  nlohmann::json waiting = nlohmann::json::array();
  for (const NewParticle& p : state.waiting) waiting.push_back({p.type, p.diameter, p.density});
  return {{"draws", state.draws},
          {"due", state.due},
          {"left", state.left},
          {"entered", state.entered},
          {"mass_left", state.mass_left},
          {"mass_entered", state.mass_entered},
          {"waiting", waiting}};
}

FeedState feed_state(const nlohmann::json& json) {
  FeedState state{json.at("draws"),
                  json.at("due"),
                  json.at("left"),
                  json.at("entered"),
                  json.at("mass_left"),
                  json.at("mass_entered"),
                  {}};
  for (const auto& p : json.at("waiting")) state.waiting.push_back({p[0], p[1], p[2], {}, {}});
  return state;
}

}  // namespace

bool has_checkpoint() { return !latest().empty(); }

void save_checkpoint(MPI_Comm comm, const Gas& gas, Dem& dem, const Feed& feed,
                     const nlohmann::json& record) {
  const bool first = rank_of(comm) == 0;
  if (first) {
    fs::remove_all(unfinished);
    fs::create_directories(unfinished);
  }
  MPI_Barrier(comm);
  dem.write_restart((unfinished / "dem.restart").string());
  {
    const File file(unfinished / gas_file(comm), "wb");
    gas.save(file.handle);
    if (std::ferror(file.handle)) throw BadInput("checkpoint: the disk does not take it");
  }
  if (first) {
    int ranks;
    MPI_Comm_size(comm, &ranks);
    std::ofstream(unfinished / "state.json")
        << nlohmann::json{{"ranks", ranks}, {"feed", as_json(feed.state)}, {"record", record}}.dump(
               1)
        << '\n';
  }
  MPI_Barrier(comm);
  if (first) {
    const fs::path done = folder / std::to_string(gas.step());
    const fs::path before = latest();
    fs::remove_all(done);
    fs::rename(unfinished, done);
    if (!before.empty() && before != done) fs::remove_all(before);
  }
  MPI_Barrier(comm);
}

void reopen(Dem& dem) { dem.open((latest() / "dem.restart").string()); }

nlohmann::json load_checkpoint(MPI_Comm comm, Gas& gas, Dem& dem, Feed& feed) {
  const fs::path from = latest();
  if (from.empty()) throw BadInput("checkpoint: none to resume from");
  nlohmann::json state;
  try {
    state = nlohmann::json::parse(std::ifstream(from / "state.json"));
    feed.state = feed_state(state.at("feed"));
    int ranks;
    MPI_Comm_size(comm, &ranks);
    if (state.at("ranks") != ranks)
      throw BadInput(from.string() + ": written on " + state.at("ranks").dump() +
                     " ranks, resumed on " + std::to_string(ranks));
  } catch (const nlohmann::json::exception& error) {
    throw BadInput((from / "state.json").string() + ": " + error.what());
  }
  reopen(dem);
  const File file(from / gas_file(comm), "rb");
  gas.load(file.handle);
  return state.at("record");
}

}  // namespace bedscope::coupled
