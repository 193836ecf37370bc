#include "app/files/contacts_csv.h"

#include <array>
#include <charconv>
#include <cmath>

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

void ContactsCsv::add(std::size_t number, const collide::Frame& frame, const std::vector<collide::Contact>& contacts) {
  const auto& [x, y, z, bodies] = frame;
  for (const auto& [a, b] : contacts) {
    Line line;
    line.add(number, ',');
    line.add(a, ',');
    line.add(b, ',');
    line.add(bodies->body_of(a), ',');
    line.add(bodies->body_of(b), ',');
    line.add_distance(std::sqrt(collide::squared_distance(x[a], y[a], z[a], x[b], y[b], z[b])));
    file_.write(line.text());
  }
}

}  // namespace app::files
