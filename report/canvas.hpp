// SPDX-License-Identifier: BSD-3-Clause
// Builds one figure's gnuplot script and its data file. All places and sizes on the page are in mm
// from the lower left corner, so that SVG and PNG are laid out alike.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/style.hpp"

namespace bedscope::report {

/// A frame with its axes. Axis texts are gnuplot expressions: literal(...).
struct Panel {
  double left = 0, bottom = 0, width = 0, height = 0;  ///< [mm]
  Axis x, y;
  bool x_numbers = true, y_numbers = true;
  std::string x_label, y_label;
  double y_label_gap = 11;  ///< from the frame to the middle of the y label [mm]
  bool neighbour = false;   ///< another panel is close at the right: no number at that edge
  bool zero_line = false;   ///< thin and grey, where y has both signs
  bool map = false;         ///< ticks outwards, grey where there are no data
};

/// A sample and its text in a legend above the panels.
struct LegendEntry {
  std::string line;    ///< gnuplot line words with width, or empty
  std::string marker;  ///< gnuplot point words with colour, or empty
  std::string label;   ///< as the user wrote it
};

/// A gnuplot string constant of a text of ours, symbols that stand alone in italics and v_z with a
/// subscript. For users' texts: Canvas::user_label.
std::string literal(std::string_view text);

class Canvas {
 public:
  Canvas(double width, double height) : width_(width), height_(height) {}

  double width() const { return width_; }
  double height() const { return height_; }

  /// Adds a block to the data file, `rows` being whole lines; gives its index.
  std::size_t block(std::string_view comment, std::string_view rows);
  void command(std::string_view line);
  void label(const std::string& expression, double x, double y, std::string_view words = "center");
  /// A user's text, drawn as it is written whatever it contains.
  void user_label(std::string_view text, double x, double y, std::string_view words = "center");
  void open(const Panel& panel);
  /// Ends a panel: "using ..." layers of the data file, each with its block.
  void draw(std::span<const std::string> layers);
  /// A layer: data block `index`, and what to do with it.
  static std::string layer(std::size_t index, std::string_view words);

  /// Rows that a legend needs in `width`, and drawing it downwards from `top` (both [mm]).
  static double legend_height(std::span<const LegendEntry> entries, double width);
  void legend(std::span<const LegendEntry> entries, double left, double top, double width);
  /// A horizontal colour bar with its numbers above and its title above these. Belongs to the next
  /// panel that is drawn, as the palette and its range do.
  void colour_bar(double left, double bottom, double width, const Axis& range,
                  const std::string& title);

  /// The whole script: draws <name>.svg and <name>.png from <name>.dat in the current folder.
  std::string script(const std::string& name, const std::string& title) const;
  const std::string& data() const { return data_; }

 private:
  std::string text(std::string_view user_text);
  std::string screen(double x, double y) const;
  void axis(char name, const Axis& range, bool numbers, bool map);

  double width_, height_;
  std::vector<std::string> texts_;    ///< of users, as gnuplot constants
  std::vector<std::string> pending_;  ///< labels and the like of the next panel
  std::string body_, data_;
  std::size_t blocks_ = 0;
};

/// `set palette` for holdup (viridis: dark is empty), for holdup under drawings (white is empty)
/// and for signed quantities (blue down, white at 0, red up).
std::string viridis();
std::string light_greys();
std::string diverging(double lo, double hi);

}  // namespace bedscope::report
