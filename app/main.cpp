// SPDX-License-Identifier: BSD-3-Clause
#include <set>
#include <string>

#include "app/commands.hpp"
#include "readers/error.hpp"
#include "readers/toml_table.hpp"

namespace {

/// CLI11 says of `bedscope analyze post/` that a subcommand is missing.
void require_known(const CLI::App& app, const std::string& command) {
  std::set<std::string> names;
  for (const auto* each : app.get_subcommands([](const CLI::App*) { return true; }))
    names.insert(each->get_name());
  if (!command.starts_with('-') && !names.contains(command))
    throw bedscope::InputError("no command \"{}\"; the nearest known one is \"{}\"", command,
                               bedscope::readers::nearest_name(command, names));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace bedscope;
  return app::exit_code_of([&] {
    CLI::App app(
        "Gas-solid fluidised beds and risers: what LIGGGHTS and OpenFOAM wrote, reduced to "
        "holdup, flux, profiles and clusters with their errors");
    app.name("bedscope");
    app.set_version_flag("--version", "bedscope " BEDSCOPE_VERSION);
    app.require_subcommand(1);
    int exit_code = app::done;
    app::add_info(app);
    app::add_analyse(app);
    app::add_validate(app, exit_code);
    app::add_tradeoff(app);
    app::add_curves(app);
    app::add_digitise(app);
    app::add_case(app);
    if (argc > 1) require_known(app, argv[1]);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
      return app.exit(asked);
    }
    return exit_code;
  });
}
