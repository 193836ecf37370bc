#include "app/files/contacts_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace app::files {
namespace {

/// Composes one line. It uses to_chars, because a frame may have millions of lines.
class Line {
 public:
  template <class Integer>
  void add(Integer number, char after) {
    end_ = std::to_chars(end_, text_.end(), number).ptr;
    *end_++ = after;
  }
  /// Writes nine digits, which identify a float uniquely.
  void add_distance(float distance) {
    end_ = std::to_chars(end_, text_.end(), double{distance}, std::chars_format::general, 9).ptr;
    *end_++ = '\n';
  }
  std::string_view text() const { return {text_.data(), static_cast<std::size_t>(end_ - text_.data())}; }

 private:
  std::array<char, 128> text_;  // at most five integers of 20 digits and a distance of 16 characters
  char* end_ = text_.data();
};

}  // namespace

ContactsCsv::ContactsCsv(const std::filesystem::path& path)
    : file_(path, "frame,vertex_a,vertex_b,body_a,body_b,distance\n") {}

void ContactsCsv::add(std::size_t number, const collide::Frame& frame, std::span<const collide::Index> file_vertex,
                      const std::vector<collide::Contact>& contacts) {
  const auto& [x, y, z, bodies] = frame;
  const auto in_file = [&](const collide::Contact& c) { return std::minmax(file_vertex[c.a], file_vertex[c.b]); };
  const auto comes_first = [&](const collide::Contact& c, const collide::Contact& d) {
    return in_file(c) < in_file(d);
  };
  std::vector<collide::Contact> sorted;
  if (!std::ranges::is_sorted(contacts, comes_first)) {
    sorted = contacts;
    std::ranges::sort(sorted, comes_first);
  }
  for (auto [a, b] : sorted.empty() ? contacts : sorted) {
    if (file_vertex[a] > file_vertex[b]) std::swap(a, b);
    Line line;
    line.add(number, ',');
    line.add(file_vertex[a], ',');
    line.add(file_vertex[b], ',');
    line.add(bodies->body_of(a), ',');
    line.add(bodies->body_of(b), ',');
    line.add_distance(std::sqrt(collide::squared_distance(x[a], y[a], z[a], x[b], y[b], z[b])));
    file_.write(line.text());
  }
}

}  // namespace app::files
