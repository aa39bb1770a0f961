// SPDX-License-Identifier: BSD-3-Clause
// A scene, with the files that its `base` names: read, written, read again, and checked, as `case
// check` does.
#include "cases/check.hpp"
#include "cases/scene_file.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace bedscope::fuzz {

void use(std::string_view input) {
  const MemoryFolder folder(parts_of(input));
  const auto scene = cases::read_scene(folder.path() + "/scene.toml");
  static MemoryFile file;
  const auto text = cases::scene_text(scene);
  require(cases::scene_text(cases::read_scene(file.write(text))) == text,
          "a scene is read as written");
  const auto report = cases::check_scene(scene);
  for (const auto& line : cases::what_cannot_run(report.limits)) require_line(line);
  for (const auto& limit : report.limits) require(!limit.name.empty(), "a limit has a name");
}

}  // namespace bedscope::fuzz
