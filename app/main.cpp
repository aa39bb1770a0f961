// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands.hpp"

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
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
      return app.exit(asked);
    }
    return exit_code;
  });
}
