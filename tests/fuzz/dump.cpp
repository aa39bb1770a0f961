// SPDX-License-Identifier: BSD-3-Clause
// A particle dump in one file, of whatever form its content says.
#include <bit>

#include "readers/error.hpp"
#include "readers/forms.hpp"
#include "readers/series.hpp"
#include "readers/source.hpp"
#include "readers/survey.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {
namespace {

using namespace readers;

/// What a gzip stream expands to is input as well: its rows are really there.
void count_expanded(const std::string& path) {
  std::vector<char> piece(1U << 16);
  Source source(path);
  if (!source.compressed()) return;
  for (std::size_t got = 1; got > 0;) add_input(got = source.read(piece));
}

FileScan scan(const Form& form, const std::string& path, bool thorough) {
  auto found = form.scan(path, thorough);
  require(!found.not_particles.empty() || !found.snapshots.empty(),
          "a scan finds snapshots, something else, or ends in an error");
  return found;
}

void require_same(const FileScan& glance, const FileScan& thorough) {
  if (!glance.not_particles.empty() || !thorough.not_particles.empty() || !thorough.cut.empty())
    return;  // the form's own rules: a mesh may need the thorough look
  require(glance.snapshots.size() == thorough.snapshots.size(), "glance and thorough count alike");
  for (std::size_t i = 0; i < glance.snapshots.size(); ++i) {
    const auto &a = glance.snapshots[i], &b = thorough.snapshots[i];
    require(a.step == b.step && a.particles == b.particles && a.offset == b.offset,
            "glance and thorough find the same snapshots");
  }
}

/// A request for all that the snapshot has, by its own names and by the field's.
Request everything(const Located& where) {
  Request request{{"x", false},  {"y", false},       {"z", false},  {"radius", false},
                  {"id", false}, {"density", false}, {"vx", false}, {"temperature", false}};
  if (where.parts != nullptr)
    for (std::size_t k = 0; k < std::min<std::size_t>(where.parts->size(), 60); ++k)
      request.push_back({(*where.parts)[k], false});
  return request;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

void read(const Form& form, const std::string& path, const Located& where) {
  Snapshot all, one;
  Scratch scratch;
  const auto request = everything(where);
  form.read(path, where, request, all, scratch);
  require(all.particles == static_cast<std::size_t>(where.particles), "particles as declared");
  require(all.columns.size() == request.size(), "one column for each one asked for");
  for (const auto& column : all.columns)
    require(column.empty() || column.size() == all.particles, "columns as long as declared");
  for (const std::size_t k : {std::size_t{0}, request.size() - 1}) {
    form.read(path, where, {request[k]}, one, scratch);
    require(same_bits(one.columns.at(0), all.columns[k]), "one column alone is that column");
  }
  if (form.place != nullptr && all.particles > 0)
    require_line(form.place(path, where, all.particles - 1));
}

/// As `bedscope info --full` does.
void inform(const std::string& path) {
  const auto series = Series::open(path, {Repeated::last});
  for (std::size_t i = 1; i < series.size(); ++i)
    require(series.step(i - 1) < series.step(i), "steps ascend");
  for (const auto& what : series.left_out()) require_line(what);
  for (const auto& problem : survey(series, true).problems) require_line(problem);
}

}  // namespace

void use(std::string_view input) {
  static MemoryFile file;
  const auto& path = file.write(input);
  count_expanded(path);
  const auto& form = identify(path);
  const auto thorough = scan(form, path, true);
  const auto glance = scan(form, path, false);
  require_same(glance, thorough);
  for (const auto& where : thorough.snapshots) read(form, path, where);
  if (thorough.not_particles.empty()) inform(path);
}

}  // namespace bedscope::fuzz
