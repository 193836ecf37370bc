#include "app/report/plot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>
#include <stdexcept>
#include <system_error>

#include <fmt/core.h>

#include "app/base/process.h"

namespace app::report {
namespace {

/// Returns the text as gnuplot reads a string without escapes.
std::string literal(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result.append(c == '\'' ? 2 : 1, c);
  return result + "'";
}

/// Makes gnuplot write to the file what the script draws. Returns false if gnuplot reports an error.
bool run_gnuplot(const std::string& script, std::FILE* out) {
  try {
    Process gnuplot({"gnuplot", "-"}, ::fileno(out));
    return gnuplot.send(std::as_bytes(std::span(script))) && gnuplot.finish();
  } catch (const std::system_error&) {
    throw std::runtime_error("gnuplot cannot be started; install gnuplot-nox");
  }
}

}  // namespace

std::string script(const Plot& plot) {
  assert(!plot.series.empty());
  std::string text = fmt::format(
      "set logscale xy\n"
      "set grid xtics ytics linecolor '#dddddd' linewidth 1 linetype 1\n"
      "set border linecolor '#666666'\n"
      "set key outside top center horizontal maxcols 3 reverse Left samplen 1.5 width -3\n"
      "set xtics format '%g'\n"
      "set title {}\nset xlabel {}\nset ylabel {}\n{}",
      literal(plot.title), literal(plot.x), literal(plot.y), plot.settings);
  std::string drawn;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    text += fmt::format("$d{} << EOD\n", i);
    for (const Point& p : s.points) text += fmt::format("{:.9g} {:.9g} {}\n", p.x, p.y, p.label);
    text += "EOD\n";
    drawn += fmt::format("{}$d{} with {} linecolor rgb '{}' {}", drawn.empty() ? "plot " : ", ", i, s.style, s.colour,
                         s.title.empty() ? "notitle" : "title " + literal(s.title));
    if (std::ranges::any_of(s.points, [](const Point& p) { return !p.label.empty(); }))
      drawn += fmt::format(", $d{} using 1:2:3 with labels offset 0.9,0.5 font ',8' textcolor rgb '{}' notitle", i,
                           s.colour);
  }
  return text + drawn + "\n";
}

std::string draw(const Plot& plot, std::string_view terminal) {
  // The picture goes into a file without a name, which holds any amount, so that neither side waits.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::tmpfile(), &std::fclose);
  if (!out) throw std::runtime_error("gnuplot: no temporary file can be made; is the disk full?");
  const std::string text = fmt::format("set terminal {} background 'white' noenhanced\n", terminal) + script(plot);
  const bool drawn = run_gnuplot(text, out.get());
  std::string picture;
  std::rewind(out.get());
  for (int c = std::fgetc(out.get()); c != EOF; c = std::fgetc(out.get())) picture.push_back(static_cast<char>(c));
  if (!drawn || picture.empty())
    throw std::runtime_error("gnuplot could not draw a plot; it needs version 5.2 or later");
  return picture;
}

std::string colour(const collide::Method& method) {
  const auto byte = [](float part) { return int(std::lround(255 * part)); };
  const glm::vec3 colour = compare::style(method).colour;
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.r), byte(colour.g), byte(colour.b));
}

const char* series_colour(std::size_t i) {
  static constexpr std::array colours{"#000000", "#e69f00", "#0072b2", "#009e73",
                                      "#cc79a7", "#d55e00", "#56b4e9", "#888888"};
  return colours[i % colours.size()];
}

}  // namespace app::report
