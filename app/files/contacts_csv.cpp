#include "app/files/contacts_csv.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/files/csv_line.h"

namespace app::files {

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
    CsvLine line;
    line.add(number, ',');
    line.add(file_vertex[a], ',');
    line.add(file_vertex[b], ',');
    line.add(bodies->body_of(a), ',');
    line.add(bodies->body_of(b), ',');
    line.add_float(std::sqrt(collide::squared_distance(x[a], y[a], z[a], x[b], y[b], z[b])), '\n');
    file_.write(line.text());
  }
}

}  // namespace app::files
